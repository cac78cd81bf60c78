//! Matching the height of trees to the goal's.

use crate::problem::GoalView;
use pleach_silhouette::Projection;
use pleach_tree::{Foliage, Leaf, Tree};

/// How far a tree's height may be from the goal's before it is resized, in pixels: the tip of a tree
/// is thinner than a pixel and leaves no ink.
const TOLERANCE: f64 = 2.0;
/// Trees that would have to be resized by more than this factor are scored as they are.
const MAX_RESIZING: f64 = 100.0;

/// The height of the goal's tree, in metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct GoalHeight {
    goal: f64,
    tolerance: f64,
}

impl GoalHeight {
    /// The height, if the picture shows it: in a level view without perspective, with paper above the tree.
    pub(super) fn new(goal: &GoalView) -> Option<Self> {
        let GoalView { goal, view, frame, .. } = goal;
        let is_level = view.elevation == 0.0 && view.projection == Projection::Orthographic;
        let top = goal.ink_box().map_or(0, |(_, top, _, _)| top);
        let goal = (frame.ground_row - f64::from(top)) * frame.meters_per_pixel;
        let tolerance = TOLERANCE * frame.meters_per_pixel;
        (is_level && top > 0 && goal > tolerance).then_some(Self { goal, tolerance })
    }

    /// The factor that brings a tree of `height` metres to the goal's height; `None` within the tolerance.
    pub(super) fn factor(self, height: f64) -> Option<f64> {
        let factor = self.goal / height;
        let is_off = (height - self.goal).abs() > self.tolerance;
        (is_off && (1.0 / MAX_RESIZING..MAX_RESIZING).contains(&factor)).then_some(factor)
    }
}

/// Metres from the ground to the highest knot or, with leaves, middle line of a leaf: the height to a pixel or two,
/// at a fraction of the cost of [`pleach_tree::Bounds`].
pub(crate) fn height_of(tree: &Tree, foliage: Foliage) -> f64 {
    let knots = tree.knots.iter().map(|knot| knot.point.z).fold(0.0, f64::max);
    if foliage == Foliage::None {
        return knots;
    }
    let leaves = tree.leaves.iter().chain(&tree.blossoms);
    let top = |leaf: &Leaf| leaf.position.z + leaf.along.z.max(0.0);
    let leaves = leaves.map(top).fold(0.0, f32::max);
    let blobs = tree.blob_vertices.iter().map(|v| v.z).fold(0.0, f32::max);
    knots.max(f64::from(leaves.max(blobs)))
}
