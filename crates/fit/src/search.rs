//! A [`Method`] as an argmin [`Solver`].

use crate::genome::{Genome, Score, Scored, Size};
use crate::method::{Method, Start};
use crate::space::SearchSpace;
use argmin::core::{Error, KV, PopulationState, Problem, Solver, TerminationReason, TerminationStatus};
use argmin::kv;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// What individuals are scored against.
pub trait Evaluate {
    /// The scores of `genomes`, in their order, the same on any number of threads. A tree larger than
    /// `most` may be given up as one that does not grow.
    fn scores(&self, genomes: &[Genome], most: Size) -> Vec<Score>;

    /// Likeness of `genome` to the goal, in 0..=1; none for what is no picture.
    fn likeness(&self, genome: &Genome) -> Option<f64> {
        let _ = genome;
        None
    }
}

impl<T: Evaluate + ?Sized> Evaluate for &T {
    fn scores(&self, genomes: &[Genome], most: Size) -> Vec<Score> {
        (**self).scores(genomes, most)
    }

    fn likeness(&self, genome: &Genome) -> Option<f64> {
        (**self).likeness(genome)
    }
}

/// Everything that a search knows and that a checkpoint holds.
///
/// A generation may be evaluated in several batches. How many does not matter to the result: the
/// method is told only when the whole generation has its scores.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SearchState<M> {
    /// The optimiser.
    pub method: M,
    /// Finished generations.
    pub generation: u64,
    /// Individuals evaluated.
    pub evaluations: u64,
    /// The best individual ever seen, by cost and what draws it to the start together; none before the
    /// first. Its score is of the goal alone.
    pub best: Option<Scored>,
    /// Score of the best individual of the last finished generation, as the method was told it.
    pub generation_best: Option<Score>,
    members: Vec<Genome>,
    scores: Vec<Score>,
    /// Largest trees that are tried.
    most: Size,
}

/// How much larger than the best tree of the first generation another may be.
///
/// Times differ a thousandfold between parameter lists, and a crown of ten times the leaves covers
/// the goal no worse: without a bound that stays, a search drifts to trees that take ten times as
/// long and makes a tenth of the trials.
const MAX_GROWTH: usize = 2;

/// Trees up to this size are never given up: some three milliseconds.
const ALWAYS: Size = Size { stems: 2_000, leaves: 12_000, knots: 12_000 };

/// The largest trees of a search, once the first generation has shown how large its start is.
fn largest_after(first: Size) -> Size {
    Size {
        stems: ALWAYS.stems.max(MAX_GROWTH.saturating_mul(first.stems)),
        leaves: ALWAYS.leaves.max(MAX_GROWTH.saturating_mul(first.leaves)),
        knots: ALWAYS.knots.max(MAX_GROWTH.saturating_mul(first.knots)),
    }
}

impl<M> SearchState<M> {
    /// The state before the first generation of a search from `start`.
    ///
    /// Lists that were given are tried however large their trees are, random ones are not.
    #[must_use]
    pub const fn new(method: M, start: &Start) -> Self {
        Self {
            method,
            generation: 0,
            evaluations: 0,
            best: None,
            generation_best: None,
            members: Vec::new(),
            scores: Vec::new(),
            most: if matches!(start, Start::Random) { ALWAYS } else { Size::ANY },
        }
    }

    /// Whether the last batch finished a generation.
    #[must_use]
    pub const fn is_between_generations(&self) -> bool {
        self.members.is_empty()
    }
}

/// A method that searches a space, as argmin's executor runs it.
///
/// One iteration of the executor is one batch: a whole generation, unless [`Search::batch`] is
/// smaller. argmin's state then holds the best of the batch.
#[derive(Clone, Debug)]
pub struct Search<M> {
    /// What is known so far.
    pub state: SearchState<M>,
    /// Most individuals to evaluate in one iteration, at least 1. Changes nothing but when the
    /// executor gets to look up.
    pub batch: usize,
    /// Evaluations after which the search ends: never one more is made.
    pub evaluation_limit: u64,
    space: Arc<SearchSpace>,
}

/// The argmin state of a [`Search`].
pub type FitState = PopulationState<Genome, f64>;

impl<M> Search<M> {
    /// Starts `method`, whose first lists are those of `start`, in `space`, without a limit.
    #[must_use]
    pub const fn new(method: M, start: &Start, space: Arc<SearchSpace>) -> Self {
        Self::resume(SearchState::new(method, start), space)
    }

    /// Goes on from `state`.
    #[must_use]
    pub const fn resume(state: SearchState<M>, space: Arc<SearchSpace>) -> Self {
        Self { state, batch: usize::MAX, evaluation_limit: u64::MAX, space }
    }

    /// The space that is searched.
    #[must_use]
    pub const fn space(&self) -> &Arc<SearchSpace> {
        &self.space
    }
}

impl<M> Search<M> {
    /// What the search makes small, of the best individual: its cost and what draws it to the start.
    pub(crate) fn best_cost(&self) -> Option<f64> {
        self.state.best.as_ref().map(|best| best.score.cost + self.space.prior_cost(&best.genome))
    }
}

