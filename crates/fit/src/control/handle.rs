//! The handle by which a caller watches, saves and stops a fit.

use super::budget::Clock;
use super::observer::Observer;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// Where and how often a fit saves itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CheckpointSettings {
    /// The file, in a folder that exists.
    pub path: PathBuf,
    /// Minimum time between two checkpoints by the caller's clock; zero saves after every chunk of scores. One
    /// more is written at the start and at the end.
    pub interval: Duration,
    /// Resume from the file, if there is one; otherwise it is overwritten.
    pub resume: bool,
}

impl CheckpointSettings {
    /// Checkpoints at `path`, at most one per second, from a fresh start.
    #[must_use]
    pub fn new(path: PathBuf) -> Self {
        Self { path, interval: Duration::from_secs(1), resume: false }
    }
}

/// Clock, stop flag, observers and checkpoint of a fit.
pub struct Control<'a> {
    /// The caller's time.
    pub clock: &'a dyn Clock,
    /// Raised by the caller, from any thread, to end the fit soon.
    pub stop: &'a AtomicBool,
    /// Called with progress.
    pub observers: Vec<&'a mut dyn Observer>,
    /// Where the fit saves itself; `None`: nowhere.
    pub checkpoint: Option<CheckpointSettings>,
}

impl<'a> Control<'a> {
    /// Without observers and checkpoint.
    #[must_use]
    pub fn new(clock: &'a dyn Clock, stop: &'a AtomicBool) -> Self {
        Self { clock, stop, observers: Vec::new(), checkpoint: None }
    }

    /// The same for a part of a longer fit.
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
