//! A search that is driven by what is asked and told.

use crate::control::{Budget, Row, StopReason};
use crate::error::FitError;
use crate::evaluator::Evaluator;
use crate::method::AnyMethod;
use crate::problem::{FitProblem, Genome, Score, Size};
use crate::run::{Course, FitSettings, evaluator_in, search_space};
use crate::search::{AskTell as _, Search, SearchState};
use std::sync::Arc;
use std::time::Duration;

/// Individuals that need scores.
#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    /// The individuals.
    pub genomes: Vec<Genome>,
    /// A tree larger than this may be abandoned and scored as invalid.
    pub max_size: Size,
}

/// A search without a clock and without threads of its own.
pub(super) struct Driven {
    pub(super) course: Course<AnyMethod>,
    /// For likenesses that scores do not contain.
    objective: Evaluator,
}

impl Driven {
    /// The search for `problem` with `settings`, from `now` on.
    pub(super) fn new(problem: &FitProblem, settings: &FitSettings, now: Duration) -> Result<Self, FitError> {
        let space = search_space(problem, settings)?;
        let objective = evaluator_in(&space, problem, settings)?;
        let method = settings.optimizer.method(settings.seed, settings.start.clone());
        let state = SearchState::new(method, &settings.start);
        let search = Search::resume(state, Arc::new(space));
        Ok(Self { course: Course::new(search, settings.budget, Vec::new(), now), objective })
    }

    pub(super) fn ended(&self, now: Duration) -> Option<StopReason> {
        self.course.verdict(&self.course.spent(now, false))
    }

    /// The next individuals: as many as take about a third of a second on `workers` workers, or fewer.
    pub(super) fn ask(&mut self, workers: usize) -> Asked {
        let max_size = self.course.search.state.max_size();
        let mut genomes = Vec::new();
        let wanted = self.course.batch_size(workers);
        while genomes.len() < wanted {
            self.course.search.max_chunk = wanted - genomes.len();
            let some = self.course.search.ask().genomes;
            if some.is_empty() {
                break;
            }
            genomes.extend_from_slice(some);
        }
        Asked { genomes, max_size }
    }

    /// Takes the scores of the oldest individuals without a score, in the order in which they were asked for. Returns
    /// the rows of the generations that they finished.
    pub(super) fn tell(&mut self, mut scores: &[Score], now: Duration) -> Vec<Row> {
        let mut rows = Vec::new();
        let told = scores.len();
        while !scores.is_empty() {
            let awaited = self.course.search.awaited().min(scores.len());
            if awaited == 0 {
                // More scores than individuals.
                break;
            }
            let (these, others) = scores.split_at(awaited);
            self.course.search.tell(these);
            rows.extend(self.course.after_scores(&self.objective, now));
            scores = others;
        }
        if told > 0 {
            self.course.set_pace(told, now);
        }
        rows
    }

    /// The largest used share of any limit of the budget.
    pub(super) fn used(&self, now: Duration) -> Option<f64> {
        let budget: &Budget = &self.course.budget;
        budget.used(&self.course.spent(now, false))
    }
}
