//! Threads for one call.

use crate::error::PleachError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// More are a mistake.
const MAX_THREADS: usize = 1024;

/// Does `work` without the interpreter's lock, on `threads` threads.
pub(crate) fn on<T: Send>(
    py: Python<'_>,
    threads: Option<usize>,
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    py.detach(|| Ok(with_threads(threads)?.install(work)))
}

/// Tells whether a call may ask for so many threads.
pub(crate) fn check(threads: Option<usize>) -> PyResult<()> {
    if threads.is_some_and(|count| !(1..=MAX_THREADS).contains(&count)) {
        return Err(PleachError::new_err(format!("expected from 1 to {MAX_THREADS} threads")));
    }
    Ok(())
}

/// This number of threads; `None`: as many as the machine has cores, or as `RAYON_NUM_THREADS` says.
///
/// They end with the pool: a process that forks afterwards has none that its child would wait for.
pub(crate) fn with_threads(threads: Option<usize>) -> PyResult<ThreadPool> {
    check(threads)?;
    let pool = ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0)).build();
    pool.map_err(|error| PleachError::new_err(format!("no threads: {error}")))
}
