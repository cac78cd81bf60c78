//! A search within its budget: what it has used, the rows of its generations, and whether it is over.

use super::pace::Pace;
use crate::control::{Budget, Reserve, Row, Spent, StopReason};
use crate::evaluator::Evaluate;
use crate::method::Method;
use crate::search::Search;
use std::time::Duration;

/// A search within a budget. It has no clock: its caller passes the time.
pub(crate) struct Course<M> {
    pub(crate) search: Search<M>,
    pub(crate) budget: Budget,
    pub(crate) history: Vec<Row>,
    /// Cost of the best, by which it is recognised, and its likeness. `None` at the start of a resumed run: the
    /// last row counts.
    likeness: Option<(f64, Option<f64>)>,
    pace: Pace,
    /// Time of one evaluation of a tree like the best, once it has been measured.
    evaluation: Option<Duration>,
}

impl<M: Method> Course<M> {
    /// `search` from where it stands, with the rows of its earlier parts, driven from `now` on.
    pub(crate) fn new(mut search: Search<M>, budget: Budget, history: Vec<Row>, now: Duration) -> Self {
        search.evaluation_limit = budget.evaluations.unwrap_or(u64::MAX).max(search.state.evaluations);
        Self { search, budget, history, likeness: None, pace: Pace::new(now), evaluation: None }
    }

    /// The number of individuals that take about a third of a second on this many threads.
    pub(crate) fn batch_size(&mut self, threads: usize) -> usize {
        self.pace.batch(threads)
    }

    /// Records that `scored` individuals more have a score, `now`.
    pub(crate) fn set_pace(&mut self, scored: usize, now: Duration) {
        self.pace.next(scored, now);
    }

    pub(crate) fn spent(&self, elapsed: Duration, interrupted: bool) -> Spent {
        let state = &self.search.state;
        let best = state.best.as_ref().map(|best| best.score);
        Spent {
            evaluations: state.evaluations,
            generations: state.generation,
            elapsed,
            reserved: self.reserved(),
            best_cost: best.map_or(f64::INFINITY, |score| score.cost),
            best_iou: best.map_or(f64::NEG_INFINITY, |score| score.iou),
            interrupted,
        }
    }

    /// Time that is reserved for work on the result.
    fn reserved(&self) -> Duration {
        let time = |reserve: Reserve| {
            self.evaluation.map_or(reserve.max, |evaluation| reserve.cost.time(evaluation).min(reserve.max))
        };
        self.budget.reserve.map_or(Duration::ZERO, time)
    }

    /// Whether an evaluation of a tree like the best has to be timed: with the upper bound of the reserve the
    /// search would be over now.
    pub(crate) fn wants_evaluation_time(&self, elapsed: Duration) -> bool {
        let (Some(timeout), Some(reserve)) = (self.budget.timeout, self.budget.reserve) else { return false };
        self.evaluation.is_none() && self.search.state.best.is_some() && elapsed + reserve.max >= timeout
    }

    /// Records the time of one evaluation of a tree like the best.
    pub(crate) fn set_evaluation_time(&mut self, evaluation: Duration) {
        self.evaluation = Some(evaluation);
    }

    /// The reason to stop now, if there is one.
    pub(crate) fn verdict(&self, spent: &Spent) -> Option<StopReason> {
        let verdict = self.budget.verdict(spent);
        // A first guess may have used all the time; there is a result all the same.
        verdict.filter(|reason| *reason != StopReason::Timeout || self.search.state.evaluations > 0)
    }

    /// Likeness of the best individual, where it is known.
    pub(crate) fn likeness(&self) -> Option<f64> {
        let of_best = self.search.state.best.as_ref().and_then(|best| best.score.likeness);
        let last_row = || self.history.last().and_then(|row| row.likeness);
        of_best.or_else(|| self.likeness.map_or_else(last_row, |known| known.1))
    }

    /// After scores: the row of the generation that they finished, if any.
    pub(crate) fn after_scores(
        &mut self,
        objective: &(impl Evaluate + ?Sized),
        elapsed: Duration,
    ) -> Option<Row> {
        let row = self.new_row(objective, elapsed);
        self.history.extend(row);
        row
    }

    fn new_row(&mut self, objective: &(impl Evaluate + ?Sized), elapsed: Duration) -> Option<Row> {
        let likeness = self.likeness_of_best(objective);
        let best_cost = self.search.best_cost()?;
        let state = &self.search.state;
        let (best, last) = (state.best.as_ref()?, state.generation_best?);
        state.is_between_generations().then_some(Row {
            generation: state.generation,
            evaluations: state.evaluations,
            best_cost,
            generation_best_cost: last.cost,
            iou: best.score.iou,
            accuracy: best.score.accuracy,
            likeness,
            elapsed_s: elapsed.as_secs_f64(),
        })
    }

    /// Likeness of the best individual at the end of a generation: that of its score, or of one more
    /// evaluation where the best has changed and the objective does not use likeness.
    fn likeness_of_best(&mut self, objective: &(impl Evaluate + ?Sized)) -> Option<f64> {
        let state = &self.search.state;
        let best = state.best.as_ref().filter(|_| state.is_between_generations())?;
        let cost = best.score.cost;
        if best.score.likeness.is_some() {
            return best.score.likeness;
        }
        let known = self.likeness.filter(|known| known.0.to_bits() == cost.to_bits());
        let (_, likeness) =
            *self.likeness.insert(known.unwrap_or_else(|| (cost, objective.likeness(&best.genome))));
        likeness
    }
}
