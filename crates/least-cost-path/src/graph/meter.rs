//! Steps of work that graphs take beyond those that their nodes have paid for.

use std::sync::atomic::{AtomicU64, Ordering};

/// Counts steps up to a limit, one count for all threads.
#[derive(Debug)]
pub(crate) struct Meter {
    limit: u64,
    taken: AtomicU64,
}

/// More steps than the limit: the graph is given up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum OutOfSteps {
    /// Most of them for darts that missed.
    Misses,
    /// Most of them for comparing nodes that lie crowded in a large box.
    Crowding,
}

impl Meter {
    pub(crate) const fn new(limit: u64) -> Self {
        Self { limit, taken: AtomicU64::new(0) }
    }

    /// Takes `steps`; says whether no more than the limit are taken. Whether the sum of all graphs passes
    /// the limit does not depend on their order.
    pub(crate) fn take(&self, steps: u64) -> bool {
        let before = self.taken.fetch_add(steps.min(self.limit.saturating_add(1)), Ordering::Relaxed);
        before.saturating_add(steps) <= self.limit
    }

    /// Steps that were taken.
    pub(crate) fn taken(&self) -> u64 {
        self.taken.load(Ordering::Relaxed)
    }
}
