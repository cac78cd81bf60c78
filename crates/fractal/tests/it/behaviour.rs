//! What each number does, chance, and numbers that mean no good.

use crate::{branches, grown, try_grown, with};
use pleach_tree::{GrowError, Key, Slot, Species, Tree};

fn points(tree: &Tree) -> Vec<[f64; 3]> {
    tree.knots.iter().map(|knot| knot.point.to_array()).collect()
}

#[test]
fn a_spread_of_0_and_of_180_degrees_grow_without_nan() {
    for name in ["coffey_umbrella", "coffey_fan", "coffey_turned_crown", "coffey_whorls", "coffey_old_tree"] {
        for polar in [0.0, 180.0] {
            let tree = grown(name, &[("polar", polar), ("polar_v", 0.0)]);
            assert_eq!(tree.well_formed(), Ok(()), "{name} at {polar}");
            assert!(branches(&tree) > 100, "{name} at {polar}");
        }
    }
    let pole = grown("coffey_umbrella", &[("polar", 0.0)]);
    assert!(pole.knots.iter().all(|knot| knot.point.x.abs() < 1e-9), "all daughters go on");
}

#[test]
fn sixty_generations_are_refused_before_they_grow() {
    for name in ["coffey_umbrella", "coffey_fan", "coffey_winter_oak"] {
        let error = try_grown(name, &[("generations", 60.0), ("scale", 1.0)]).unwrap_err();
        let told = error.to_string();
        assert!(told.contains("because of `generations`"), "{told}");
    }
    let error = try_grown("coffey_fan", &[("generations", 60.0), ("scale", 1.0)]).unwrap_err();
    assert!(matches!(error, GrowError::TooMuchWork { .. }), "{error}");
    let told = with("coffey_fan", &[("generations", 61.0)]).unwrap_err().to_string();
    assert!(told.contains("generations") && told.contains("60"), "{told}");
    let pole = grown("coffey_fan", &[("generations", 60.0), ("side_branches", 0.0), ("scale", 1.0)]);
    assert_eq!((branches(&pole), pole.stems.len()), (61, 1), "what does not branch may be as long");
}

#[test]
fn what_is_not_a_number_is_refused() {
    for name in ["polar", "scale", "trunk_length", "apical_ratio"] {
        for value in [f64::NAN, f64::INFINITY, -1e9] {
            let told = with("coffey_fan", &[(name, value)]).unwrap_err().to_string();
            assert!(told.contains(name), "{told}");
        }
    }
}

#[test]
fn extreme_numbers_grow_or_are_errors() {
    let set = [
        ("scale", 1.2),
        ("scale_v", 0.6),
        ("apical_ratio", 5.0),
        ("apical_ratio_v", 2.0),
        ("polar_v", 90.0),
        ("azimuth_v", 180.0),
        ("central_polar_v", 60.0),
        ("side_branches_v", 4.0),
    ];
    let tree = grown("coffey_young_tree", &[&set[..], &[("generations", 4.0)]].concat());
    assert_eq!(tree.well_formed(), Ok(()));
    assert!(try_grown("coffey_young_tree", &[&set[..], &[("generations", 20.0)]].concat()).is_err());
}

#[test]
fn no_generation_is_a_trunk() {
    for rule in [1.0, 2.0] {
        let tree = grown("coffey_old_tree", &[("generations", 0.0), ("thickness_rule", rule)]);
        assert_eq!((branches(&tree), tree.stems.len(), tree.leaves.len()), (1, 1, 1));
        let radii: Vec<f64> = tree.knots.iter().map(|knot| knot.radius).collect();
        assert!(radii[1] < radii[0] && radii[1] > 0.0, "{radii:?}");
    }
}

#[test]
fn a_regular_tree_is_the_same_from_every_seed_and_a_random_one_is_not() {
    let grow = |name: &str, seed| with(name, &[]).unwrap().grow(seed).unwrap();
    assert!(grow("coffey_turned_crown", 1) == grow("coffey_turned_crown", 2));
    for name in ["coffey_winter_oak", "coffey_pine", "coffey_young_tree", "coffey_old_tree"] {
        assert!(grow(name, 1) != grow(name, 2), "{name}");
    }
}

#[test]
fn central_branches_shrink_to_nothing_before_they_are_gone() {
    let none = grown("coffey_turned_fork", &[]);
    let tiny = grown("coffey_turned_fork", &[("apical_ratio", 1e-4 / 0.8)]);
    let little = grown("coffey_turned_fork", &[("apical_ratio", 0.01)]);
    let sorted = |tree: &Tree| {
        let mut points = points(tree);
        points.sort_by(|a, b| a.partial_cmp(b).unwrap());
        points.dedup();
        points
    };
    assert_eq!(branches(&tiny), branches(&none) + 1, "one at the trunk is just long enough");
    assert!(sorted(&none).iter().all(|p| sorted(&tiny).contains(p)), "the others stay where they are");
    assert!(branches(&little) > branches(&tiny));
    let top = |tree: &Tree| tree.knots.iter().map(|knot| knot.point.z).fold(0.0, f64::max);
    assert!((top(&little) - top(&none)).abs() < 0.01 * top(&none));
}

