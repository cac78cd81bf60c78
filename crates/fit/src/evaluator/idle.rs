//! Threads of rayon's pool that have no tree of their own, and help with those of others.

use pleach_tree::{Helpers, NextPart};
use std::sync::atomic::{AtomicUsize, Ordering::Acquire, Ordering::Relaxed, Ordering::Release};
use std::thread;

/// Threads that score trees or help with them. Where a process has several pools it is one count, and they help less.
static AT_WORK: AtomicUsize = AtomicUsize::new(0);

/// How often in a row threads have to be seen idle: between two trees, each seems to be for a moment.
const SEEN: usize = 2;

/// A thread that scores a tree, or helps.
pub(super) struct AtWork;

impl AtWork {
    pub(super) fn begin() -> Self {
        AT_WORK.fetch_add(1, Relaxed);
        Self
    }
}

impl Drop for AtWork {
    fn drop(&mut self) {
        AT_WORK.fetch_sub(1, Relaxed);
    }
}

/// The idle ones among the threads of a pool, as one of them sees them while it scores a tree.
#[derive(Debug)]
pub(super) struct IdleThreads {
    threads: usize,
    /// How often in a row some were seen.
    seen: AtomicUsize,
}

impl IdleThreads {
    /// For this thread; `None` if it has no others beside it.
    pub(super) fn beside_this() -> Option<Self> {
        rayon::current_thread_index()?;
        let threads = rayon::current_num_threads();
        let idle = Self { threads, seen: AtomicUsize::new(0) };
        idle.are_idle();
        (threads > 1).then_some(idle)
    }
}

impl Helpers for IdleThreads {
    fn are_idle(&self) -> bool {
        let is_full = AT_WORK.load(Relaxed) >= self.threads;
        let seen = if is_full { 0 } else { self.seen.load(Relaxed) + 1 };
        self.seen.store(seen, Relaxed);
        seen >= SEEN
    }

    fn share(&self, parts: usize, work: &(dyn Fn(&mut NextPart<'_>) + Sync)) {
        let [taken, begun, ended] = [const { AtomicUsize::new(0) }; 3];
        let (taken, begun, ended) = (&taken, &begun, &ended);
        let take_part = move || {
            work(&mut || {
                let part = taken.fetch_add(1, Relaxed);
                (part < parts).then_some(part)
            });
        };
        rayon::scope(|scope| {
            for _ in 1..self.threads.min(parts) {
                scope.spawn(move |_| {
                    if taken.load(Relaxed) < parts {
                        begun.fetch_add(1, Relaxed);
                        let (_at_work, _ended) = (AtWork::begin(), Ended(ended));
                        take_part();
                    }
                });
            }
            take_part();
            // The last parts take a moment. To wait in the scope would be to begin another tree meanwhile.
            while ended.load(Acquire) < begun.load(Relaxed) {
                thread::yield_now();
            }
        });
    }
}

/// Counts a helper as gone, be it by a panic.
struct Ended<'a>(&'a AtomicUsize);

impl Drop for Ended<'_> {
    fn drop(&mut self) {
        self.0.fetch_add(1, Release);
    }
}
