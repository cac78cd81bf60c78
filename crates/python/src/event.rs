//! Events of a running fit, as dicts for a callback of Python's.

use pleach::{IndividualProgress, Observer, ObserverError, PreparedSearch, Progress, Row};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::mpsc::Sender;

/// One step of a fit.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Event {
    /// Trees of the first guess that are grown, and all of them.
    Guessing(usize, usize),
    /// The species that the goal looks like, with confidence.
    Begun(Vec<(String, f64)>),
    /// The search.
    Searching { evaluations: u64, cost: Option<f64>, likeness: Option<f64>, used: Option<f64> },
    /// The search has ended.
    Judging,
    /// This very tree.
    Individual { trees: u64, trials: u64, iou: f64, likeness: f64, used: f64 },
    /// Trees of the prior that are grown, and all of them.
    Learning(usize, usize),
}

impl Event {
    /// As a dict: `stage` says what else there is.
    pub(crate) fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        match self {
            Self::Guessing(done, all) | Self::Learning(done, all) => {
                let is_guess = matches!(self, Self::Guessing(..));
                dict.set_item("stage", if is_guess { "guess" } else { "posterior" })?;
                dict.set_item("done", done)?;
                dict.set_item("all", all)?;
                dict.set_item("used", *done as f64 / (*all).max(1) as f64)?;
            }
            Self::Begun(names) => {
                dict.set_item("stage", "begun")?;
                dict.set_item("looks_like", names.clone())?;
            }
            Self::Searching { evaluations, cost, likeness, used } => {
                dict.set_item("stage", "search")?;
                dict.set_item("evaluations", evaluations)?;
                dict.set_item("cost", cost)?;
                dict.set_item("likeness", likeness)?;
                dict.set_item("used", used)?;
            }
            Self::Judging => dict.set_item("stage", "judging")?,
            Self::Individual { trees, trials, iou, likeness, used } => {
                dict.set_item("stage", "individual")?;
                dict.set_item("trees", trees)?;
                dict.set_item("trials", trials)?;
                dict.set_item("iou", iou)?;
                dict.set_item("likeness", likeness)?;
                dict.set_item("used", used)?;
            }
        }
        Ok(dict)
    }
}

/// Sends events to the thread that Python waits on. A closed channel is not an error: the fit is being stopped.
pub(crate) struct EventSender(pub(crate) Sender<Event>);

impl Observer for EventSender {
    fn guessing(&mut self, done: usize, all: usize) {
        let _ = self.0.send(Event::Guessing(done, all));
    }

    fn prepared(&mut self, prepared: &PreparedSearch) -> Result<(), ObserverError> {
        let names = prepared.guess.iter().flat_map(|guess| &guess.names);
        let _ = self.0.send(Event::Begun(names.map(|(name, share)| (name.to_string(), *share)).collect()));
        Ok(())
    }

    fn progress(&mut self, progress: &Progress<'_>) {
        let _ = self.0.send(Event::Searching {
            evaluations: progress.evaluations,
            cost: progress.best.map(|best| best.score.cost).filter(|cost| cost.is_finite()),
            likeness: progress.likeness,
            used: progress.used,
        });
    }

    fn generation(&mut self, _: &Row) {}

    fn assessing(&mut self) {
        let _ = self.0.send(Event::Judging);
    }

    fn individual(&mut self, progress: &IndividualProgress) {
        let IndividualProgress { trees, trials, iou, likeness, used, .. } = *progress;
        let _ = self.0.send(Event::Individual { trees, trials, iou, likeness, used });
    }

    fn learning(&mut self, done: usize, all: usize) {
        let _ = self.0.send(Event::Learning(done, all));
    }
}
