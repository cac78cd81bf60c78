//! Crowns that grow into hulls.

use pleach_space_colonization::SpaceColonizationFamily;
use pleach_tree::{DENSEST, Hull, HullView, Individual, Species, Tree};

const CELL: f64 = 0.02;

/// A hull that is one or two balls at height 0.6, seen from the front.
fn hull(middles: &[f64], radius: f64, density: u8) -> Hull {
    let cell = |row: usize, column: usize| {
        let (up, across) = ((row as f64 + 0.5) * CELL, (column as f64 + 0.5) * CELL - 1.0);
        let is_in = middles.iter().any(|middle| (across - middle).hypot(up - 0.6) < radius);
        if is_in { density } else { 0 }
    };
    let rows = (0..50).map(|row| (0..100).map(|column| cell(row, column)).collect()).collect();
    Hull { views: vec![HullView { azimuth: 0.0, cell: CELL, left: -1.0, rows }], ..Hull::default() }
}

fn oak() -> Species {
    pleach_tree::species::preset(&SpaceColonizationFamily, "english_oak").unwrap()
}

fn grown(hull: Hull) -> Tree {
    oak().with_individual(3, Individual::with_hull(hull)).grow(3).unwrap()
}

/// Parts of the leaves in columns of the width 0.1, from the left at -0.5.
fn columns(tree: &Tree) -> [f64; 10] {
    let height = oak().params.values()[0];
    let mut parts = [0.0; 10];
    for leaf in &tree.leaves {
        let column = ((f64::from(leaf.position.x) / height + 0.5) * 10.0).clamp(0.0, 9.0);
        parts[column as usize] += 1.0 / tree.leaves.len() as f64;
    }
    parts
}

#[test]
fn a_crown_stands_where_its_hull_does() {
    let right = columns(&grown(hull(&[0.3], 0.3, 6)));
    assert!(right[6..].iter().sum::<f64>() > 0.8, "{right:?}");
    let two = columns(&grown(hull(&[-0.3, 0.3], 0.2, 6)));
    assert!(two[4..6].iter().sum::<f64>() < 0.12 && two[..4].iter().sum::<f64>() > 0.3, "{two:?}");
}

#[test]
fn a_denser_hull_has_more_leaves() {
    let [thin, own, dense] =
        [2, 6, DENSEST].map(|density| grown(hull(&[0.0], 0.4, density)).leaves.len() as f64);
    assert!(thin < 0.7 * own && own < 0.95 * dense, "{thin} {own} {dense}");
}

#[test]
fn trunks_take_the_course_that_is_shown_and_seeds_fill_hulls_differently() {
    let trunk: Vec<[f64; 2]> =
        (0..=10).map(|i| [0.1 * (f64::from(i) / 10.0).powi(2), f64::from(i) * 0.03]).collect();
    let tree = |seed| grown(Hull { trunk: trunk.clone(), seed, ..hull(&[0.1], 0.3, 6) });
    let height = oak().params.values()[0];
    let (one, other) = (tree(0), tree(1));
    for tree in [&one, &other] {
        for knot in tree.knots_of(&tree.stems[0]).iter().filter(|knot| knot.point.z < 0.12 * height) {
            let (z, x) = (knot.point.z / height, knot.point.x / height);
            let shown = 0.1 * (z / 0.3).powi(2);
            assert!((x - shown).abs() < 0.012, "{x} at {z}, shown {shown}");
        }
    }
    assert!(one != other);
}
