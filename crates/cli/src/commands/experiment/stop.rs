//! Ctrl-C and requests to end: an experiment ends between two jobs and keeps what is finished.

use anyhow::Context;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

static RAISED: AtomicBool = AtomicBool::new(false);

/// Signals that come this soon after the first one are the same wish: a terminal and a shell may
/// both send one.
const SAME: Duration = Duration::from_secs(2);

/// Exit code of a command that a signal ended.
const INTERRUPTED: i32 = 130;

/// Raised once the experiment is to end.
pub(super) fn flag() -> &'static AtomicBool {
    &RAISED
}

pub(super) fn is_raised() -> bool {
    RAISED.load(Ordering::Relaxed)
}

/// Fails once the experiment is to end.
pub(super) fn check() -> anyhow::Result<()> {
    if is_raised() {
        return Err(crate::interrupted::Interrupted::new("interrupted").into());
    }
    Ok(())
}

/// Turns signals into the flag. A later one ends the program at once; finished rows are on the disk.
pub(super) fn catch_signals() -> anyhow::Result<()> {
    let first: Mutex<Option<Instant>> = Mutex::new(None);
    ctrlc::set_handler(move || {
        let mut first = first.lock().unwrap_or_else(PoisonError::into_inner);
        let since = first.get_or_insert_with(Instant::now).elapsed();
        if RAISED.swap(true, Ordering::SeqCst) && since > SAME {
            std::process::exit(INTERRUPTED);
        }
    })
    .context("cannot catch signals")
}
