//! Whole fits, as `pleach fit` makes them.

use crate::arrays::{numbers, of_ink, whole};
use crate::error::{FitError, GoalError, of_fit, of_goal};
use crate::event::{Event, EventSender};
use crate::goal::Source;
use crate::score::of_card;
use crate::species::Species;
use crate::{json, pool};
use numpy::PyArray2;
use pleach::plan::library;
use pleach::{
    COLUMNS, Control, FitOptions, FitReport, FitSource, Fitted, FittedTree, PrepareError, Prepared,
};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use std::collections::BTreeMap;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

/// How often Python is asked whether it was interrupted.
const LOOK: Duration = Duration::from_millis(50);

pub(crate) fn of_prepare(error: PrepareError) -> PyErr {
    match error {
        PrepareError::Goal(error) => of_goal(error),
        PrepareError::Mask { ref source, .. } => GoalError::new_err(format!("{error}: {source}")),
        other => of_fit(other),
    }
}

/// Fits a goal, with the options as JSON, the pictures that they name, and the species that they start from where it is
/// at hand. Returns what was found as a dict; `progress` is called with a dict for each step.
#[pyfunction]
#[pyo3(signature = (goal, options, pictures, start, threads, progress))]
pub(crate) fn fit<'py>(
    py: Python<'py>,
    goal: &Bound<'py, PyAny>,
    options: &str,
    pictures: BTreeMap<String, Bound<'py, PyAny>>,
    start: Option<Species>,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    // The time of a fit is that of all of it.
    let started = Instant::now();
    let options = FitOptions::from_json(options).map_err(of_fit)?;
    let goal = Source::read(goal)?;
    let given = goal.goal(&whole())?.bitmap;
    let mut source: FitSource = goal.into();
    source.start = start.map(|species| (*species.inner).clone());
    for (name, picture) in pictures {
        let _ = source.pictures.insert(name, Source::read(&picture)?.into());
    }
    let prepared = pool::on(py, threads, || options.prepare(&source))?.map_err(of_prepare)?;
    drop(source);
    let (fitted, asked_to_end) = watched(py, &prepared, started, threads, progress.as_ref())?;
    if let Some(error) = &asked_to_end
        && !error.is_instance_of::<pyo3::exceptions::PyKeyboardInterrupt>(py)
    {
        return Err(error.clone_ref(py));
    }
    let fitted = match (fitted, asked_to_end) {
        (Ok(fitted), _) => fitted,
        (Err(_), Some(error)) => return Err(error),
        (Err(error), None) => return Err(of_fit(error)),
    };
    // On threads that end here: a child that forks later has none that it would wait for.
    let report = pool::on(py, threads, || prepared.report(fitted))?.map_err(of_fit)?;
    let found = found(py, &report)?;
    found.set_item("goal", of_ink(py, &given)?)?;
    Ok(found)
}

/// Runs a fit on threads of its own while this one listens to it and to Python; with what Python raised meanwhile.
#[allow(clippy::type_complexity, reason = "two results of one call")]
fn watched(
    py: Python<'_>,
    prepared: &Prepared,
    started: Instant,
    threads: Option<usize>,
    progress: Option<&Py<PyAny>>,
) -> PyResult<(Result<Fitted, pleach::FitError>, Option<PyErr>)> {
    let (sender, events) = channel::<Event>();
    let stop = &AtomicBool::new(false);
    let pool = pool::with_threads(threads)?;
    let run = |sender| {
        // Its own, so that the channel closes when the fit has ended.
        let mut sending = EventSender(sender);
        let clock = || started.elapsed();
        let control = Control { observers: vec![&mut sending], ..Control::new(&clock, stop) };
        prepared.fit(&mut library().for_one_goal(), control)
    };
    py.detach(move || {
        std::thread::scope(|scope| {
            let running = scope.spawn(|| pool.install(move || run(sender)));
            let mut raised = None;
            loop {
                let step = events.recv_timeout(LOOK);
                if step == Err(RecvTimeoutError::Disconnected) {
                    break;
                }
                if raised.is_none() {
                    raised = Python::attach(|py| listen(py, step.as_ref().ok(), progress)).err();
                    stop.store(raised.is_some(), Ordering::Relaxed);
                }
            }
            let fitted = running.join().unwrap_or_else(|panic| resume_unwind(panic));
            Ok((fitted, raised))
        })
    })
}

/// Hands a step of a fit to Python, and lets it handle its signals.
fn listen(py: Python<'_>, step: Option<&Event>, progress: Option<&Py<PyAny>>) -> PyResult<()> {
    if let (Some(step), Some(progress)) = (step, progress) {
        progress.call1(py, (step.to_dict(py)?,))?;
    }
    py.check_signals()
}

/// A species with how well it matches the goal, its silhouette over the goal's file, and how well it matches further
/// views.
type Tree<'py> = (Species, Bound<'py, PyAny>, Bound<'py, PyArray2<bool>>, Vec<Bound<'py, PyAny>>);

fn tree<'py>(py: Python<'py>, found: &FittedTree) -> PyResult<Tree<'py>> {
    let further = found.views.iter().map(|view| of_card(py, &view.scores)).collect::<PyResult<_>>()?;
    let species = found.species.clone().into();
    Ok((species, of_card(py, &found.scores)?, of_ink(py, found.over_file())?, further))
}

/// What a fit has found.
fn found<'py>(py: Python<'py>, report: &FitReport) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    let value = serde_json::to_value(report).map_err(|error| FitError::new_err(error.to_string()))?;
    dict.set_item("report", json::to_python(py, &value)?)?;
    dict.set_item("verdict", report.verdict.map(|verdict| verdict.to_string()))?;
    dict.set_item("warnings", report.warnings.iter().map(ToString::to_string).collect::<Vec<_>>())?;
    dict.set_item("kind", tree(py, &report.kind)?)?;
    let individuals = PyList::empty(py);
    for one in &report.trees {
        individuals.append(tree(py, one)?)?;
    }
    dict.set_item("individuals", individuals)?;
    let samples = report.posterior.iter().flat_map(|posterior| &posterior.samples);
    dict.set_item("samples", samples.map(|species| species.clone().into()).collect::<Vec<Species>>())?;
    let history = PyDict::new(py);
    for column in COLUMNS {
        let values = report.fitted.outcome.history.iter().map(column.value).collect();
        history.set_item(column.name, numbers(py, values))?;
    }
    dict.set_item("history", history)?;
    Ok(dict)
}
