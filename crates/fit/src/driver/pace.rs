//! How large batches are.

use std::time::Duration;

/// How many individuals make a batch of about a third of a second.
///
/// Small enough for ctrl-C, timeouts and checkpoints to be prompt, large enough to keep the threads
/// busy: at the end of a batch all wait for the slowest tree. The clock decides it, and nothing but
/// promptness depends on it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pace {
    batch: usize,
    last: Duration,
}

impl Pace {
    /// Seconds that a batch should take.
    const TARGET: f64 = 0.3;

    pub(super) fn new(now: Duration) -> Self {
        Self { batch: 2 * rayon::current_num_threads(), last: now }
    }

    pub(super) const fn batch(&self) -> usize {
        self.batch
    }

    /// The size of the next batch, now that the last one is done.
    pub(super) fn next(&mut self, now: Duration) -> usize {
        let took = now.saturating_sub(self.last).as_secs_f64();
        self.last = now;
        let threads = rayon::current_num_threads();
        let wanted = self.batch as f64 * (Self::TARGET / took.max(1e-6)).clamp(0.25, 4.0);
        let rounds = (wanted / threads as f64).round().clamp(1.0, 1e4) as usize;
        self.batch = rounds * threads;
        self.batch
    }
}
