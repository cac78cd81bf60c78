//! Where the turtle goes.

use crate::classics::grammar;
use crate::facts::system;
use crate::table::rows;
use pleach_lsystem::{Derivation, GrowFault, LSystem, LSystemFamily};
use pleach_tree::{Foliage, Limits, StemKind, Tree};

fn grown(text: &str) -> Tree {
    let system = LSystem::read("test", text).unwrap_or_else(|e| panic!("{e}"));
    let mut tree = Tree::default();
    let derived = system.derive(&Derivation::default()).unwrap();
    derived.grow(&Limits::DEFAULT, Foliage::All, &mut tree).unwrap();
    assert_eq!(tree.well_formed(), Ok(()));
    tree
}

#[test]
fn curves_end_where_they_end() {
    for row in rows(include_str!("../data/lsystems_classic.csv")) {
        let tree = grown(&grammar(&row));
        let number = |i: usize| row[i].parse::<f64>().unwrap();
        let points: Vec<_> = tree.knots.iter().map(|k| k.point).collect();
        let extent = |f: fn(&glam::DVec3) -> f64| {
            points.iter().map(f).fold(f64::MIN, f64::max) - points.iter().map(f).fold(f64::MAX, f64::min)
        };
        // The table has its heading along y; here it is z, and its z is our -y.
        for (i, found) in [(9, extent(|p| p.x)), (10, extent(|p| p.z)), (11, extent(|p| p.y))] {
            assert!((found - number(i)).abs() < 2e-3, "{}: extent {found}, expected {}", row[0], row[i]);
        }
        let is_one_line = tree.stems.len() == 1;
        let end = points[points.len() - 1];
        for (i, found) in [(12, end.x), (13, end.z), (14, -end.y)] {
            let close = (found - number(i)).abs() < 2e-3;
            assert!(!is_one_line || close, "{}: ends at {found}, expected {}", row[0], row[i]);
        }
    }
}

#[test]
fn the_books_trees_have_their_sizes() {
    for row in rows(include_str!("../data/lsystems_trees.csv")) {
        let number = |i: usize| row[i].parse::<f64>().ok();
        let name = format!("abop_{}_{}", row[2], &row[0][3..]);
        let system = system(&name);
        let species = pleach_tree::species::preset(&LSystemFamily, &name).unwrap();
        let own = species.params.values();
        let mut params = own.to_vec();
        let set = |params: &mut Vec<f64>, name: &str, value| {
            if let Some(i) = system.params().iter().position(|p| p.name.text == name) {
                params[i] = value;
            }
        };
        set(&mut params, "size", 1.0);
        for tropism in [false, true] {
            if !tropism {
                set(&mut params, "e", 0.0);
            } else if let Some(i) = system.params().iter().position(|p| p.name.text == "e") {
                params[i] = own[i];
            } else {
                continue;
            }
            let derived =
                system.derive(&Derivation { params: Some(&params), ..Derivation::default() }).unwrap();
            assert_eq!(derived.count("F").to_string(), row[5], "{name}");
            assert_eq!(derived.len().to_string(), row[6], "{name}");
            let mut tree = Tree::default();
            derived.grow(&Limits::DEFAULT, Foliage::All, &mut tree).unwrap();
            let length: f64 = tree.stems.iter().map(|stem| tree.length_of(stem)).sum();
            assert!((length / number(7).unwrap() - 1.0).abs() < 1e-3, "{name}: {length}");
            let reach = tree.knots.iter().map(|k| k.point.x.hypot(k.point.y)).fold(0.0, f64::max);
            let height = tree.knots.iter().map(|k| k.point.z).fold(0.0, f64::max);
            let columns = if tropism { (10, 11) } else { (8, 9) };
            assert!((height / number(columns.0).unwrap() - 1.0).abs() < 2e-3, "{name}: {height}");
            assert!((reach / number(columns.1).unwrap() - 1.0).abs() < 2e-3, "{name}: {reach}");
        }
    }
}

