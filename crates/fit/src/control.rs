//! What a fit needs of the world around it, and what it gives back.

use crate::budget::{Clock, StopReason};
use crate::genome::Scored;
use crate::history::Row;
use crate::observer::Observer;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// Where and how often a fit saves itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CheckpointSettings {
    /// The file, in a folder that exists.
    pub path: PathBuf,
    /// Least time between two checkpoints by the caller's clock; zero saves after every batch. One
    /// more is written at the start and at the end.
    pub interval: Duration,
    /// Go on from the file, if it is there; otherwise it is overwritten.
    pub resume: bool,
}

impl CheckpointSettings {
    /// Checkpoints at `path`, at most one per second, from a fresh start.
    #[must_use]
    pub fn new(path: PathBuf) -> Self {
        Self { path, interval: Duration::from_secs(1), resume: false }
    }
}

/// What a fit needs of the world around it.
pub struct Control<'a> {
    /// The caller's time.
    pub clock: &'a dyn Clock,
    /// Raised by the caller, from any thread, to end the fit after the current batch.
    pub stop: &'a AtomicBool,
    /// Who is told of progress.
    pub observers: Vec<&'a mut dyn Observer>,
    /// Where the fit saves itself, if it does.
    pub checkpoint: Option<CheckpointSettings>,
}

impl<'a> Control<'a> {
    /// A fit that nobody watches and that leaves no file.
    #[must_use]
    pub fn new(clock: &'a dyn Clock, stop: &'a AtomicBool) -> Self {
        Self { clock, stop, observers: Vec::new(), checkpoint: None }
    }

    /// The same for a part of a longer work.
    pub(crate) fn reborrow(&mut self) -> Control<'_> {
        Control {
            clock: self.clock,
            stop: self.stop,
            observers: self
                .observers
                .iter_mut()
                .map(|observer| &mut **observer as &mut dyn Observer)
                .collect(),
            checkpoint: self.checkpoint.clone(),
        }
    }
}

/// What came of a fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The best individual ever seen; none if the fit ended before its first evaluation.
    pub best: Option<Scored>,
    /// Some that were the best before, oldest first, each by a fiftieth better than the one before it; at most seven.
    pub finalists: Vec<Scored>,
    /// Individuals evaluated, in all parts of a resumed run.
    pub evaluations: u64,
    /// Finished generations.
    pub generations: u64,
    /// Time by the caller's clock, in all parts of a resumed run.
    pub elapsed: Duration,
    /// What of it had passed when the search began: a first guess, where the clock was started before
    /// it. The rest is the search's.
    pub before_search: Duration,
    /// Why it ended.
    pub stop: StopReason,
    /// One row for every finished generation.
    pub history: Vec<Row>,
}
