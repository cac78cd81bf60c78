//! Watching a fit while it runs.

use super::history::Row;
use super::prepared::PreparedSearch;
use crate::error::ObserverError;
use crate::individual::IndividualProgress;
use crate::problem::Scored;
use crate::run::CheckpointError;
use pleach_tree::{Foliage, Species};
use std::time::Duration;

/// Progress of a search.
#[derive(Clone, Copy, Debug)]
pub struct Progress<'a> {
    /// Finished generations.
    pub generation: u64,
    /// Individuals evaluated, those of earlier parts of a resumed run included.
    pub evaluations: u64,
    /// Individuals evaluated since this part of the run began, for rates.
    pub evaluations_now: u64,
    /// The best individual so far; `None` before the first score.
    pub best: Option<&'a Scored>,
    /// Likeness of the best individual, in 0..=1. Where the objective does not use it, that of the best at the
    /// end of the last generation; `None` before the first.
    pub likeness: Option<f64>,
    /// Time so far, earlier parts of a resumed run included.
    pub elapsed: Duration,
    /// Time since this part of the run began.
    pub elapsed_now: Duration,
    /// The largest used share of any limit of the budget, in 0..=1; `None` without a limit.
    pub used: Option<f64>,
}

/// Watches a fit: a progress bar, a CSV file, a picture.
///
/// Called on the thread that runs the fit: slow methods delay it. The methods are called in this order;
/// [`crate::fit`] is the search alone and calls the middle three.
pub trait Observer {
    /// During a first guess: `done` of `all` trees are grown.
    fn guessing(&mut self, done: usize, all: usize) {
        let _ = (done, all);
    }

    /// During a first guess, once: the known tree that is most like the goal, at the goal's height, with leaves or without.
    /// The search may start from another: numbers that are learnt and a race come after it.
    fn nearest(&mut self, species: &Species, foliage: Foliage) {
        let _ = (species, foliage);
    }

    /// Before the search, with its start. The last moment to refuse it.
    ///
    /// # Errors
    /// Any error ends the fit as [`crate::FitError::Observer`].
    fn prepared(&mut self, prepared: &PreparedSearch) -> Result<(), ObserverError> {
        let _ = prepared;
        Ok(())
    }

    /// After every part of a batch, and once at the start and at the end.
    fn progress(&mut self, progress: &Progress<'_>) {
        let _ = progress;
    }

    /// After every generation. A resumed run first replays the rows of its earlier parts.
    fn generation(&mut self, row: &Row) {
        let _ = row;
    }

    /// A checkpoint could not be written; the fit goes on with the older one.
    fn checkpoint_failed(&mut self, error: &CheckpointError) {
        let _ = error;
    }

    /// After the search, before its result is assessed, which takes some seconds.
    fn assessing(&mut self) {}

    /// During the search for this very tree.
    fn individual(&mut self, progress: &IndividualProgress) {
        let _ = progress;
    }

    /// While a posterior is learnt, which is the last stage: `done` of `all` trees of the prior are grown.
    fn learning(&mut self, done: usize, all: usize) {
        let _ = (done, all);
    }
}