#[test]
fn what_is_left_out_moves_nothing_else() {
    let whole = grown("coffey_old_tree", &[("drop", 0.0)]);
    let gaps = grown("coffey_old_tree", &[]);
    assert!(branches(&gaps) * 2 < branches(&whole), "{} of {}", branches(&gaps), branches(&whole));
    let all = points(&whole);
    assert!(points(&gaps).iter().all(|point| all.contains(point)));
    let later = grown("coffey_old_tree", &[("drop_from", 7.0)]);
    assert!(branches(&later) > branches(&gaps));
}

#[test]
fn side_branches_vary_in_number() {
    let tree = grown("coffey_winter_oak", &[("side_branches_v", 2.0), ("noise", 2.0)]);
    let mut counts = [0; 8];
    for stem in 0..tree.stems.len() as u32 {
        let offsets: Vec<f64> =
            tree.stems.iter().filter(|s| s.parent == Some(stem)).map(|s| s.offset).collect();
        for offset in &offsets {
            counts[offsets.iter().filter(|o| *o == offset).count()] += 1;
        }
    }
    assert!([1, 2, 3].iter().all(|&n| counts[n] > 0), "{counts:?}");
    assert!(counts[5..].iter().all(|&n| n == 0), "at most four: {counts:?}");
}

#[test]
fn leaves_lie_along_the_last_twigs() {
    let tree = grown("coffey_old_tree", &[]);
    assert!(!tree.leaves.is_empty());
    for leaf in &tree.leaves {
        let knots = tree.knots_of(&tree.stems[leaf.stem as usize]);
        let [foot, tip] = [knots[knots.len() - 2].point, knots[knots.len() - 1].point];
        assert!((leaf.position.as_dvec3() - foot).length() < 1e-5);
        assert!((leaf.along.as_dvec3() - (tip - foot)).length() < 1e-5);
        assert!((leaf.across.length() - 0.5 * leaf.along.length()).abs() < 1e-5);
        assert!(leaf.along.dot(leaf.across).abs() < 1e-5);
    }
    let stump = grown("coffey_old_tree", &[("drop", 0.9), ("drop_from", 1.0)]);
    assert_eq!(stump.leaves.len(), 0, "a limb that lost its branches has no leaf");
    let half = grown("coffey_old_tree", &[("leaf_rate", 0.5)]).leaves.len() as f64;
    let share = half / tree.leaves.len() as f64;
    assert!((0.4..0.6).contains(&share), "{share}");
}

#[test]
fn a_tree_in_the_plane_is_flat_whatever_varies() {
    let tree = grown("coffey_old_tree", &[("dimensions", 1.0)]);
    assert!(tree.knots.iter().all(|knot| knot.point.y == 0.0));
    assert!(tree.leaves.iter().all(|leaf| leaf.across.y == 0.0));
    let fan = grown("coffey_umbrella", &[("side_branches", 3.0), ("generations", 1.0)]);
    let tips: Vec<f64> = fan.stems[1..].iter().map(|stem| fan.knots_of(stem)[1].point.x).collect();
    assert!(tips.iter().any(|x| x.abs() < 1e-9), "the middle one goes straight on: {tips:?}");
}

#[test]
fn numbers_that_are_not_active_change_nothing() {
    let mut inactive = 0;
    for case in 0..300 {
        let key = Key::root(case);
        let species = with("coffey_young_tree", &[]).unwrap();
        let space = species.generator.space().clone();
        // Often at the ends of the ranges, where numbers switch others off.
        let draw = |slot: Slot| {
            let (low, high) = if slot.index() == 1 { (0.0, 3.0) } else { space.search_range(slot) };
            let part = key.unit(0, slot.index() as u32);
            let part = if part < 0.4 { 0.0 } else { key.unit(1, slot.index() as u32) };
            space.kind_of(slot).repair(low + (high - low) * part)
        };
        let values: Vec<f64> = space.slots().map(draw).collect();
        let grow = |values: &[f64]| {
            let params = space.check(values.to_vec()).unwrap();
            let tree = Species { params, ..species.clone() }.grow(case).unwrap();
            (tree.stems, tree.knots, tree.leaves)
        };
        let reference = grow(&values);
        for slot in space.slots().filter(|slot| !species.generator.is_active(&values, *slot)) {
            inactive += 1;
            let (low, high) = space.search_range(slot);
            let mut changed = values.clone();
            changed[slot.index()] = if values[slot.index()] == high { low } else { high };
            assert!(grow(&changed) == reference, "{} in case {case}", space.slot_name(slot));
        }
    }
    assert!(inactive > 500, "{inactive}");
}
