//! What the numbers do to a tree, and what no numbers can do.

use pleach_stylised::StylisedFamily;
use pleach_tree::species::preset;
use pleach_tree::{GrowError, Growth, Limits, Species, StemKind, Tree};
use proptest::prelude::*;

/// A tree of the defaults and these numbers.
fn tree(numbers: &[(&str, f64)], seed: u64) -> Tree {
    let tree = species(numbers).grow(seed).unwrap();
    assert_eq!(tree.well_formed(), Ok(()));
    tree
}

fn species(numbers: &[(&str, f64)]) -> Species {
    let species = preset(&StylisedFamily, "stylised_oak").unwrap();
    let space = species.generator.space();
    let mut values = space.defaults();
    for (name, value) in numbers {
        values[space.find(name).unwrap().0] = *value;
    }
    let params = space.check(values).unwrap();
    Species { params, ..species }
}

fn count(tree: &Tree, kind: StemKind) -> usize {
    tree.stems.iter().filter(|stem| stem.kind == kind).count()
}

fn volume(tree: &Tree, blob: usize) -> f64 {
    let blob = &tree.blobs[blob];
    let vertices = &tree.blob_vertices[blob.vertices()];
    let at = |i: u32| vertices[i as usize].as_dvec3() - vertices[0].as_dvec3();
    tree.blob_triangles[blob.triangles()].iter().map(|t| at(t[0]).dot(at(t[1]).cross(at(t[2]))) / 6.0).sum()
}

#[test]
fn the_defaults_are_a_bare_pole() {
    let tree = tree(&[], 1);
    assert_eq!((tree.stems.len(), tree.blobs.len()), (1, 0));
    let top = tree.knots.last().unwrap();
    assert_eq!(top.point.z, 3.0);
    assert!((top.radius - 3.0 * 0.08 * 0.3).abs() < 1e-12, "three tenths as wide as its body");
}

#[test]
fn the_largest_setting_of_the_report_has_48_branches_and_blobs() {
    let numbers = [
        ("trunks", 4.0),
        ("root_quantity", 100.0),
        ("branch_quantity", 100.0),
        ("leaves_quantity", 100.0),
        ("dead_branches", 0.0),
    ];
    let tree = tree(&numbers, 1);
    assert_eq!(count(&tree, StemKind::Branch), 48);
    assert_eq!((count(&tree, StemKind::Trunk), count(&tree, StemKind::Fork)), (1, 3));
    assert!((14..=16).contains(&count(&tree, StemKind::Root)));
    assert_eq!(tree.blobs.len(), 48);
}

#[test]
fn trunks_are_drawn_from_randomness_unless_they_are_said_and_low_trees_have_one() {
    let trunks = |numbers: &[(&str, f64)]| -> Vec<usize> {
        let of = |seed| {
            let tree = tree(numbers, seed);
            count(&tree, StemKind::Trunk) + count(&tree, StemKind::Fork)
        };
        (0..40).map(of).collect()
    };
    assert!(trunks(&[]).iter().all(|n| *n == 1));
    let drawn = trunks(&[("trunk_randomness", 1.0)]);
    assert!((1..=4).all(|n| drawn.contains(&n)), "{drawn:?}");
    assert!(trunks(&[("trunks", 3.0)]).iter().all(|n| *n == 3));
    assert!(trunks(&[("trunks", 3.0), ("trunk_height", 0.65)]).iter().all(|n| *n == 1));
}

#[test]
fn the_parting_of_several_trunks_stays_bare() {
    let numbers = [("trunks", 3.0), ("branch_quantity", 100.0), ("trunk_height", 2.0)];
    for seed in 0..20 {
        let tree = tree(&numbers, seed);
        let parting = tree.knots_of(&tree.stems[1])[0].point.z;
        let branches = tree.stems.iter().filter(|stem| stem.kind == StemKind::Branch);
        let lowest = branches.map(|stem| tree.knots_of(stem)[0].point.z).fold(f64::INFINITY, f64::min);
        assert!(lowest > parting + 0.3, "{lowest} {parting}");
    }
}

#[test]
fn dead_branches_are_stubs_without_leaves() {
    let numbers =
        |dead: f64| [("branch_quantity", 100.0), ("leaves_quantity", 100.0), ("dead_branches", dead)];
    let (living, dead) = (tree(&numbers(0.0), 3), tree(&numbers(1.0), 3));
    let length = |tree: &Tree| tree.length_of(&tree.stems[5]);
    assert!((length(&dead) / length(&living) - 1.0 / 3.0).abs() < 1e-3);
    assert_eq!(living.blobs.len(), 12);
    // A tree whose branches are all dead has foliage on its trunk, as one without branches has.
    assert!(dead.blobs.iter().all(|blob| blob.stem == 0));
}

