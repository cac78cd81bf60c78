//! Generations of a method in chunks, and the best so far.

use super::ask_tell::{AskTell, Chunk};
use super::state::{SearchState, max_size_after};
use crate::method::{Method, Start};
use crate::problem::{Genome, Score, Scored};
use crate::space::SearchSpace;
use std::sync::Arc;

/// A method that searches a space.
///
/// A chunk is what is left of a batch of the method, unless [`Search::max_chunk`] is smaller.
/// [`crate::ArgminSolver`] makes it a solver of argmin.
#[derive(Clone, Debug)]
pub struct Search<M> {
    /// What is known so far.
    pub state: SearchState<M>,
    /// Upper bound of a chunk, at least 1. It has no effect on the result.
    pub max_chunk: usize,
    /// Evaluations after which the search ends; exact.
    pub evaluation_limit: u64,
    /// Individuals that were asked for and have no score yet: the first of those that are pending.
    in_flight: usize,
    space: Arc<SearchSpace>,
}

impl<M> Search<M> {
    /// A search by `method`, which begins with the lists of `start`, without a limit.
    #[must_use]
    pub const fn new(method: M, start: &Start, space: Arc<SearchSpace>) -> Self {
        Self::resume(SearchState::new(method, start), space)
    }

    /// Goes on from `state`.
    #[must_use]
    pub const fn resume(state: SearchState<M>, space: Arc<SearchSpace>) -> Self {
        Self { state, max_chunk: usize::MAX, evaluation_limit: u64::MAX, in_flight: 0, space }
    }

    /// The space that is searched.
    #[must_use]
    pub const fn space(&self) -> &Arc<SearchSpace> {
        &self.space
    }

    /// The cost that the search minimises: that of the score and the prior.
    fn cost(&self, genome: &Genome, score: &Score) -> f64 {
        score.cost + self.space.prior_cost(genome)
    }

    /// Individuals of the oldest batch that were asked for and have no score yet.
    #[must_use]
    pub fn awaited(&self) -> usize {
        let without_score = self.state.pending.front().map_or(0, Vec::len) - self.state.scores.len();
        without_score.min(self.in_flight)
    }

    /// [`Search::cost`] of the best individual.
    pub(crate) fn best_cost(&self) -> Option<f64> {
        self.state.best.as_ref().map(|best| self.cost(&best.genome, &best.score))
    }
}

impl<M: Method> Search<M> {
    /// Makes every batch that the method's staleness allows. No score may be told between two calls that would
    /// both make a batch: its individuals would depend on when this is called.
    fn make_batches(&mut self) {
        let state = &mut self.state;
        while state.pending.len() <= state.method.max_staleness() {
            let mut members = Vec::new();
            state.method.ask(&self.space, &mut members);
            // The start is the caller's and stays as it is: the exact truth may be in it.
            if state.generation > 0 || !state.pending.is_empty() {
                members.iter_mut().for_each(|member| self.space.settle(member));
            }
            state.pending.push_back(members);
        }
    }

    /// Tells the method of a batch whose scores are complete.
    fn end_batch(&mut self, members: &[Genome]) {
        let state = &mut self.state;
        state.method.tell(&self.space, members, &state.scores);
        let scores = state.best_so_far.iter().chain(&state.scores).copied();
        state.best_so_far = scores.min_by(|a, b| a.cost.total_cmp(&b.cost));
        state.scores.clear();
        if state.method.ends_generation() {
            state.generation_best = state.best_so_far.take();
            if let (0, Some(best)) = (state.generation, &state.best) {
                state.max_size = max_size_after(best.score.size);
            }
            state.generation += 1;
        }
        // With none pending, the next batch is made when it is asked for, if ever.
        if !state.pending.is_empty() {
            self.make_batches();
        }
    }
}

impl<M: Method> AskTell for Search<M> {
    fn name(&self) -> &str {
        self.state.method.name()
    }