#[test]
fn fractal_trees_as_a_grammar() {
    let text = "steps: 10\naxiom: A(300)\nA(l) -> F(l) [ +(30) A(0.75*l) ] [ -(30) A(0.75*l) ]";
    let tree = grown(text);
    assert_eq!(tree.stems.len(), 1023);
    let length: f64 = tree.stems.iter().map(|stem| tree.length_of(stem)).sum();
    let height = tree.knots.iter().map(|k| k.point.z).fold(0.0, f64::max);
    let width = tree.knots.iter().map(|k| k.point.x).fold(0.0, f64::max);
    assert!((length - 33_999.02).abs() < 0.01 && (height - 1067.4).abs() < 0.01, "{length} {height}");
    assert!((width - 673.42).abs() < 0.01, "{width}");
}

#[test]
fn empty_branches_leave_nothing_but_their_leaves() {
    let hewitt = |axiom: &str| grown(&format!("dialect: hewitt\naxiom: {axiom}"));
    let tree = hewitt("!(1) F(1) [ +(90) ] [ &(30) L(0, 45) [ +(45) F(2) ] ] F(1)");
    assert_eq!((tree.stems.len(), tree.leaves.len()), (2, 1));
    assert_eq!((tree.stems[1].parent, tree.stems[1].kind), (Some(0), StemKind::Branch));
    assert_eq!((tree.stems[1].level, tree.stems[1].offset), (1, 1.0));
    // A branch that is drawn only after its child began is the child's parent all the same.
    let tree = hewitt("F(1) [ [ F(1) ] F(1) ]");
    assert_eq!(tree.stems.iter().map(|s| s.parent).collect::<Vec<_>>(), [None, Some(0), Some(1)]);
    // Closing takes the radius at the end.
    assert_eq!(hewitt("!(1) F(1) %").knots.iter().map(|k| k.radius).collect::<Vec<_>>(), [0.5, 0.0]);
    // Radii follow the width with a lag of half a step.
    let radii: Vec<f64> = hewitt("!(1) F(1) !(0.5) F(1) F(1)").knots.iter().map(|k| k.radius).collect();
    assert_eq!(radii, [0.5, 0.375, 0.3125, 0.25]);
}

#[test]
fn leaves_are_spread_over_a_piece() {
    let tree = grown("dialect: hewitt\nleaf_scale: 0.1\naxiom: !(0.2) F(1, 4, 90, 90) F(1, 1, 90, 90)");
    let heights: Vec<f32> = tree.leaves.iter().map(|l| l.position.z).collect();
    assert!(heights.iter().zip([0.125, 0.375, 0.625, 0.875, 1.5]).all(|(a, b)| (a - b).abs() < 1e-6));
    for (leaf, turn) in tree.leaves.iter().zip(1..) {
        // The first is one turn away from below, and each a quarter farther, from piece to piece.
        let (sin, cos) = (turn as f32 * std::f32::consts::FRAC_PI_2).sin_cos();
        assert!((leaf.along.normalize() - glam::vec3(-sin, cos, 0.0)).length() < 1e-5, "{turn} {leaf:?}");
        assert!((leaf.position.x.hypot(leaf.position.y) - 0.1).abs() < 1e-6, "on the surface");
    }
}

#[test]
fn limits_come_before_memory() {
    let system = LSystem::read("test", "dialect: hewitt\naxiom: F(1, 100) [ F(1) ] [ F(1) ]").unwrap();
    let derived = system.derive(&Derivation::default()).unwrap();
    let grow = |limits| derived.grow(&limits, Foliage::All, &mut Tree::default());
    let default = Limits::DEFAULT;
    assert_eq!(grow(default), Ok(()));
    assert_eq!(grow(Limits { stems: 2, ..default }), Err(GrowFault::Stems));
    assert_eq!(grow(Limits { knots: 5, ..default }), Err(GrowFault::Knots));
    assert_eq!(grow(Limits { leaves: 99, ..default }), Err(GrowFault::Leaves));
    let nothing = LSystem::read("test", "axiom: X").unwrap();
    let nothing = nothing.derive(&Derivation::default()).unwrap();
    assert_eq!(nothing.grow(&default, Foliage::All, &mut Tree::default()), Err(GrowFault::NothingDrawn));
    let far = LSystem::read("test", "axiom: F(1e300) F(1e300)").unwrap();
    let far = far.derive(&Derivation::default()).unwrap();
    assert_eq!(far.grow(&default, Foliage::All, &mut Tree::default()), Err(GrowFault::NotFinite));
}
