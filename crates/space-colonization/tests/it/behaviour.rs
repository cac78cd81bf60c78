//! What the numbers do to a tree.

use pleach_space_colonization::{SpaceColonization, SpaceColonizationFamily};
use pleach_tree::{Generator, GrowError, Growth, SpeciesDoc, Stature, StemKind, Tree, Workspace};

fn grown_from(seed: u64, set: &[(&str, f64)]) -> Result<Tree, GrowError> {
    let space = SpaceColonization.space();
    let mut values = space.defaults();
    for (name, value) in set {
        let slot = space.slots().find(|slot| space.slot_name(*slot) == *name).unwrap();
        values[slot.index()] = *value;
    }
    let (params, mut tree) = (space.check(values).unwrap(), Tree::default());
    SpaceColonization.grow(&params, &Growth::seed(seed), &mut Workspace::default(), &mut tree)?;
    Ok(tree)
}

fn grown(set: &[(&str, f64)]) -> Tree {
    grown_from(1, set).unwrap()
}

/// Without twigs, leaves and chance of the outline.
const SCAFFOLD: [(&str, f64); 3] = [("twigs", 0.0), ("irregularity", 0.0), ("height", 10.0)];

fn scaffold(set: &[(&str, f64)]) -> Tree {
    grown(&[&SCAFFOLD[..], set].concat())
}

/// Least and greatest of a number of all knots.
fn range(tree: &Tree, number: impl Fn(&pleach_tree::Knot) -> f64) -> (f64, f64) {
    let numbers = tree.knots.iter().map(number);
    numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
}

#[test]
fn crowns_have_their_height_and_width() {
    for (height, width) in [(10.0, 0.4), (10.0, 1.2), (25.0, 0.8)] {
        let tree = scaffold(&[("height", height), ("crown_width", width), ("shade", 0.0)]);
        let (_, top) = range(&tree, |knot| knot.point.z);
        assert!((0.85..1.1).contains(&(top / height)), "{top} of {height}");
        let (left, right) = range(&tree, |knot| knot.point.x);
        let wide = (right - left) / (width * height);
        assert!((0.75..1.12).contains(&wide), "{wide} of the width");
    }
}

#[test]
fn below_the_bare_height_there_are_only_trunks_and_limbs() {
    let tree = scaffold(&[("bare_height", 0.5), ("limbs", 1.0), ("leader", 0.8)]);
    let low = tree.stems.iter().filter(|stem| stem.kind != StemKind::Trunk);
    let low = low.flat_map(|stem| tree.knots_of(stem)).filter(|knot| knot.point.z < 4.5).count();
    assert_eq!(low, 0);
}

#[test]
fn a_leader_with_dominance_goes_through_to_the_top() {
    let fir = [("limbs", 1.0), ("leader", 1.0), ("dominance", 0.9), ("crook", 0.0)];
    let trunk = |tree: &Tree| tree.knots_of(&tree.stems[0]).last().unwrap().point;
    let tip = trunk(&scaffold(&fir));
    assert!(tip.z > 9.5 && tip.truncate().length() < 0.5, "{tip}");
    // Forks: the trunk goes on in one of several limbs.
    let oak =
        [("limbs", 5.0), ("first_fork", 0.2), ("fork_angle", 60.0), ("leader", 0.5), ("crown_width", 1.2)];
    let tip = trunk(&scaffold(&oak));
    assert!(tip.truncate().length() > 1.5, "{tip}");
}

#[test]
fn apical_control_of_a_half_is_the_default_and_others_are_other_trees() {
    let lead = [("limbs", 1.0), ("leader", 0.3), ("points", 2000.0)];
    let with = |control: f64| scaffold(&[&lead[..], &[("apical_control", control)]].concat());
    let even = with(0.5);
    assert_eq!(even.digest(), scaffold(&lead).digest());
    for control in [0.3, 0.7, 0.9] {
        let tree = with(control);
        assert_eq!(tree.well_formed(), Ok(()));
        assert!(tree.digest() != even.digest(), "{control}");
    }
    // What a leader keeps its side shoots lack, and the other way round.
    assert!(with(0.9).stems.len() < even.stems.len() / 2);
    let top = |tree: &Tree| range(tree, |knot| knot.point.z).1;
    assert!(top(&with(0.3)) < 0.9 * top(&even), "{} {}", top(&with(0.3)), top(&even));
}

