//! Problems that several test programs share.

use pleach_fit::{FitProblem, GoalView};
use pleach_silhouette::{Bitmap, Detail, Frame, Rasteriser, View};
use std::sync::Arc;

/// The leafy front view of a known species' tree of seed 1, `size` pixels square, as a goal.
pub(crate) fn own_goal(species: &str, size: u32) -> FitProblem {
    let species = pleach_generators::preset(species).expect("a known species");
    let tree = species.grow(1).expect("a species grows");
    let frame = Frame::automatic(&tree, &View::FRONT, true, size, size);
    let mut goal = Bitmap::default();
    // Drawn as the evaluator draws, so that the truth is a perfect match.
    Rasteriser::with_detail(Detail::Half).draw(&tree, &View::FRONT, &frame, true, &mut goal);
    FitProblem {
        generator: Arc::clone(&species.generator),
        base: species.params.values().to_vec(),
        goals: vec![GoalView { goal, view: View::FRONT, frame }],
        foliage: true,
    }
}
