//! A search between its batches: what it has spent, the rows of its generations, and whether it is over.

use super::pace::Pace;
use crate::budget::{Budget, Spent, StopReason};
use crate::ending::Kept;
use crate::evaluate::Evaluate;
use crate::history::Row;
use crate::method::Method;
use crate::search::Search;
use std::time::Duration;

/// A search within a budget. It knows no clock: whoever drives it says what has passed.
pub(crate) struct Course<M> {
    pub(crate) search: Search<M>,
    pub(crate) budget: Budget,
    pub(crate) history: Vec<Row>,
    /// Likeness of the best, and the cost by which it is known again. Of a resumed run first none: that of
    /// the last row counts.
    likeness: Option<(f64, Option<f64>)>,
    pace: Pace,
    /// What a tree like the best takes to be grown and scored, once it has been timed.
    tree: Option<Duration>,
}

impl<M: Method> Course<M> {
    /// `search` from where it stands, with the rows of its earlier parts, driven from `now` on.
    pub(crate) fn new(mut search: Search<M>, budget: Budget, history: Vec<Row>, now: Duration) -> Self {
        search.evaluation_limit = budget.evaluations.unwrap_or(u64::MAX).max(search.state.evaluations);
        Self { search, budget, history, likeness: None, pace: Pace::new(now), tree: None }
    }

    /// How many individuals are about a third of a second's for so many threads, wherever they are.
    pub(crate) fn batch_size(&mut self, threads: usize) -> usize {
        self.pace.batch(threads)
    }

    /// Minds how long the last batch took.
    pub(crate) fn set_pace(&mut self, now: Duration) {
        self.pace.next(now);
    }

    pub(crate) fn spent(&self, elapsed: Duration, interrupted: bool) -> Spent {
        let state = &self.search.state;
        let best = state.best.as_ref().map(|best| best.score);
        Spent {
            evaluations: state.evaluations,
            generations: state.generation,
            elapsed,
            kept: self.kept(),
            best_cost: best.map_or(f64::INFINITY, |score| score.cost),
            best_iou: best.map_or(f64::NEG_INFINITY, |score| score.iou),
            interrupted,
        }
    }

    /// What is to be left of the time to what follows.
    fn kept(&self) -> Duration {
        let of_trees =
            |kept: Kept| self.tree.map_or(kept.most, |tree| kept.aftermath.takes(tree).min(kept.most));
        self.budget.kept.map_or(Duration::ZERO, of_trees)
    }

    /// Whether it is time to find out how long a tree like the best takes: with most of what may be kept the
    /// search would be over now.
    pub(crate) fn wants_a_timed_tree(&self, elapsed: Duration) -> bool {
        let (Some(timeout), Some(kept)) = (self.budget.timeout, self.budget.kept) else { return false };
        self.tree.is_none() && self.search.state.best.is_some() && elapsed + kept.most >= timeout
    }

    /// Minds how long a tree like the best takes.
    pub(crate) fn set_tree_time(&mut self, tree: Duration) {
        self.tree = Some(tree);
    }

    /// Why to stop now, if so.
    pub(crate) fn verdict(&self, spent: &Spent) -> Option<StopReason> {
        let verdict = self.budget.verdict(spent);
        // Whatever came before may have used all the time; there is a result all the same.
        verdict.filter(|reason| *reason != StopReason::Timeout || self.search.state.evaluations > 0)
    }

    /// Likeness of the best individual, so far as it is known.
    pub(crate) fn likeness(&self) -> Option<f64> {
        let of_best = self.search.state.best.as_ref().and_then(|best| best.score.likeness);
        let last_row = || self.history.last().and_then(|row| row.likeness);
        of_best.or_else(|| self.likeness.map_or_else(last_row, |known| known.1))
    }

    /// After scores: the row of the generation that they have finished, if they have.
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

    /// Likeness of the best individual at the end of a generation: what its score says, or one more
    /// tree where the best has changed and the objective does not look at likeness.
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
