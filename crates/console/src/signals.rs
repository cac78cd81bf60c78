//! Ctrl-C and requests to end: SIGINT, SIGTERM, a terminal that goes away.

use anyhow::Context;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Signals this soon after the first one are the same request: `timeout`, Slurm and systemd send theirs
/// to the process and to its group, so that it arrives twice.
const SAME_REQUEST: Duration = Duration::from_secs(2);

/// The exit code of a program ended by a signal: 128 + SIGINT, by the convention of shells.
pub const INTERRUPTED: u8 = 130;

/// Calls `stop` at the first request to end. A second one, two seconds later or more, calls `at_once`
/// and ends the program.
///
/// # Errors
/// If the system does not let the program catch signals, or it does so already.
pub fn catch(stop: impl Fn() + Send + 'static, at_once: impl Fn() + Send + 'static) -> anyhow::Result<()> {
    let first: Mutex<Option<Instant>> = Mutex::new(None);
    ctrlc::set_handler(move || {
        stop();
        let mut first = first.lock().unwrap_or_else(PoisonError::into_inner);
        if first.get_or_insert_with(Instant::now).elapsed() >= SAME_REQUEST {
            at_once();
            std::process::exit(i32::from(INTERRUPTED));
        }
    })
    .context("cannot catch signals")
}
