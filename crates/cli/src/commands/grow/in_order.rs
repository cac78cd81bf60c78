//! Work for many seeds on all threads, whose results come in the order of the seeds.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

/// Results that may wait for an earlier one, at most.
const MAX_WAITING: u64 = 1024;

/// What threads share.
struct Shared<T, F> {
    /// The next seed to work on.
    next: u64,
    /// The next seed whose result is handed on.
    due: u64,
    /// Results that wait for an earlier one.
    waiting: BTreeMap<u64, anyhow::Result<T>>,
    take: F,
    failed: Option<anyhow::Error>,
}

/// Calls `make` for each of `seeds` on all threads, each with memory of its own, and `take` with the results
/// in order, each as soon as those before it are taken. At most a thousand wait. Ends at the first error
/// of either, in the order of seeds.
pub(super) fn for_each<W: Default, T: Send>(
    seeds: &Range<u64>,
    make: impl Fn(&mut W, u64) -> anyhow::Result<T> + Sync,
    take: impl FnMut(T) -> anyhow::Result<()> + Send,
) -> anyhow::Result<()> {
    let (next, due) = (seeds.start, seeds.start);
    let shared = Mutex::new(Shared { next, due, waiting: BTreeMap::new(), take, failed: None });
    let moved_on = Condvar::new();
    // A broadcast runs once on each thread: what a thread does while it waits for others, within `make`,
    // is never a second one.
    rayon::broadcast(|_| {
        let mut memory = W::default();
        loop {
            let mut now = lock(&shared);
            while now.failed.is_none() && now.next < seeds.end && now.next - now.due >= MAX_WAITING {
                now = moved_on.wait(now).unwrap_or_else(PoisonError::into_inner);
            }
            if now.failed.is_some() || now.next >= seeds.end {
                return;
            }
            let seed = now.next;
            now.next += 1;
            drop(now);
            let made = make(&mut memory, seed);
            let mut now = lock(&shared);
            let _ = now.waiting.insert(seed, made);
            now.take_those_due();
            drop(now);
            moved_on.notify_all();
        }
    });
    let shared = shared.into_inner().unwrap_or_else(PoisonError::into_inner);
    shared.failed.map_or(Ok(()), Err)
}

impl<T, F: FnMut(T) -> anyhow::Result<()>> Shared<T, F> {
    fn take_those_due(&mut self) {
        while self.failed.is_none()
            && let Some(made) = self.waiting.remove(&self.due)
        {
            self.due += 1;
            self.failed = made.and_then(&mut self.take).err();
        }
    }
}

fn lock<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicU64, Ordering};

    /// Turns of the processor that differ from seed to seed.
    fn slow(seed: u64) {
        for _ in 0..(seed * 7919) % 97 {
            std::thread::yield_now();
        }
    }

    #[test]
    fn results_come_in_order_and_few_wait() {
        let begun = AtomicU64::new(0);
        let make = |_: &mut (), seed: u64| {
            slow(seed);
            let _ = begun.fetch_add(1, Ordering::SeqCst);
            Ok(seed)
        };
        let mut taken = Vec::new();
        for_each(&(5..2_000), make, |seed| {
            let ahead = begun.load(Ordering::SeqCst) - taken.len() as u64;
            assert!(ahead <= MAX_WAITING + rayon::current_num_threads() as u64, "{ahead} wait");
            taken.push(seed);
            Ok(())
        })
        .unwrap();
        assert_eq!(taken, (5..2_000).collect::<Vec<_>>());
    }

    #[test]
    fn the_first_error_in_order_is_told() {
        let make = |_: &mut (), seed: u64| {
            slow(seed);
            anyhow::ensure!(seed < 100 || !seed.is_multiple_of(3), "seed {seed}");
            Ok(seed)
        };
        let mut taken = 0;
        let error = for_each(&(0..100_000), make, |_| {
            taken += 1;
            Ok(())
        });
        assert_eq!((error.unwrap_err().to_string().as_str(), taken), ("seed 102", 102));
        let closed = for_each(
            &(0..9),
            |(): &mut (), seed| Ok(seed),
            |seed| {
                anyhow::ensure!(seed < 3, "closed");
                Ok(())
            },
        );
        assert_eq!(closed.unwrap_err().to_string(), "closed");
    }
}
