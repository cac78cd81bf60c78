//! Where a tree stands in a goal at the goal's own size.

use pleach_fit::{Accuracy, GoalView, HEAVY, Placement, Steps, register};
use pleach_silhouette::goal::Goal;
use pleach_tree::{Foliage, Tree};

/// Where `tree`, the result of a fit, stands in `full`, of which the fit has compared `working`, registered as
/// `fitted`: at a larger size a small part of a pixel is a larger one. Multiplies and moves the frame
/// `full.frame(height)`.
#[must_use]
pub fn place_at_full_size(
    tree: &Tree,
    foliage: Foliage,
    (full, working): (&Goal, &Goal),
    fitted: &GoalView,
    height: f64,
) -> Placement {
    let ratio = full.height_in_pixels() / working.height_in_pixels();
    if fitted.accuracy == Accuracy::Exact || ratio <= 1.0 {
        return fitted.registered;
    }
    let last = if tree.leaves.len() > HEAVY { 1.0 / 16.0 } else { 1.0 / 64.0 };
    let steps = Steps { first: ratio / 4.0, last };
    let frame = full.frame(height);
    register(tree, foliage, &full.bitmap, &fitted.view, &frame, &fitted.registered, steps)
}
