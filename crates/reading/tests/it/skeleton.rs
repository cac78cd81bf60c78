//! Grown trees: the truth of their skeletons, and readings of their pictures.

use pleach_plant::Parts;
use pleach_plant::glam::{DVec3, dvec3};
use pleach_reading::Reading;
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::{Knot, Stem, StemKind, Tree};

/// A tree of straight stems: parent, from, to, radii.
fn tree(stems: &[(Option<u32>, DVec3, DVec3, f64, f64)]) -> Tree {
    let mut tree = Tree::default();
    for &(parent, from, to, thick, thin) in stems {
        let third = (to - from) / 3.0;
        let kind = if parent.is_some() { StemKind::Branch } else { StemKind::Trunk };
        let first_knot = tree.knots.len() as u32;
        let level = u16::from(parent.is_some());
        tree.stems.push(Stem { parent, level, kind, number: 0, offset: 0.0, first_knot, knot_count: 2 });
        let knot = |point: DVec3, radius| Knot {
            point,
            handle_in: point - third,
            handle_out: point + third,
            radius,
        };
        tree.knots.extend([knot(from, thick), knot(to, thin)]);
    }
    tree.well_formed().unwrap();
    tree
}

fn both(tree: &Tree) -> (Reading, Reading) {
    let frame = Frame::automatic(tree, &View::FRONT, Parts::LEAFY, 256, 256);
    let mut picture = Bitmap::default();
    Rasterizer::new().draw(tree, &View::FRONT, &frame, Parts::LEAFY, &mut picture);
    let truth = Reading::from_skeleton(tree, &View::FRONT, &frame, Parts::LEAFY);
    (Reading::from_silhouette(&picture), truth)
}

#[test]
fn the_truth_is_that_of_the_stems() {
    let lean = 0.2;
    let fork = dvec3(1.0 + 4.0 * lean, 0.0, 4.0);
    let (read, truth) = both(&tree(&[
        (None, dvec3(1.0, 0.0, 0.0), dvec3(1.0 + 10.0 * lean, 0.0, 10.0), 0.3, 0.2),
        (Some(0), fork, fork + dvec3(-3.0, 0.0, 4.0), 0.22, 0.15),
        (Some(0), dvec3(1.0 + 3.0 * lean, 0.0, 3.0), dvec3(4.0, 0.0, 4.0), 0.06, 0.05),
    ]));
    let is_near = |value: f64, expected: f64, tolerance: f64| {
        assert!((value - expected).abs() <= tolerance, "{value}, not {expected}");
    };
    assert_eq!(truth.feet.len(), 1);
    is_near(truth.feet[0].width, 0.0587, 0.002);
    is_near(truth.lean_deg.unwrap(), 11.3, 0.2);
    is_near(truth.first_fork.unwrap(), 0.4, 0.01);
    is_near(truth.bare_height.unwrap(), 0.32, 0.02);
    assert!(!truth.leaves && truth.first_fork_confidence == 1.0);
    assert_eq!(read.feet.len(), 1);
    is_near(read.feet[0].width, truth.feet[0].width, 0.005);
    is_near(read.lean_deg.unwrap(), truth.lean_deg.unwrap(), 1.0);
    is_near(read.bare_height.unwrap(), truth.bare_height.unwrap(), 0.03);
    is_near(read.first_fork.unwrap(), truth.first_fork.unwrap(), 0.05);
}

#[test]
fn a_clump_has_as_many_feet_as_stems() {
    let pole = |x: f64| (None, dvec3(x, 0.0, 0.0), dvec3(1.3 * x, 0.0, 10.0), 0.2, 0.1);
    let (read, truth) = both(&tree(&[pole(-2.0), pole(0.0), pole(2.5)]));
    assert_eq!((read.feet.len(), truth.feet.len()), (3, 3));
    for (read, truth) in read.feet.iter().zip(&truth.feet) {
        assert!((read.x - truth.x).abs() < 0.01 && (read.width - truth.width).abs() < 0.006);
    }
    assert_eq!(both(&Tree::default()).1, Reading::default());
}

#[test]
fn known_species_are_leafy_with_their_leaves() {
    for name in ["stylised_round", "cambridge_oak", "lombardy_poplar", "palm"] {
        let tree = pleach_generators::species(name).unwrap().grow(1).unwrap();
        let (read, truth) = both(&tree);
        assert!(read.leaves && truth.leaves, "{name}");
    }
}