    fn ask(&mut self) -> Chunk<'_> {
        if self.state.pending.is_empty() {
            self.make_batches();
        }
        let told = self.state.scores.len();
        let room = (self.evaluation_limit - self.state.evaluations).saturating_sub(self.in_flight as u64);
        let max_chunk = usize::try_from(room).unwrap_or(usize::MAX).min(self.max_chunk.max(1));
        // In flight are the first without a score, perhaps of several batches.
        let mut before = told + self.in_flight;
        let mut left: &[Genome] = &[];
        for batch in &self.state.pending {
            left = batch.get(before..).unwrap_or_default();
            before = before.saturating_sub(batch.len());
            if !left.is_empty() {
                break;
            }
        }
        let count = left.len().min(max_chunk);
        self.in_flight += count;
        Chunk { genomes: &left[..count], max_size: self.state.max_size }
    }

    fn tell(&mut self, scores: &[Score]) -> Option<Scored> {
        let first = self.state.scores.len();
        self.in_flight = self.in_flight.saturating_sub(scores.len());
        self.state.evaluations += scores.len() as u64;
        let mut members = self.state.pending.pop_front()?;
        let chunk = &mut members[first..first + scores.len()];
        for (member, score) in chunk.iter_mut().zip(scores) {
            self.space.resize(member, score.resized);
        }
        // The method is told costs with the prior; the score that is kept of the best is without it.
        let told: Vec<Score> = (scores.iter().zip(&*chunk))
            .map(|(score, member)| Score { cost: self.cost(member, score), ..*score })
            .collect();
        let scored = |at: usize| Scored { genome: chunk[at].clone(), score: scores[at] };
        // One by one: former bests must not depend on how many scores are told at once.
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
            self.end_batch(&members);
        } else {
            self.state.pending.push_front(members);
        }
        top
    }

    fn has_ended(&self) -> bool {
        self.state.evaluations >= self.evaluation_limit
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::{Evolution, EvolutionSettings, Random, RandomSettings};
    use crate::search::{ArgminSolver, FitState};
    use crate::space::{Freedom, TreeSeed};
    use crate::testing::{Function, cube};
    use argmin::core::{Executor, State};
    use std::collections::VecDeque;

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
    fn chunks_change_nothing() {
        let (whole, _) = run(Search { evaluation_limit: 57, ..search() });
        for max_chunk in [1, 3, 7, 10, 11] {
            let (parts, _) = run(Search { max_chunk, evaluation_limit: 57, ..search() });
            assert_eq!(parts, whole, "chunks of {max_chunk}");
        }
    }

    /// A search by a method that does not wait for its scores, with islands that end soon.
    fn stale() -> Search<Evolution> {
        let space =
            SearchSpace::from_params(cube(3, -1.0, 1.0), &[0.5; 3], &Freedom::default(), TreeSeed::Fixed(1));
        let settings = EvolutionSettings {
            first: 8,
            parents: 4,
            children: 8,
            batch: 5,
            staleness: 2,
            ..Default::default()
        };
        let search =
            Search::new(Evolution::new(settings, 1, Start::Random), &Start::Random, Arc::new(space.unwrap()));
        Search { evaluation_limit: 700, ..search }
    }

    #[test]
    fn when_children_are_asked_for_and_told_changes_nothing() {
        let sphere = |genome: &Genome| Score::from_cost(genome.values.iter().map(|v| v * v).sum());
        let mut whole = stale();
        while !whole.has_ended() {
            let scores: Vec<Score> = whole.ask().genomes.iter().map(sphere).collect();
            let _ = whole.tell(&scores);
        }
        for (max_chunk, told) in [(usize::MAX, 1), (3, 2), (1, usize::MAX), (usize::MAX, usize::MAX)] {
            let mut search = Search { max_chunk, ..stale() };
            let (mut waiting, mut max_waiting) = (VecDeque::new(), 0);
            while !search.has_ended() {
                loop {
                    let asked = search.ask().genomes;
                    if asked.is_empty() {
                        break;
                    }
                    waiting.extend(asked.iter().map(sphere));
                }
                max_waiting = max_waiting.max(waiting.len());
                let scores: Vec<Score> = waiting.drain(..search.awaited().min(told)).collect();
                let _ = search.tell(&scores);
            }
            assert_eq!(search.state, whole.state, "asked by {max_chunk}, told by {told}");
            assert!(waiting.is_empty() && max_waiting > 10, "at most {max_waiting} waited");
        }
    }
}
