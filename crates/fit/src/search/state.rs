//! The state of a search: what it knows, and what a checkpoint holds.

use super::finalists::Finalists;
use crate::method::{Method, Start, is_individual};
use crate::problem::{Genome, Score, Scored, Size};
use crate::space::SearchSpace;
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// Everything that a search knows and that a checkpoint holds.
///
/// A generation may be evaluated in any number of chunks without a change to the result: the method is
/// told of a batch only once all of it has scores. Nor does it matter when individuals are asked for: a batch
/// is made as soon as the method's [staleness](Method::max_staleness) allows it, and no later.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SearchState<M> {
    /// The optimiser.
    pub method: M,
    /// Finished generations.
    pub generation: u64,
    /// Individuals evaluated.
    pub evaluations: u64,
    /// The best individual ever seen, by cost and prior together; `None` before the first evaluation. Its score
    /// is without the prior.
    pub best: Option<Scored>,
    /// Former bests.
    pub(crate) finalists: Finalists,
    /// Score of the best individual of the last finished generation, with the prior.
    pub generation_best: Option<Score>,
    /// Likewise of the finished batches of the present generation.
    pub(super) best_so_far: Option<Score>,
    /// Batches without all of their scores, oldest first.
    pub(super) pending: VecDeque<Vec<Genome>>,
    /// Scores of the first individuals of the oldest.
    pub(super) scores: Vec<Score>,
    /// Largest trees that are tried.
    pub(super) max_size: Size,
}

/// How much larger than the best tree of the first generation another may be.
///
/// Times differ a thousandfold between parameter lists, and a crown of ten times the leaves covers
/// the goal no worse: without a bound that stays, a search drifts to trees that take ten times as
/// long and makes a tenth of the trials.
const MAX_GROWTH: usize = 2;

/// Trees up to this size are never abandoned: they take some three milliseconds.
const ALWAYS_TRIED: Size = Size { stems: 2_000, leaves: 12_000, knots: 12_000 };

/// The largest trees of a search whose first generation has a best of size `first`.
pub(super) fn max_size_after(first: Size) -> Size {
    Size {
        stems: ALWAYS_TRIED.stems.max(MAX_GROWTH.saturating_mul(first.stems)),
        leaves: ALWAYS_TRIED.leaves.max(MAX_GROWTH.saturating_mul(first.leaves)),
        knots: ALWAYS_TRIED.knots.max(MAX_GROWTH.saturating_mul(first.knots)),
    }
}

impl<M> SearchState<M> {
    /// The state before the first generation of a search from `start`.
    ///
    /// Given lists are tried however large their trees are, random ones are not.
    #[must_use]
    pub const fn new(method: M, start: &Start) -> Self {
        Self {
            method,
            generation: 0,
            evaluations: 0,
            best: None,
            finalists: Finalists::new(),
            generation_best: None,
            best_so_far: None,
            pending: VecDeque::new(),
            scores: Vec::new(),
            max_size: if matches!(start, Start::Random) { ALWAYS_TRIED } else { Size::ANY },
        }
    }

    /// Whether the last score was the last of a generation.
    #[must_use]
    pub const fn is_between_generations(&self) -> bool {
        self.scores.is_empty() && self.best_so_far.is_none()
    }

    /// Largest trees that are tried.
    pub(crate) const fn max_size(&self) -> Size {
        self.max_size
    }

    /// Whether this can be the state of a search in `space`: a state read from a file may be anything.
    pub(crate) fn suits(&self, space: &SearchSpace) -> bool
    where
        M: Method,
    {
        let sizes: Vec<usize> = self.pending.iter().map(Vec::len).collect();
        sizes.first().map_or(self.scores.is_empty(), |&first| self.scores.len() < first)
            && sizes.iter().all(|&size| size > 0)
            && (self.pending.iter().flatten())
                .chain(self.best.iter().map(|best| &best.genome))
                .all(|g| is_individual(g, space))
            && self.finalists.suit(space)
            && self.method.suits(space, self.generation, &sizes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trees_may_be_twice_as_large_as_the_first_best_and_small_ones_are_always_tried() {
        let small = Size { stems: 1, leaves: 1, knots: 1 };
        assert_eq!(max_size_after(small), ALWAYS_TRIED);
        let large = Size { stems: 5_000, leaves: 40_000, knots: 60_000 };
        assert_eq!(max_size_after(large), Size { stems: 10_000, leaves: 80_000, knots: 120_000 });
    }
}
