//! What foresters measure of a tree.

use crate::stats::Bounds;
use crate::tree::{Parts, Stem, StemKind, Tree};
use serde::Serialize;

/// Height above the ground at which the diameter of a trunk is measured, in metres.
pub const BREAST_HEIGHT: f64 = 1.3;

/// Share of the leaves that may hang below the base of the crown: a twig on the trunk is not a crown.
const BELOW_CROWN: f64 = 0.02;
/// Parts of one Bézier piece between which a height is looked for.
const STEPS: u32 = 16;

/// Sizes of one tree, in metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Dendrometry {
    /// From the ground to the highest bark, leaf or blossom.
    pub height: f64,
    /// Mean of the widths of the whole tree along x and along y.
    pub crown_width: f64,
    /// From the ground to the base of the crown: the height below which one leaf in fifty hangs, or
    /// where the lowest branch starts on a tree without leaves.
    pub crown_base: f64,
    /// Diameter of the trunk 1.3 m above the ground; of several trunks and forks the root of the sum
    /// of the squares, as of one trunk with the same area. None for a tree that is not as high.
    pub stem_diameter: Option<f64>,
}

impl Dendrometry {
    /// Measures `tree`; all is 0 for a tree without stems.
    #[must_use]
    pub fn new(tree: &Tree) -> Self {
        let Some(bounds) = Bounds::new(tree, Parts::LEAFY) else {
            return Self { height: 0.0, crown_width: 0.0, crown_base: 0.0, stem_diameter: None };
        };
        let size = bounds.max - bounds.min;
        let trunks = tree.stems.iter().filter(|stem| stem.level == 0 && stem.kind != StemKind::Root);
        let squares: f64 =
            trunks.filter_map(|stem| diameter_at(tree, stem, BREAST_HEIGHT)).map(|d| d * d).sum();
        Self {
            height: bounds.max.z,
            crown_width: f64::midpoint(size.x, size.y),
            crown_base: crown_base(tree),
            stem_diameter: (squares > 0.0).then(|| squares.sqrt()),
        }
    }
}

/// Diameter of `stem` where it first passes the height `z`.
fn diameter_at(tree: &Tree, stem: &Stem, z: f64) -> Option<f64> {
    tree.pieces_of(stem).find_map(|(piece, from, to)| {
        let height = |step: u32| piece.at(f64::from(step) / f64::from(STEPS)).z - z;
        (0..STEPS).find_map(|step| {
            let (low, high) = (height(step), height(step + 1));
            (low < 0.0 && high >= 0.0).then(|| {
                let t = (f64::from(step) + low / (low - high)) / f64::from(STEPS);
                2.0 * (from + (to - from) * t)
            })
        })
    })
}

fn crown_base(tree: &Tree) -> f64 {
    let mut leaves: Vec<f32> = tree.leaves.iter().map(|leaf| leaf.position.z).collect();
    if leaves.is_empty() {
        let branches = tree.stems.iter().filter(|stem| stem.level > 0 && stem.kind != StemKind::Root);
        let lowest = branches.map(|stem| tree.knots_of(stem)[0].point.z).fold(f64::INFINITY, f64::min);
        return if lowest.is_finite() { lowest.max(0.0) } else { 0.0 };
    }
    let below = (leaves.len() as f64 * BELOW_CROWN) as usize;
    f64::from(*leaves.select_nth_unstable_by(below, f32::total_cmp).1).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::leaf_shape::LeafShape;
    use crate::tree::{Knot, Leaf};
    use glam::{DVec3, Vec3, dvec3, vec3};
    use std::sync::Arc;

    /// A straight stem from the ground at `x`, 10 m high, of radius 0.3 m that goes to 0.
    fn trunk(tree: &mut Tree, x: f64) {
        let knot = |z: f64, radius| Knot {
            point: dvec3(x, 0.0, z),
            handle_in: dvec3(x, 0.0, z - 10.0 / 3.0),
            handle_out: dvec3(x, 0.0, z + 10.0 / 3.0),
            radius,
        };
        let first_knot = tree.knots.len() as u32;
        tree.knots.extend([knot(0.0, 0.3), knot(10.0, 0.0)]);
        tree.stems.push(Stem {
            parent: None,
            level: 0,
            kind: StemKind::Trunk,
            number: 0,
            offset: 0.0,
            first_knot,
            knot_count: 2,
        });
    }

    #[test]
    fn a_cone_is_measured_as_computed_by_hand() {
        let mut tree = Tree::default();
        trunk(&mut tree, 0.0);
        let one = Dendrometry::new(&tree);
        // 0.6 m at the foot, nothing 10 m above it.
        let expected = 0.6 * (1.0 - 1.3 / 10.0);
        assert!((one.stem_diameter.unwrap() - expected).abs() < 1e-9, "{one:?}");
        assert!((one.height - 10.0).abs() < 1e-9 && (one.crown_width - 0.6).abs() < 1e-9);
        trunk(&mut tree, 2.0);
        let two = Dendrometry::new(&tree);
        assert!((two.stem_diameter.unwrap() - expected * 2.0_f64.sqrt()).abs() < 1e-9);
    }

    #[test]
    fn a_leaf_on_the_trunk_does_not_lower_the_crown() {
        let mut tree = Tree::default();
        trunk(&mut tree, 0.0);
        tree.leaf_shapes.push(Arc::clone(LeafShape::Linear.outline()));
        let leaf = |z: f32| {
            let position = vec3(0.0, 0.0, z);
            Leaf { position, along: Vec3::Z, across: Vec3::X, stem: 0, shape: 0 }
        };
        tree.leaves.extend((0..100).map(|i| leaf(4.0 + i as f32 * 0.05)));
        tree.leaves.push(leaf(0.5));
        let crown = Dendrometry::new(&tree).crown_base;
        assert!((4.0..4.2).contains(&crown), "{crown}");
    }

    #[test]
    fn what_is_not_there_is_not_measured() {
        let none = Dendrometry::new(&Tree::default());
        assert_eq!((none.height, none.stem_diameter), (0.0, None));
        let mut low = Tree::default();
        trunk(&mut low, 0.0);
        for knot in &mut low.knots {
            for point in [&mut knot.point, &mut knot.handle_in, &mut knot.handle_out] {
                *point *= DVec3::new(1.0, 1.0, 0.1);
            }
        }
        assert_eq!(Dendrometry::new(&low).stem_diameter, None);
    }
}
