//! How long work on the result of a search takes, and the time that is reserved for it.

use serde::{Deserialize, Serialize};
use std::time::Duration;

/// A model of how long work on a result takes, such as assessing it or drawing it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CostModel {
    /// Cost that does not depend on the tree.
    pub fixed: Duration,
    /// Serial cost, in evaluations of a tree like the result.
    pub serial: f64,
    /// Parallel cost, in evaluations of such a tree, spread over all threads.
    pub parallel: f64,
}

impl CostModel {
    /// The time for a tree whose evaluation takes `evaluation`.
    #[must_use]
    pub fn time(&self, evaluation: Duration) -> Duration {
        let count = self.serial + self.parallel / rayon::current_num_threads() as f64;
        let all = Duration::try_from_secs_f64(evaluation.as_secs_f64() * count).unwrap_or(Duration::MAX);
        self.fixed.saturating_add(all)
    }
}

/// Time that a search leaves of its [`timeout`](crate::Budget::timeout) for work on its result.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reserve {
    /// Upper bound. Once no more than this is left, one tree like the best is timed.
    pub max: Duration,
    /// What the work takes.
    pub cost: CostModel,
}
