//! A [`Method`] at work in a space: generations in batches, and the best so far.

use crate::finalists::Finalists;
use crate::genome::{Genome, Score, Scored, Size};
use crate::method::{Method, Start, is_individual};
use crate::solver::{AskTell, Batch};
use crate::space::SearchSpace;
use argmin::core::TerminationReason;
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;
use std::sync::Arc;

/// Everything that a search knows and that a checkpoint holds.
///
/// A generation may be evaluated in several batches. How many does not matter to the result: the
/// method is told only when a whole brood has its scores. Nor does it matter when a batch is asked for:
/// a brood is bred as soon as the method's [lag](Method::lag) allows it, and no later.
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
    /// Some of those that were best before.
    pub(crate) finalists: Finalists,
    /// Score of the best individual of the last finished generation, as the method was told it.
    pub generation_best: Option<Score>,
    /// The best of the broods of the present generation that have been told.
    best_so_far: Option<Score>,
    /// Broods that have been bred and not told, oldest first.
    pending: VecDeque<Vec<Genome>>,
    /// Scores of the first members of the oldest.
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
            finalists: Finalists::new(),
            generation_best: None,
            best_so_far: None,
            pending: VecDeque::new(),
            scores: Vec::new(),
            most: if matches!(start, Start::Random) { ALWAYS } else { Size::ANY },
        }
    }

    /// Whether the last score was the last of a generation.
    #[must_use]
    pub const fn is_between_generations(&self) -> bool {
        self.scores.is_empty() && self.best_so_far.is_none()
    }

    /// Largest trees that are tried.
    pub(crate) const fn most(&self) -> Size {
        self.most
    }

    /// Whether this can be the state of a search in `space`: what was read from a file may be anything.
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

/// A method that searches a space.
///
/// A batch is what is left of a brood, unless [`Search::batch`] is smaller. A batch may be asked for before
/// the last one is told. [`crate::ArgminSolver`] makes it
/// a solver of argmin.
#[derive(Clone, Debug)]
pub struct Search<M> {
    /// What is known so far.
    pub state: SearchState<M>,
    /// Most individuals to evaluate at once, at least 1. Changes nothing but when the caller gets to look
    /// up.
    pub batch: usize,
    /// Evaluations after which the search ends: never one more is made.
    pub evaluation_limit: u64,
    /// Individuals that have been handed out and not told: the first of those that are pending.
    out: usize,
    space: Arc<SearchSpace>,
}

impl<M> Search<M> {
    /// Starts `method`, whose first lists are those of `start`, in `space`, without a limit.
    #[must_use]
    pub const fn new(method: M, start: &Start, space: Arc<SearchSpace>) -> Self {
        Self::resume(SearchState::new(method, start), space)
    }

    /// Goes on from `state`.
    #[must_use]
    pub const fn resume(state: SearchState<M>, space: Arc<SearchSpace>) -> Self {
        Self { state, batch: usize::MAX, evaluation_limit: u64::MAX, out: 0, space }
    }

    /// The space that is searched.
    #[must_use]
    pub const fn space(&self) -> &Arc<SearchSpace> {
        &self.space
    }

    /// What the search makes small, of an individual with this score: its cost and what draws it to the
    /// start.
    fn cost(&self, genome: &Genome, score: &Score) -> f64 {
        score.cost + self.space.prior_cost(genome)
    }

    /// Individuals of the oldest brood that have been handed out and not told.
    #[must_use]
    pub fn awaited(&self) -> usize {
        let untold = self.state.pending.front().map_or(0, Vec::len) - self.state.scores.len();
        untold.min(self.out)
    }

    /// [`Search::cost`] of the best individual.
    pub(crate) fn best_cost(&self) -> Option<f64> {
        self.state.best.as_ref().map(|best| self.cost(&best.genome, &best.score))
    }
}

impl<M: Method> Search<M> {
    /// Breeds what the method breeds before it is told more. Nothing may be told between two calls that
    /// would both breed: what is bred would depend on when this is called.
    fn breed(&mut self) {
        let state = &mut self.state;
        while state.pending.len() <= state.method.lag() {
            let mut members = Vec::new();
            state.method.ask(&self.space, &mut members);
            // What a search starts from is the caller's; the exact truth may be among it.
            if state.generation > 0 || !state.pending.is_empty() {
                members.iter_mut().for_each(|member| self.space.settle(member));
            }
            state.pending.push_back(members);
        }
    }

    /// Tells the method about a brood whose scores are complete.
    fn end_brood(&mut self, members: &[Genome]) {
        let state = &mut self.state;
        state.method.tell(&self.space, members, &state.scores);
        let scores = state.best_so_far.iter().chain(&state.scores).copied();
        state.best_so_far = scores.min_by(|a, b| a.cost.total_cmp(&b.cost));
        state.scores.clear();
        if state.method.ends_generation() {
            state.generation_best = state.best_so_far.take();
            if let (0, Some(best)) = (state.generation, &state.best) {
                state.most = largest_after(best.score.size);
            }
            state.generation += 1;
        }
        // With none pending the next is bred when it is asked for, if ever.
        if !state.pending.is_empty() {
            self.breed();
        }
    }
}

