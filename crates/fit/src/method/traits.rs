//! What an optimiser does, and what its settings say.

use super::Start;
use crate::problem::{Genome, Score};
use crate::space::SearchSpace;

/// An optimiser that is asked for individuals and told their scores.
pub trait Method {
    /// A short name, as on the command line.
    fn name(&self) -> &'static str;

    /// How many batches may be without scores when the next one is made: 0 for a method that needs the scores
    /// of one batch to make the next.
    ///
    /// Evaluation is asynchronous: with a staleness above 0, threads have work while others are busy with the
    /// slowest tree of a batch. The number is exact, not an upper bound, so that the search has the same bits on
    /// any number of threads. Called whenever a batch could be made.
    fn max_staleness(&self) -> usize {
        0
    }

    /// Appends the individuals of the next batch to `members`; at least one. A batch is a generation, or a part
    /// of one.
    ///
    /// Called with at most [`Method::max_staleness`] batches that [`Method::tell`] has not been called for.
    fn ask(&mut self, space: &SearchSpace, members: &mut Vec<Genome>);

    /// Takes the scores of the oldest batch without scores, in the order of its individuals.
    fn tell(&mut self, space: &SearchSpace, members: &[Genome], scores: &[Score]);

    /// Whether the batch that was told last ends a generation.
    fn ends_generation(&self) -> bool {
        true
    }

    /// Whether this can be the state of a search in `space` that has finished `generations` and waits for
    /// the scores of batches of the sizes `pending`, oldest first.
    ///
    /// A state that was read from a file may be anything that its format allows. One that suits neither panics
    /// nor asks for more memory than the settings do; it need not make sense.
    fn suits(&self, space: &SearchSpace, generations: u64, pending: &[usize]) -> bool;
}

/// The settings of an optimiser.
pub trait MethodSettings: Clone + Default + PartialEq {
    /// The optimiser.
    type Method: Method;

    /// The optimiser at its beginning.
    fn begin(&self, seed: u64, start: Start) -> Self::Method;

    /// Whether `method` was begun with these settings, this seed and this start.
    fn has_begun(&self, method: &Self::Method, seed: u64, start: &Start) -> bool;

    /// Whether trees are resized to the goal's height before they are compared: see
    /// [`crate::Evaluator::with_height_matching`].
    fn matches_height(&self) -> bool {
        true
    }

    /// Whether only what is [plausible](pleach_tree::Param::plausible) is searched, and not all of the
    /// search ranges.
    fn keeps_to_plausible(&self) -> bool {
        true
    }

    /// Weight of the prior around the start: see [`SearchSpace::with_prior`].
    fn prior(&self) -> f64 {
        0.0
    }
}
