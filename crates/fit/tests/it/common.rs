//! Problems that several test programs share.

use pleach_fit::{FitProblem, GoalView};
use pleach_silhouette::{Bitmap, Detail, Frame, Rasterizer, View};
use pleach_tree::Parts;

/// The leafy front view of a known species' tree, `size` pixels square, as a goal.
pub(crate) fn goal_of(species: &str, seed: u64, size: u32) -> FitProblem {
    let species = pleach_generators::preset(species).expect("a known species");
    let tree = species.grow(seed).expect("a species grows");
    let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, size, size);
    let mut goal = Bitmap::default();
    // Drawn as the evaluator draws, so that the truth is a perfect match.
    Rasterizer::for_searches(Detail::Half).draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut goal);
    FitProblem::new(species, GoalView::new(goal, View::FRONT, frame))
}
