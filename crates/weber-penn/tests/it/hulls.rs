//! Crowns that grow into hulls, beside what else prunes a tree.

use super::behaviour::{read, with};
use glam::DVec3;
use pleach_tree::{DENSEST, Hull, HullView, Individual, Tree};

/// The tree of seed 1 with these lines, free and in a hull of half the height on the right.
fn free_and_hulled(lines: &str) -> [Tree; 2] {
    let rows = (0..16).map(|row| vec![if (4..12).contains(&row) { DENSEST } else { 0 }; 10]).collect();
    let view = HullView { azimuth: 0.0, cell: 0.05, left: 0.0, rows };
    let hull = Hull { views: vec![view], ..Hull::default() };
    let species = read(&with(lines)).unwrap();
    let hulled = species.with_individual(1, Individual::with_hull(hull));
    [species.grow(1).unwrap(), hulled.grow(1).unwrap()]
}

fn branch_points(tree: &Tree) -> Vec<DVec3> {
    let branches = tree.stems.iter().filter(|stem| stem.level > 0);
    branches.flat_map(|stem| tree.knots_of(stem)[1..].iter().map(|knot| knot.point)).collect()
}

#[test]
fn a_trunk_stands_as_ever_whether_the_envelope_prunes_or_not() {
    for lines in ["", "prune_ratio = 1"] {
        let [free, hulled] = free_and_hulled(lines);
        assert_eq!(free.knots_of(&free.stems[0]), hulled.knots_of(&hulled.stems[0]), "{lines}");
        let left = |tree: &Tree| branch_points(tree).iter().filter(|point| point.x < -0.5).count();
        assert!(
            left(&free) > 10 && left(&hulled) < left(&free) / 4,
            "{lines}: {} {}",
            left(&free),
            left(&hulled)
        );
        assert!(!branch_points(&hulled).is_empty(), "{lines}");
    }
}

#[test]
fn obstacles_stand_in_a_hull_too() {
    let wall = "prune_obstacles = [{ shape = \"box\", min = [1, -20, -1], max = [20, 20, 20] }]";
    let farthest = |tree: &Tree| branch_points(tree).iter().map(|point| point.x).fold(0.0, f64::max);
    let [_, open] = free_and_hulled("");
    let [_, walled] = free_and_hulled(wall);
    assert!(farthest(&open) > 1.2 && farthest(&walled) <= 1.0, "{} {}", farthest(&open), farthest(&walled));
}
