//! The figures of Coffey 2025 in numbers: counts, sizes and places, computed from the paper's rules.

use crate::{branches, grown};
use glam::{DVec3, dvec3};
use pleach_tree::{StemKind, Tree};

/// The trunk of Figures 9 and 10 in their pixels, in metres here.
const PLANE: (&str, f64) = ("trunk_length", 100.0);
/// Lengths below are the paper's times this.
const PLANE_UNIT: f64 = 100.0 / 300.0;
const SPACE: (&str, f64) = ("trunk_length", 93.75);
const SPACE_UNIT: f64 = 0.5;

/// Least and greatest coordinates of all nodes.
fn bounds(tree: &Tree) -> (DVec3, DVec3) {
    let points = || tree.knots.iter().map(|knot| knot.point);
    (points().reduce(DVec3::min).unwrap(), points().reduce(DVec3::max).unwrap())
}

fn total_length(tree: &Tree) -> f64 {
    tree.stems
        .iter()
        .flat_map(|stem| tree.knots_of(stem).windows(2))
        .map(|w| w[0].point.distance(w[1].point))
        .sum()
}

#[track_caller]
fn assert_near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-3, "{found}, expected {expected}");
}

/// The tree has nodes there, in the paper's pixels.
#[track_caller]
fn assert_nodes(tree: &Tree, unit: f64, nodes: &[DVec3]) {
    for node in nodes {
        let near = tree.knots.iter().any(|knot| knot.point.distance(*node * unit) < 1e-3);
        assert!(near, "there is a node at {node}");
    }
}

#[test]
fn figure_9_left() {
    let tree = grown("coffey_umbrella", &[PLANE]);
    assert_eq!((branches(&tree), tree.stems.len()), (127, 127));
    let (min, max) = bounds(&tree);
    assert_near(max.x, 584.8406 * PLANE_UNIT);
    assert_near(min.x, -584.8406 * PLANE_UNIT);
    assert_near(max.z, 983.1811 * PLANE_UNIT);
    assert_eq!((min.y, max.y, min.z), (0.0, 0.0, 0.0));
    assert_near(total_length(&tree), 9651.5625 * PLANE_UNIT);
    assert_nodes(&tree, PLANE_UNIT, &[dvec3(112.5, 0.0, 494.855_716), dvec3(258.642, 0.0, 579.231)]);
    assert!(tree.stems.iter().all(|stem| stem.level == 0), "a node without a central branch is a fork");
    assert!(tree.stems[1..].iter().all(|stem| stem.kind == StemKind::Fork));
}

#[test]
fn figure_9_right() {
    let tree = grown("coffey_fan", &[PLANE]);
    assert_eq!((branches(&tree), tree.stems.len()), (364, 243));
    let (min, max) = bounds(&tree);
    assert_near(max.x, 551.3176 * PLANE_UNIT);
    assert_near(min.x, -551.3176 * PLANE_UNIT);
    assert_near(max.z, 986.4258 * PLANE_UNIT);
    assert_near(total_length(&tree), 30_899.121_1 * PLANE_UNIT);
    let nodes = [dvec3(112.5, 0.0, 663.605_716), dvec3(196.875, 0.0, 640.997_636)];
    assert_nodes(&tree, PLANE_UNIT, &nodes);
    let trunk = tree.knots_of(&tree.stems[0]);
    assert_eq!(trunk.len(), 7, "the leader is one stem");
    assert!(trunk.iter().all(|knot| knot.point.x.abs() < 1e-9));
    assert_eq!(tree.level_count(), 6);
    assert!(tree.stems[1..].iter().all(|stem| stem.kind == StemKind::Branch));
}

#[test]
fn figure_11() {
    let tree = grown("coffey_turned_crown", &[SPACE]);
    assert_eq!(branches(&tree), 1023);
    let (min, max) = bounds(&tree);
    assert_near(max.x, 450.2865 * SPACE_UNIT);
    assert_near(min.y, -502.4854 * SPACE_UNIT);
    assert_near(max.z, 761.6275 * SPACE_UNIT);
    assert_near(total_length(&tree), 34_047.238_4 * SPACE_UNIT);
}

#[test]
fn figure_23() {
    let tree = grown("coffey_turned_fork", &[SPACE]);
    assert_eq!(branches(&tree), 127);
    let (min, max) = bounds(&tree);
    assert_near(max.x, 360.0647 * SPACE_UNIT);
    assert_near(max.y, 417.3875 * SPACE_UNIT);
    assert_near(min.x, -360.0647 * SPACE_UNIT);
    assert_near(max.z, 675.7739 * SPACE_UNIT);
    assert_near(total_length(&tree), 8076.108 * SPACE_UNIT);
    let nodes = [
        dvec3(65.9078, 55.3032, 310.3728),
        dvec3(104.451, 29.8903, 421.1365),
        dvec3(113.746, 153.1988, 360.6515),
    ];
    assert_nodes(&tree, SPACE_UNIT, &nodes);
    let halved: Vec<DVec3> = tree
        .knots
        .iter()
        .map(|knot| dvec3(-knot.point.x, -knot.point.y, knot.point.z) / SPACE_UNIT)
        .collect();
    assert_nodes(&tree, SPACE_UNIT, &halved);
}

#[test]
fn figure_25() {
    let size = ("trunk_length", 100.0);
    for (name, x, y, z) in
        [("coffey_long_arms", 84.359, 100.392, 219.542), ("coffey_whorls", 109.194, 102.327, 395.142)]
    {
        let tree = grown(name, &[size]);
        assert_eq!(branches(&tree), 1093, "{name}");
        let (min, max) = bounds(&tree);
        assert_near(max.x, x);
        assert_near(min.x, -x);
        assert_near(max.y, y);
        assert_near(max.z, z);
    }
}

#[test]
fn radii_fall_by_the_factor() {
    let tree = grown("coffey_turned_crown", &[]);
    let radius = |stem: usize| tree.knots_of(&tree.stems[stem])[0].radius;
    assert!((radius(0) - 0.1 * 2.5).abs() < 1e-12);
    for (index, stem) in tree.stems.iter().enumerate().skip(1) {
        assert!((radius(index) * 1.5 - radius(stem.parent.unwrap() as usize)).abs() < 1e-12);
    }
}

#[test]
fn da_vincis_rule_keeps_the_cross_section() {
    let area = ("thickness_rule", 2.0);
    for (sides, apical, ratio) in [(2.0, 0.0, 0.5_f64.sqrt()), (2.0, 1.0, 0.577_35), (4.0, 0.0, 0.5)] {
        let set = [area, ("side_branches", sides), ("apical_ratio", apical), ("generations", 3.0)];
        let tree = grown("coffey_turned_fork", &set);
        let trunk = tree.knots_of(&tree.stems[0]);
        assert_near(trunk[1].radius / trunk[0].radius, ratio);
        assert!(
            tree.stems[1..]
                .iter()
                .any(|stem| { (tree.knots_of(stem)[0].radius / trunk[0].radius - ratio).abs() < 1e-6 })
        );
    }
    // Unequal daughters: 0.8 of the parent ahead, 0.4 to the sides.
    let tree = grown("coffey_whorls", &[area, ("generations", 1.0)]);
    let radius = |stem: usize, knot: usize| tree.knots_of(&tree.stems[stem])[knot].radius;
    let section = radius(0, 1).powi(2) + radius(1, 0).powi(2) + radius(2, 0).powi(2);
    assert!((section - radius(0, 0).powi(2)).abs() < 1e-12);
    assert!((radius(0, 1) - 2.0 * radius(1, 0)).abs() < 1e-12);
}
