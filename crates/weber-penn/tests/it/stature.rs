//! How trees stand: lean, bow, one-sidedness, depth and outline, and numbers that are adapted to measures.

use super::behaviour::{PLAIN, grow, read, stems, with};
use glam::DVec3;
use pleach_tree::{Foliage, Growth, Species, Stature, Tree};

#[test]
fn a_trunk_is_adapted_to_measures() {
    let species = read(PLAIN).unwrap();
    let adapted = |wanted: Stature, grown: Stature| {
        let mut values = species.params.values().to_vec();
        species.generator.adapt(&mut values, &wanted, &grown);
        let params = species.generator.space().check(values).unwrap();
        Species { params, ..species.clone() }.grow(1).unwrap()
    };
    let radius = |tree: &Tree| tree.knots[0].radius;
    let lowest = |tree: &Tree| {
        let feet =
            tree.stems.iter().filter(|stem| stem.level == 1).map(|stem| tree.knots_of(stem)[0].point.z);
        feet.fold(f64::INFINITY, f64::min)
    };
    let same = adapted(Stature::default(), Stature::default());
    let of = |thickness| Stature { thickness: Some(thickness), ..Stature::default() };
    assert!((radius(&adapted(of(0.06), of(0.04))) / radius(&same) - 1.5).abs() < 1e-6);
    let of = |bare| Stature { bare_height: Some(bare), ..Stature::default() };
    let bare = adapted(of(0.5), of(0.2));
    assert!(((lowest(&bare) - lowest(&same)) / 10.0 - 0.3).abs() < 0.05, "of ten metres");
    assert_eq!(adapted(of(0.5), Stature::default()), same, "what is not known of the tree stays");
}

#[test]
fn lean_displaces_a_tree_by_height() {
    for name in pleach_weber_penn::HEWITT_2017 {
        let species = pleach_weber_penn::preset(name).unwrap();
        let leaning = |degrees: f64| {
            let space = species.generator.space();
            let mut values = species.params.values().to_vec();
            values[space.select("lean").unwrap()[0].index()] = degrees;
            let params = space.check(values).unwrap();
            let growth = Growth { foliage: Foliage::None, ..Growth::seed(2) };
            Species { params, ..species.clone() }.grow_with(&growth).unwrap()
        };
        let (upright, tree) = (leaning(0.0), leaning(10.0));
        assert_eq!(
            upright,
            species.grow_with(&Growth { foliage: Foliage::None, ..Growth::seed(2) }).unwrap()
        );
        let slope = 10.0_f64.to_radians().tan();
        for (before, after) in upright.knots.iter().zip(&tree.knots) {
            let place = before.point + DVec3::X * (slope * before.point.z);
            assert!(place.distance(after.point) < 1e-9, "{name}: {place} and {}", after.point);
            assert_eq!(before.radius, after.radius, "{name}");
        }
        assert_eq!((upright.stems, upright.knots.len()), (tree.stems, tree.knots.len()), "{name}");
    }
}

#[test]
fn leaves_lean_with_their_stems() {
    let leafy = |lines: &str| grow(&with(&format!("leaf_blos_num = 30\nbow = 30\n{lines}")));
    let (upright, tree) = (leafy("lean = -10"), leafy("lean = 20"));
    assert!(!tree.leaves.is_empty());
    let slope = 20.0_f64.to_radians().tan() + 10.0_f64.to_radians().tan();
    for (before, after) in upright.leaves.iter().zip(&tree.leaves) {
        let moved = f64::from(after.position.x - before.position.x);
        assert!((moved - slope * f64::from(before.position.z)).abs() < 1e-4);
        assert_eq!((before.along, before.across), (after.along, after.across));
    }
}

#[test]
fn solids_stand_where_they_are_beside_a_leaning_tree() {
    let walled = |lean: f64| {
        let text = with(&format!(
            "prune_ratio = 1\nlean = {lean}\nprune_inside = [{{ shape = \"box\", min = [-20, -20, -1], max = [2, 20, 20] }}]"
        ));
        let tree = grow(&text);
        tree.knots.iter().map(|knot| knot.point.x).fold(f64::NEG_INFINITY, f64::max)
    };
    assert!((1.8..=2.0).contains(&walled(0.0)));
    assert!((1.8..=2.0).contains(&walled(8.0)), "{}", walled(8.0));
}