#[test]
fn apical_control_is_a_part() {
    let space = SpaceColonization.space();
    let slot = space.slots().find(|slot| space.slot_name(*slot) == "apical_control").unwrap();
    for value in [-0.1, 1.1, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut values = space.defaults();
        values[slot.index()] = value;
        let error = space.check(values).unwrap_err().to_string();
        assert!(error.contains("apical_control"), "{error}");
    }
    let read = |value: &str| {
        let text = format!("generator = \"space-colonization\"\nname = \"x\"\napical_control = {value}\n");
        SpeciesDoc::parse("x.toml", &text).and_then(|doc| doc.species(&SpaceColonizationFamily))
    };
    assert_eq!(read("0.8").unwrap().params.values()[slot.index()], 0.8);
    for value in ["1.01", "-1", "nan", "inf", "\"much\"", "[0.7]"] {
        let error = read(value).unwrap_err().to_string();
        assert!(error.contains("apical_control"), "{error}");
    }
    for value in [0.0, 1.0] {
        assert_eq!(grown(&[("apical_control", value)]).well_formed(), Ok(()));
    }
}

#[test]
fn trunks_are_as_many_as_asked_for() {
    for count in 1..=6 {
        let tree = scaffold(&[("trunks", f64::from(count))]);
        let trunks = tree.stems.iter().filter(|stem| stem.kind == StemKind::Trunk).count();
        assert_eq!(trunks, count as usize);
    }
}

#[test]
fn the_thickest_trunk_has_its_thickness() {
    for trunks in [1.0, 3.0] {
        let tree = scaffold(&[("trunks", trunks), ("thickness", 0.03), ("flare", 0.0)]);
        let thickest = tree.knots.iter().map(|knot| knot.radius).fold(0.0, f64::max);
        assert!((thickest - 0.3).abs() < 1e-9, "{thickest}");
        let flared = scaffold(&[("trunks", trunks), ("thickness", 0.03), ("flare", 0.5)]);
        let thickest = flared.knots.iter().map(|knot| knot.radius).fold(0.0, f64::max);
        assert!((0.43..0.46).contains(&thickest), "{thickest}");
    }
}

#[test]
fn hanging_twigs_hang() {
    let mean = |lift: f64| {
        let tree = grown(&[("twig_lift", lift), ("twig_length", 0.15), ("side_twigs", 0.0)]);
        let deepest = tree.level_count() as u16 - 1;
        let drops: Vec<f64> = tree
            .stems
            .iter()
            .filter(|stem| stem.level == deepest)
            .map(|stem| {
                let knots = tree.knots_of(stem);
                knots[knots.len() - 1].point.z - knots[0].point.z
            })
            .collect();
        drops.iter().sum::<f64>() / drops.len() as f64
    };
    assert!(mean(-140.0) < -0.5 && mean(60.0) > 0.3, "{} {}", mean(-140.0), mean(60.0));
}

#[test]
fn other_seeds_fill_the_same_sort_of_crown() {
    let trees: Vec<Tree> = (1..7).map(|seed| grown_from(seed, &[]).unwrap()).collect();
    let stems: Vec<usize> = trees.iter().map(|tree| tree.stems.len()).collect();
    let (least, most) = (stems.iter().min().unwrap(), stems.iter().max().unwrap());
    assert!(*least as f64 > 0.75 * *most as f64, "{stems:?}");
    assert!(trees.windows(2).all(|pair| pair[0].digest() != pair[1].digest()));
}

#[test]
fn few_points_in_a_wide_crown_are_a_tree_too() {
    let tree = scaffold(&[("crown_width", 5.0), ("points", 20.0), ("step", 1.5), ("limbs", 5.0)]);
    assert_eq!(tree.well_formed(), Ok(()));
    assert!(range(&tree, |knot| knot.point.z).1 > 2.0);
}

/// A low, wide crown that reaches twice as far to the right as to the left.
#[test]
fn a_tree_is_adapted_to_measures() {
    let rows = |reach: f64| (0..33).map(|i| if i < 8 { 0.0 } else { reach }).collect::<Vec<f64>>();
    let wanted = Stature {
        trunks: Some(1),
        bare_height: Some(0.25),
        crown: Some([rows(0.3), rows(0.6)]),
        ..Stature::default()
    };
    let space = SpaceColonization.space();
    let adapted = |wanted: &Stature| {
        let mut values = space.defaults();
        for (name, value) in SCAFFOLD {
            let slot = space.slots().find(|slot| space.slot_name(*slot) == name).unwrap();
            values[slot.index()] = value;
        }
        SpaceColonization.adapt(&mut values, wanted, &Stature::default());
        let (params, mut tree) = (space.check(values).unwrap(), Tree::default());
        SpaceColonization.grow(&params, &Growth::seed(1), &mut Workspace::default(), &mut tree).unwrap();
        range(&tree, |knot| knot.point.x)
    };
    let (left, right) = adapted(&wanted);
    assert!((6.5..10.0).contains(&(right - left)), "from {left} to {right}, of ten metres");
    assert!((1.5..2.6).contains(&(right / -left)), "from {left} to {right}");
    let top = |lean: f64| {
        let (left, right) = adapted(&Stature { lean: Some(lean), ..Stature::default() });
        (left + right) / 2.0
    };
    assert!(top(20.0) > 0.8 && top(-20.0) < -0.8, "{} {}", top(20.0), top(-20.0));
}