#[test]
fn tropism_lifts_ends_and_lets_them_hang() {
    let end = |tropism: f64| {
        let tree = tree(&[("branch_quantity", 10.0), ("tropism", tropism)], 2);
        tree.knots.last().unwrap().point.z
    };
    assert!(end(1.0) > end(0.0) + 0.1 && end(0.0) > end(-1.0) + 0.1);
}

#[test]
fn one_more_root_leaves_branches_and_blobs_as_they_are() {
    let numbers =
        |roots: f64| [("branch_quantity", 60.0), ("leaves_quantity", 60.0), ("root_quantity", roots)];
    let (few, many) = (tree(&numbers(10.0), 4), tree(&numbers(100.0), 4));
    let ends = |tree: &Tree| -> Vec<_> {
        let branches = tree.stems.iter().filter(|stem| stem.kind == StemKind::Branch);
        branches.flat_map(|stem| tree.knots_of(stem).to_vec()).collect()
    };
    assert!(few.stems.len() < many.stems.len());
    assert_eq!(ends(&few), ends(&many));
    assert_eq!(few.blob_vertices, many.blob_vertices);
}

#[test]
fn a_blob_has_about_thirty_vertices_at_the_lowest_level_and_four_times_as_many_at_each_next() {
    let mean = |level: f64| {
        let numbers = [("branch_quantity", 100.0), ("leaves_quantity", 100.0), ("subdivision", level)];
        let tree = tree(&numbers, 1);
        tree.blob_vertices.len() as f64 / tree.blobs.len() as f64
    };
    let means = [0.0, 1.0, 2.0, 3.0].map(mean);
    assert!((26.0..36.0).contains(&means[0]), "{means:?}");
    assert!(means.windows(2).all(|w| (3.0..5.0).contains(&(w[1] / w[0]))), "{means:?}");
}

#[test]
fn nothing_reaches_into_the_ground_but_roots() {
    for name in ["stylised_willow", "stylised_bush", "stylised_palm"] {
        let species = preset(&StylisedFamily, name).unwrap();
        for seed in 0..10 {
            let tree = species.grow(seed).unwrap();
            let lowest = tree.blob_vertices.iter().map(|v| v.z).fold(f32::INFINITY, f32::min);
            assert!(lowest > -1e-4, "{name} {seed}: {lowest}");
        }
    }
}

#[test]
fn too_much_detail_for_the_limits_is_an_error_before_it_is_made() {
    let numbers = [("branch_quantity", 100.0), ("leaves_quantity", 100.0), ("subdivision", 3.0)];
    let limits = Limits { work: 100_000, ..Limits::DEFAULT };
    let error = species(&numbers).grow_with(&Growth { limits, ..Growth::seed(1) }).unwrap_err();
    assert!(matches!(error, GrowError::TooMuchWork { limit: 100_000, .. }), "{error}");
    let limits = Limits { leaves: 3, ..Limits::DEFAULT };
    let error = species(&numbers).grow_with(&Growth { limits, ..Growth::seed(1) }).unwrap_err();
    assert!(matches!(error, GrowError::TooManyLeaves { limit: 3, .. }), "{error}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]
    /// Any numbers, the ends of their ranges more often than others: zero heights and widths among them.
    #[test]
    fn any_numbers_grow_closed_surfaces(
        drawn in prop::collection::vec((0_u32..4, 0.0_f64..=1.0), 22),
        seed in 0_u64..1000,
    ) {
        let species = species(&[]);
        let space = species.generator.space().clone();
        let mut values = pleach_tree::conformance::at_ends_or_between(&space, &drawn);
        // The two finest levels are for few, and the same code.
        let subdivision = space.find("subdivision").unwrap().0;
        values[subdivision] = values[subdivision].min(1.0);
        let params = space.check(values).unwrap();
        let tree = Species { params, ..species }.grow(seed).unwrap();
        prop_assert_eq!(tree.well_formed(), Ok(()));
        for blob in 0..tree.blobs.len() {
            prop_assert!(volume(&tree, blob) > 0.0, "blob {}", blob);
        }
    }
}