impl<M: Method> AskTell for Search<M> {
    fn name(&self) -> &str {
        self.state.method.name()
    }

    fn ask(&mut self) -> Batch<'_> {
        if self.state.pending.is_empty() {
            self.breed();
        }
        let told = self.state.scores.len();
        let room = (self.evaluation_limit - self.state.evaluations).saturating_sub(self.out as u64);
        let most = usize::try_from(room).unwrap_or(usize::MAX).min(self.batch.max(1));
        // What is out are the first without a score, maybe of several broods.
        let mut before = told + self.out;
        let mut left: &[Genome] = &[];
        for brood in &self.state.pending {
            left = brood.get(before..).unwrap_or_default();
            before = before.saturating_sub(brood.len());
            if !left.is_empty() {
                break;
            }
        }
        let count = left.len().min(most);
        self.out += count;
        Batch { genomes: &left[..count], most: self.state.most }
    }

    fn tell(&mut self, scores: &[Score]) -> Option<Scored> {
        let first = self.state.scores.len();
        self.out = self.out.saturating_sub(scores.len());
        self.state.evaluations += scores.len() as u64;
        let mut members = self.state.pending.pop_front()?;
        let batch = &mut members[first..first + scores.len()];
        for (member, score) in batch.iter_mut().zip(scores) {
            self.space.resize(member, score.resized);
        }
        // What the method is told holds what draws numbers to the start; what is kept of the best does not.
        let told: Vec<Score> = (scores.iter().zip(&*batch))
            .map(|(score, member)| Score { cost: self.cost(member, score), ..*score })
            .collect();
        let scored = |at: usize| Scored { genome: batch[at].clone(), score: scores[at] };
        // One by one: which were the best for a while must not depend on how many are told at once.
        for (at, told) in told.iter().enumerate() {
            if self.best_cost().is_none_or(|best| told.cost < best)
                && let Some(former) = self.state.best.replace(scored(at))
            {
                self.state.finalists.add(former);
            }
        }
        let top =
            (told.iter().enumerate()).min_by(|a, b| a.1.cost.total_cmp(&b.1.cost)).map(|(at, _)| scored(at));
        self.state.scores.extend(told);
        if self.state.scores.len() == members.len() {
            self.end_brood(&members);
        } else {
            self.state.pending.push_front(members);
        }
        top
    }

    fn ended(&self) -> Option<TerminationReason> {
        (self.state.evaluations >= self.evaluation_limit).then_some(TerminationReason::MaxItersReached)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::{Evolution, EvolutionSettings, Random, RandomSettings};
    use crate::solver::{ArgminSolver, FitState};
    use crate::space::{Freedom, TreeSeed};
    use crate::testing::{Function, cube};
    use argmin::core::{Executor, State};

    fn search() -> Search<Random> {
        let space =
            SearchSpace::from_params(cube(3, -1.0, 1.0), &[0.5; 3], &Freedom::default(), TreeSeed::Fixed(1));
        let settings = RandomSettings { population: 10 };
        Search::new(Random::new(settings, 1, Start::Random), &Start::Random, Arc::new(space.unwrap()))
    }

    fn run(search: Search<Random>) -> (SearchState<Random>, FitState) {
        let sphere = Function(argmin_testfunctions::sphere);
        let result =
            Executor::new(sphere, ArgminSolver(search)).configure(|s| s.counting(true)).run().unwrap();
        (result.solver.0.state, result.state)
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

    /// A search of a method with a lag, of islands that end soon.
    fn lagging() -> Search<Evolution> {
        let space =
            SearchSpace::from_params(cube(3, -1.0, 1.0), &[0.5; 3], &Freedom::default(), TreeSeed::Fixed(1));
        let settings =
            EvolutionSettings { first: 8, parents: 4, children: 8, brood: 5, lag: 2, ..Default::default() };
        let search =
            Search::new(Evolution::new(settings, 1, Start::Random), &Start::Random, Arc::new(space.unwrap()));
        Search { evaluation_limit: 700, ..search }
    }

    #[test]
    fn when_children_are_asked_for_and_told_changes_nothing() {
        let sphere = |genome: &Genome| Score::from_cost(genome.values.iter().map(|v| v * v).sum());
        let mut whole = lagging();
        while whole.ended().is_none() {
            let scores: Vec<Score> = whole.ask().genomes.iter().map(sphere).collect();
            let _ = whole.tell(&scores);
        }
        for (batch, told) in [(usize::MAX, 1), (3, 2), (1, usize::MAX), (usize::MAX, usize::MAX)] {
            let mut search = Search { batch, ..lagging() };
            let (mut out, mut most_out) = (VecDeque::new(), 0);
            while search.ended().is_none() {
                loop {
                    let asked = search.ask().genomes;
                    if asked.is_empty() {
                        break;
                    }
                    out.extend(asked.iter().map(sphere));
                }
                most_out = most_out.max(out.len());
                let scores: Vec<Score> = out.drain(..search.awaited().min(told)).collect();
                let _ = search.tell(&scores);
            }
            assert_eq!(search.state, whole.state, "asked by {batch}, told by {told}");
            assert!(out.is_empty() && most_out > 10, "{most_out} were out at most");
        }
    }
}
