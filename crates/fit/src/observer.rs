//! Watching a fit while it runs.

use crate::begun::Begun;
use crate::checkpoint::CheckpointError;
use crate::error::ObserverError;
use crate::genome::Scored;
use crate::history::Row;
use crate::individual::IndividualProgress;
use std::time::Duration;

/// How far a fit is, between two batches.
#[derive(Clone, Copy, Debug)]
pub struct Progress<'a> {
    /// Finished generations.
    pub generation: u64,
    /// Individuals evaluated, those of earlier parts of a resumed run included.
    pub evaluations: u64,
    /// Individuals evaluated since this part of the run began, for rates.
    pub evaluations_now: u64,
    /// The best individual so far; none before the first batch.
    pub best: Option<&'a Scored>,
    /// Likeness of the best individual, in 0..=1. Where the objective does not look at it, that of the
    /// best at the end of the last generation; none before the first.
    pub likeness: Option<f64>,
    /// Time so far, earlier parts of a resumed run included.
    pub elapsed: Duration,
    /// Time since this part of the run began.
    pub elapsed_now: Duration,
    /// The largest used share of any part of the budget, in 0..=1; none without a bound.
    pub used: Option<f64>,
}

/// Watches a fit: a progress bar, a CSV file, a picture.
///
/// Called on the thread that runs the fit, between batches: whatever takes long here delays it. The
/// methods are called in this order; [`crate::fit`] is the search alone and calls the middle three.
pub trait Observer {
    /// During a first guess: so many trees of so many are grown.
    fn guessing(&mut self, done: usize, all: usize) {
        let _ = (done, all);
    }

    /// Before the search, once it is known where it begins. The last moment to refuse it.
    ///
    /// # Errors
    /// Whatever the observer says ends the fit as [`crate::FitError::Observer`].
    fn begun(&mut self, begun: &Begun) -> Result<(), ObserverError> {
        let _ = begun;
        Ok(())
    }

    /// After every batch, about three times per second, and once at the start and at the end.
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

    /// After the search: its best is now judged, which takes some seconds.
    fn judging(&mut self) {}

    /// While the goal's own tree is searched, which comes last.
    fn individual(&mut self, progress: &IndividualProgress) {
        let _ = progress;
    }
}
