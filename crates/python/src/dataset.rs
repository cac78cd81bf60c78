//! Training data, written to files.

use crate::error::{PleachError, of_export};
use crate::pool;
use crate::seed::Seed;
use crate::species::Species;
use pleach::Freedom;
use pleach_dataset::{Control, DatasetError, DatasetOptions, Format, Layer, Mode, Written};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::panic::resume_unwind;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Duration;

/// How often Python is told how far it is, and asked whether it was interrupted.
const LOOK: Duration = Duration::from_millis(50);

/// Writes a data set; returns how much of what it holds.
#[pyfunction]
#[pyo3(signature = (species, out, count, view, size, layers, format, shard, spread, free, fix, seed, resume, overwrite, threads, progress))]
#[expect(clippy::too_many_arguments, reason = "called once, by `dataset`, with all of them by name")]
pub(crate) fn write_dataset<'py>(
    py: Python<'py>,
    species: Vec<Species>,
    out: PathBuf,
    count: u32,
    view: Vec<f64>,
    size: u32,
    layers: Vec<String>,
    format: &str,
    shard: u32,
    spread: f64,
    free: Vec<String>,
    fix: Vec<String>,
    seed: Seed,
    resume: bool,
    overwrite: bool,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let Seed(seed) = seed;
    let mode = match (resume, overwrite) {
        (true, true) => return Err(PleachError::new_err("`resume` and `overwrite` exclude each other")),
        (true, _) => Mode::Resume,
        (_, true) => Mode::Overwrite,
        _ => Mode::New,
    };
    let layers = layers.iter().map(|layer| layer.parse::<Layer>());
    let options = DatasetOptions {
        count,
        views: view,
        size,
        layers: layers
            .collect::<Result<_, _>>()
            .map_err(|problem| of_export(format!("`layers`: {problem}")))?,
        format: format.parse::<Format>().map_err(|problem| of_export(format!("`format`: {problem}")))?,
        shard,
        spread,
        freedom: Freedom { free, fix },
        seed,
    };
    let species: Vec<pleach::Species> = species.iter().map(|one| (*one.inner).clone()).collect();
    let all = u64::from(count) * species.len() as u64;
    let run = |control: &Control<'_>| pleach_dataset::write(&species, &options, &out, mode, control);
    let (written, raised) = watched(py, all, threads, progress.as_ref(), run)?;
    if let Some(error) = raised {
        return Err(error);
    }
    let written = written.map_err(of_export)?;
    let dict = PyDict::new(py);
    dict.set_item("trees", written.trees)?;
    dict.set_item("failures", written.failures)?;
    dict.set_item("shards", written.shards)?;
    dict.set_item("kept", written.kept)?;
    Ok(dict)
}

/// Runs `write` on threads of its own while this one looks after it and after Python; with what Python raised meanwhile.
fn watched(
    py: Python<'_>,
    all: u64,
    threads: Option<usize>,
    progress: Option<&Py<PyAny>>,
    write: impl FnOnce(&Control<'_>) -> Result<Written, DatasetError> + Send,
) -> PyResult<(Result<Written, DatasetError>, Option<PyErr>)> {
    let (stop, done) = (&AtomicBool::new(false), &AtomicU64::new(0));
    let pool = pool::with_threads(threads)?;
    py.detach(move || {
        std::thread::scope(|scope| {
            let running = scope.spawn(|| {
                let tell = |step: pleach_dataset::Progress| {
                    let _ = done.fetch_max(step.done, Ordering::Relaxed);
                };
                let control = Control { stop, progress: &tell };
                pool.install(|| write(&control))
            });
            let (mut raised, mut told) = (None, 0);
            while !running.is_finished() {
                std::thread::sleep(LOOK);
                let now = done.load(Ordering::Relaxed);
                let listen = |py: Python<'_>| -> PyResult<()> {
                    if let Some(progress) = progress.filter(|_| now != told) {
                        let _ = progress.call1(py, (now, all))?;
                    }
                    py.check_signals()
                };
                if raised.is_none() {
                    raised = Python::attach(listen).err();
                    stop.store(raised.is_some(), Ordering::Relaxed);
                }
                told = now;
            }
            Ok((running.join().unwrap_or_else(|panic| resume_unwind(panic)), raised))
        })
    })
}
