//! Requests to end: an experiment ends between two jobs and keeps what is finished.

use pleach_console::interrupted::Interrupted;
use std::sync::atomic::{AtomicBool, Ordering};

static RAISED: AtomicBool = AtomicBool::new(false);

/// Ends the experiments of this process: those that run, soon, and those that begin later, at once.
pub fn raise() {
    RAISED.store(true, Ordering::SeqCst);
}

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
        return Err(Interrupted::new("interrupted").into());
    }
    Ok(())
}