#[test]
fn an_outline_is_followed() {
    let outline = [0.3, 1.0, 0.6, 0.8, 0.2];
    let text = with(&format!("shape = \"cylindrical\"\noutline = {outline:?}\nbranches = [1, 160, 0, 0]"));
    let tree = grow(&text);
    let mut places = [0; 5];
    for branch in stems(&tree, 1) {
        let rise = (branch.offset - 2.0) / 8.0 * 4.0;
        let place = rise.round() as usize;
        if (rise - place as f64).abs() < 0.05 {
            let length = tree.length_of(branch) / 3.0;
            assert!((length - outline[place]).abs() < 0.06, "{length} at {rise}");
            places[place] += 1;
        }
    }
    assert!(places.iter().all(|&count| count > 0), "{places:?}");
    let twice = with("shape = \"conical\"\noutline = [2, 2, 2, 2, 2]");
    let (plain, wide) = (grow(&with("shape = \"conical\"")), grow(&twice));
    for (plain_branch, wide_branch) in stems(&plain, 1).into_iter().zip(stems(&wide, 1)) {
        let factor = wide.length_of(wide_branch) / plain.length_of(plain_branch);
        assert!((factor - 2.0).abs() < 1e-9, "{factor}: the shape's lengths, multiplied");
    }
}

#[test]
fn crowns_are_one_sided_and_flat_by_azimuth() {
    let reach = |lines: &str, along: DVec3| {
        let tree = grow(&with(&format!("{lines}\nbranches = [1, 160, 0, 0]\nrotate = [0, 140, 0, 0]")));
        let tips = stems(&tree, 1).into_iter().map(|s| tree.knots_of(s).last().unwrap().point.dot(along));
        tips.fold(0.0, f64::max)
    };
    let [x, y] = [DVec3::X, DVec3::Y];
    let is = |a: f64, b: f64| assert!((a - b).abs() < 0.1, "{a} instead of {b}");
    let round = "shape = \"cylindrical\"";
    is(reach(round, x), 3.0);
    let sided = format!("{round}\nside = 0.4");
    is(reach(&sided, x), 4.2);
    is(reach(&sided, -x), 1.8);
    is(reach(&sided, y), reach(&sided, -y));
    let flat = format!("{round}\ncrown_depth = 0.5");
    is(reach(&flat, x), 3.0);
    is(reach(&flat, -y), 1.5);
}

#[test]
fn a_leaning_trunk_with_a_one_sided_crown_is_adapted_to_measures() {
    let species = read(PLAIN).unwrap();
    let space = species.generator.space();
    let adapted = |wanted: &Stature, grown: &Stature, name: &str| {
        let mut values = species.params.values().to_vec();
        species.generator.adapt(&mut values, wanted, grown);
        space.select(name).unwrap().into_iter().map(|slot| values[slot.index()]).collect::<Vec<f64>>()
    };
    let of = |lean| Stature { lean: Some(lean), ..Stature::default() };
    let is = |found: Vec<f64>, wanted: f64| assert!((found[0] - wanted).abs() < 1e-6, "{found:?}");
    is(adapted(&of(12.0), &of(0.0), "lean"), 12.0);
    is(adapted(&of(-12.0), &Stature::default(), "lean"), -12.0);
    assert_eq!(adapted(&of(12.0), &of(10.0), "lean"), [0.0], "as near as readings are right");
    // Crowns whose middles lie at `off`, from 0.2 of the height on.
    let crown = |lean: f64, off: &dyn Fn(f64) -> f64, half: &dyn Fn(f64) -> f64| {
        let side = |sign: f64| {
            (0..33)
                .map(|row| f64::from(row) / 32.0)
                .map(move |z| if z < 0.2 { 0.0 } else { half(z) + sign * off(z) })
        };
        let crown = Some([side(-1.0).collect(), side(1.0).collect()]);
        Stature { lean: Some(lean), bare_height: Some(0.2), crown, ..Stature::default() }
    };
    let upright = crown(0.0, &|_| 0.0, &|_| 0.3);
    let leaning = crown(12.0, &|z| z * 12.0_f64.to_radians().tan(), &|_| 0.3);
    is(adapted(&leaning, &upright, "lean"), 12.0);
    is(adapted(&leaning, &upright, "bow"), 0.0);
    is(adapted(&leaning, &upright, "side"), 0.0);
    is(adapted(&crown(0.0, &|_| 0.12, &|_| 0.3), &upright, "side"), 0.4);
    // A trunk that leans by 12° at its foot and comes back to stand upright at its top.
    let slope = 12.0_f64.to_radians().tan();
    let back = crown(12.0, &|z| slope * (z - z * z / 2.0), &|_| 0.3);
    assert!((adapted(&back, &upright, "bow")[0] + 12.0).abs() < 1.0);
    assert!((adapted(&back, &upright, "lean")[0] - 6.0).abs() < 0.5);
    is(adapted(&back, &upright, "side"), 0.0);
    // A crown that is wide below and narrow above.
    let wide = crown(0.0, &|_| 0.0, &|z| 0.5 - 0.45 * z);
    let outline = adapted(&wide, &upright, "outline");
    assert!(outline.windows(2).all(|pair| pair[0] >= pair[1]), "{outline:?}");
    assert!(outline[0] > 1.5 && outline[2] > 0.9 && outline[4] < 0.7, "{outline:?}");
    assert_eq!(adapted(&upright, &upright, "outline"), [1.0; 5]);
}
