//! Helpers for tests, who come whether or not they have anything else to do.

use pleach_plant::{Helpers, NextPart};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::thread;

/// Threads that help once it has been asked often enough whether they are idle: what is made must not depend on when
/// that is, nor on how many they are.
#[derive(Debug)]
pub struct Volunteers {
    threads: usize,
    patience: usize,
    asked: AtomicUsize,
    calls: AtomicUsize,
}

impl Volunteers {
    /// As many `threads` with the one that asks, after so many questions.
    #[must_use]
    pub const fn new(threads: usize, patience: usize) -> Self {
        Self { threads, patience, asked: AtomicUsize::new(0), calls: AtomicUsize::new(0) }
    }

    /// How often they have helped.
    pub fn calls(&self) -> usize {
        self.calls.load(Relaxed)
    }
}

impl Helpers for Volunteers {
    fn are_idle(&self) -> bool {
        self.asked.fetch_add(1, Relaxed) >= self.patience
    }

    fn share(&self, parts: usize, work: &(dyn Fn(&mut NextPart<'_>) + Sync)) {
        self.calls.fetch_add(1, Relaxed);
        let taken = AtomicUsize::new(0);
        let take_parts = || {
            work(&mut || {
                let part = taken.fetch_add(1, Relaxed);
                (part < parts).then_some(part)
            });
        };
        thread::scope(|scope| {
            for _ in 1..self.threads {
                scope.spawn(take_parts);
            }
            take_parts();
        });
    }
}
