//! How many individuals are scored between two checks.

use std::time::Duration;

/// The number of individuals that take about a third of a second.
///
/// For callers that score batch by batch. Small enough for prompt stops and timeouts, large enough to keep workers
/// busy: at the end of a batch all wait for the slowest tree. It depends on the clock, and the result does not
/// depend on it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pace {
    batch: usize,
    last: Duration,
    threads: usize,
}

impl Pace {
    /// Seconds that a batch should take.
    const TARGET: f64 = 0.3;

    pub(super) fn new(now: Duration) -> Self {
        let threads = rayon::current_num_threads();
        Self { batch: 2 * threads, last: now, threads }
    }

    /// The size of the next batch for `threads` threads, of this process or of others.
    pub(super) fn batch(&mut self, threads: usize) -> usize {
        self.threads = threads.max(1);
        self.batch = self.batch.next_multiple_of(self.threads);
        self.batch
    }

    /// Sets the size of the next batch after `scored` individuals more have a score, `now`.
    pub(super) fn next(&mut self, scored: usize, now: Duration) {
        let took = now.saturating_sub(self.last).as_secs_f64();
        self.last = now;
        let before = self.batch as f64;
        let wanted = (scored as f64 * (Self::TARGET / took.max(1e-6))).clamp(before / 4.0, before * 4.0);
        let rounds = (wanted / self.threads as f64).round().clamp(1.0, 1e4) as usize;
        self.batch = rounds * self.threads;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The batch after `told` individuals at a time, each of which takes 10 ms, on two threads.
    fn settled(told: usize) -> usize {
        let mut pace = Pace::new(Duration::ZERO);
        for round in 1..20 {
            let _ = pace.batch(2);
            pace.next(told, Duration::from_millis(10) * (told * round) as u32);
        }
        pace.batch(2)
    }

    #[test]
    fn a_batch_takes_a_third_of_a_second_however_many_are_told_at_once() {
        assert_eq!([settled(1), settled(7), settled(100)], [30; 3]);
    }
}
