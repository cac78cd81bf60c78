//! Requests to stop: ctrl-C, SIGTERM, a terminal that goes away.

use crate::output;
use anyhow::Context;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Signals this soon after the first one are the same request: `timeout`, Slurm and systemd send theirs
/// to the process and to its group, so that it arrives twice.
const SAME_REQUEST: Duration = Duration::from_secs(2);
/// The exit code of an interrupted program, as shells have it: 128 + SIGINT.
const INTERRUPTED: i32 = 130;

/// A flag that the first request raises. A second request, two seconds later or more, ends the program.
pub(super) fn catch() -> anyhow::Result<Arc<AtomicBool>> {
    let stop = Arc::new(AtomicBool::new(false));
    let raised = Arc::clone(&stop);
    let first: Mutex<Option<Instant>> = Mutex::default();
    ctrlc::set_handler(move || {
        raised.store(true, Ordering::SeqCst);
        let mut first = first.lock().unwrap_or_else(PoisonError::into_inner);
        if first.get_or_insert_with(Instant::now).elapsed() >= SAME_REQUEST {
            output::note(
                "error: ended at once, as asked for twice; the same command with --resume goes on from the last \
                 checkpoint, if the search had begun",
            );
            std::process::exit(INTERRUPTED);
        }
    })
    .context("cannot catch signals")?;
    Ok(stop)
}