impl<M: Method> Search<M> {
    /// Evaluates the next batch with `score`; returns its best individual.
    fn step(
        &mut self,
        score: impl FnOnce(&[Genome], Size) -> Result<Vec<Score>, Error>,
    ) -> Result<Scored, Error> {
        let state = &mut self.state;
        if state.members.is_empty() {
            state.method.ask(&self.space, &mut state.members);
            // What a search starts from is the caller's; the exact truth may be among it.
            if state.generation > 0 {
                state.members.iter_mut().for_each(|member| self.space.settle(member));
            }
        }
        let first = state.scores.len();
        let room = usize::try_from(self.evaluation_limit - state.evaluations).unwrap_or(usize::MAX);
        let count = (state.members.len() - first).min(self.batch.max(1)).min(room);
        let batch = &state.members[first..first + count];
        let scores = score(batch, state.most)?;
        state.evaluations += count as u64;
        let batch = &mut state.members[first..first + count];
        for (member, score) in batch.iter_mut().zip(&scores) {
            self.space.resize(member, score.resized);
        }
        // What the method is told holds what draws numbers to the start; what is kept of the best does not.
        let space = &self.space;
        let told: Vec<Score> = scores
            .iter()
            .zip(&*batch)
            .map(|(score, member)| Score { cost: score.cost + space.prior_cost(member), ..*score })
            .collect();
        let (at, &of_top) = told
            .iter()
            .enumerate()
            .min_by(|a, b| a.1.cost.total_cmp(&b.1.cost))
            .ok_or_else(|| Error::msg("an empty batch: the method asked for nothing"))?;
        let top = Scored { genome: batch[at].clone(), score: scores[at] };
        if state
            .best
            .as_ref()
            .is_none_or(|best| of_top.cost < best.score.cost + space.prior_cost(&best.genome))
        {
            state.best = Some(top.clone());
        }
        state.scores.extend(told);
        if state.scores.len() == state.members.len() {
            state.method.tell(&self.space, &state.members, &state.scores);
            state.generation_best = state.scores.iter().copied().min_by(|a, b| a.cost.total_cmp(&b.cost));
            if let (0, Some(best)) = (state.generation, &state.best) {
                state.most = largest_after(best.score.size);
            }
            state.generation += 1;
            state.members.clear();
            state.scores.clear();
        }
        Ok(top)
    }
}

impl<O: Evaluate, M: Method> Solver<O, FitState> for Search<M> {
    fn name(&self) -> &str {
        self.state.method.name()
    }

    fn next_iter(
        &mut self,
        problem: &mut Problem<O>,
        state: FitState,
    ) -> Result<(FitState, Option<KV>), Error> {
        let top = self.step(|batch, most| {
            problem.bulk_problem("cost_count", batch.len(), |objective| Ok(objective.scores(batch, most)))
        })?;
        let log = kv!(
            "generation" => self.state.generation;
            "evaluations" => self.state.evaluations;
        );
        Ok((state.individual(top.genome).cost(top.score.cost), Some(log)))
    }

    fn terminate(&mut self, _: &FitState) -> TerminationStatus {
        if self.state.evaluations >= self.evaluation_limit {
            TerminationStatus::Terminated(TerminationReason::MaxItersReached)
        } else {
            TerminationStatus::NotTerminated
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::{Random, RandomSettings};
    use crate::space::{Freedom, TreeSeed};
    use crate::testing::{Function, cube};
    use argmin::core::{Executor, State};

    fn search() -> Search<Random> {
        let space =
            SearchSpace::of_params(cube(3, -1.0, 1.0), &[0.5; 3], &Freedom::default(), TreeSeed::Fixed(1));
        let settings = RandomSettings { population: 10 };
        Search::new(Random::new(settings, 1, Start::Random), &Start::Random, Arc::new(space.unwrap()))
    }

    fn run(search: Search<Random>) -> (SearchState<Random>, FitState) {
        let sphere = Function(argmin_testfunctions::sphere);
        let result = Executor::new(sphere, search).configure(|s| s.counting(true)).run().unwrap();
        (result.solver.state, result.state)
    }

    #[test]
    fn the_limit_is_exact_and_every_evaluation_counts() {
        let (state, argmin) = run(Search { evaluation_limit: 37, ..search() });
        assert_eq!((state.evaluations, state.generation), (37, 3));
        assert_eq!(argmin.get_func_counts()["cost_count"], 37);
        assert_eq!(argmin.get_best_param(), state.best.as_ref().map(|b| &b.genome));
    }

    #[test]
    fn batches_change_nothing() {
        let (whole, _) = run(Search { evaluation_limit: 57, ..search() });
        for batch in [1, 3, 7, 10, 11] {
            let (parts, _) = run(Search { batch, evaluation_limit: 57, ..search() });
            assert_eq!(parts, whole, "batches of {batch}");
        }
    }
}
