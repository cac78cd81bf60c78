//! Trees as goals.

use pleach_fit::GoalView;
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::{Parts, Tree};

/// Side of every goal in pixels.
pub(super) const SIZE: u32 = 256;

/// A picture of a whole tree, with its foliage or without, in the frame that suits it.
pub(super) fn pictured(tree: &Tree, view: View, foliage: bool) -> GoalView {
    let parts = Parts::with_foliage(foliage);
    let frame = Frame::automatic(tree, &view, parts, SIZE, SIZE);
    let mut goal = Bitmap::default();
    Rasterizer::new().draw(tree, &view, &frame, parts, &mut goal);
    GoalView::new(goal, view, frame)
}
