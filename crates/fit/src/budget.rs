//! When a fit ends.

use crate::ending::Kept;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::time::Duration;

/// The caller's time: this crate does not read the clock.
///
/// Any `Fn() -> Duration` is one, such as `|| started.elapsed()`; `|| Duration::ZERO` stands still.
pub trait Clock {
    /// Time since this run, or this part of a resumed run, began. Never less than the last answer.
    fn elapsed(&self) -> Duration;
}

impl<F: Fn() -> Duration> Clock for F {
    fn elapsed(&self) -> Duration {
        self()
    }
}

/// What a fit may use up; whatever comes first ends it. Nothing set means until interrupted.
///
/// A budget is not part of what makes two runs the same: a run may be resumed with a larger one, and
/// comes to the same bits as a run that had it from the beginning.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Budget {
    /// Trees grown and scored: exactly, never one more.
    pub evaluations: Option<u64>,
    /// Generations of the optimiser.
    pub generations: Option<u64>,
    /// Time by the caller's clock, all parts of a resumed run together. Checked between batches of
    /// about a third of a second.
    pub timeout: Option<Duration>,
    /// What of `timeout` is left to what follows the search; none is nothing.
    pub kept: Option<Kept>,
    /// Intersection over union of the best individual, in 0..=1.
    pub target_iou: Option<f64>,
}

impl Budget {
    /// `evaluations` and nothing else.
    #[must_use]
    pub fn evaluations(evaluations: u64) -> Self {
        Self { evaluations: Some(evaluations), ..Self::default() }
    }

    /// `timeout` and nothing else.
    #[must_use]
    pub fn timeout(timeout: Duration) -> Self {
        Self { timeout: Some(timeout), ..Self::default() }
    }
}

/// Why a fit ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StopReason {
    /// [`Budget::evaluations`] are used up.
    Evaluations,
    /// [`Budget::generations`] are done.
    Generations,
    /// [`Budget::timeout`] is over.
    Timeout,
    /// [`Budget::target_iou`] is reached.
    TargetIou,
    /// The cost is zero: nothing is left to improve.
    Perfect,
    /// The caller's stop flag was raised.
    Interrupted,
}

impl fmt::Display for StopReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Evaluations => "all evaluations used",
            Self::Generations => "all generations done",
            Self::Timeout => "time is up",
            Self::TargetIou => "target reached",
            Self::Perfect => "perfect match",
            Self::Interrupted => "interrupted",
        })
    }
}

/// How far a run has come, for [`Budget`] to judge.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spent {
    pub(crate) evaluations: u64,
    pub(crate) generations: u64,
    pub(crate) elapsed: Duration,
    /// What is to be left of the time.
    pub(crate) kept: Duration,
    pub(crate) best_cost: f64,
    pub(crate) best_iou: f64,
    pub(crate) interrupted: bool,
}

impl Budget {
    /// Why to stop now, if so.
    pub(crate) fn verdict(&self, spent: &Spent) -> Option<StopReason> {
        if self.target_iou.is_some_and(|target| spent.best_iou >= target) {
            Some(StopReason::TargetIou)
        } else if spent.best_cost <= 0.0 {
            Some(StopReason::Perfect)
        } else if self.evaluations.is_some_and(|most| spent.evaluations >= most) {
            Some(StopReason::Evaluations)
        } else if self.generations.is_some_and(|most| spent.generations >= most) {
            Some(StopReason::Generations)
        } else if self.timeout.is_some_and(|most| spent.elapsed + spent.kept >= most) {
            Some(StopReason::Timeout)
        } else if spent.interrupted {
            Some(StopReason::Interrupted)
        } else {
            None
        }
    }

    /// The largest share of any part that is used up, in 0..=1; none without a bound.
    pub(crate) fn used(&self, spent: &Spent) -> Option<f64> {
        let parts = [
            self.evaluations.map(|most| spent.evaluations as f64 / most.max(1) as f64),
            self.generations.map(|most| spent.generations as f64 / most.max(1) as f64),
            self.timeout.map(|most| {
                let most = most.saturating_sub(spent.kept);
                spent.elapsed.as_secs_f64() / most.as_secs_f64().max(1e-9)
            }),
        ];
        parts.into_iter().flatten().map(|share| share.min(1.0)).reduce(f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRESH: Spent = Spent {
        evaluations: 10,
        generations: 2,
        elapsed: Duration::from_secs(3),
        kept: Duration::ZERO,
        best_cost: 0.4,
        best_iou: 0.6,
        interrupted: false,
    };

    #[test]
    fn each_bound_stops_at_its_value_and_not_before() {
        let none = Budget::default();
        let second = Duration::from_secs(1);
        let cases = [
            (
                Budget { evaluations: Some(10), ..none },
                Budget { evaluations: Some(11), ..none },
                StopReason::Evaluations,
            ),
            (
                Budget { generations: Some(2), ..none },
                Budget { generations: Some(3), ..none },
                StopReason::Generations,
            ),
            (
                Budget { timeout: Some(3 * second), ..none },
                Budget { timeout: Some(4 * second), ..none },
                StopReason::Timeout,
            ),
            (
                Budget { target_iou: Some(0.6), ..none },
                Budget { target_iou: Some(0.61), ..none },
                StopReason::TargetIou,
            ),
        ];
        for (at, before, reason) in cases {
            assert_eq!(at.verdict(&FRESH), Some(reason));
            assert_eq!(before.verdict(&FRESH), None, "{reason}");
        }
        assert_eq!(none.verdict(&Spent { interrupted: true, ..FRESH }), Some(StopReason::Interrupted));
        assert_eq!(none.verdict(&Spent { best_cost: 0.0, ..FRESH }), Some(StopReason::Perfect));
        assert_eq!(none.used(&FRESH), None);
        let both = Budget { evaluations: Some(40), generations: Some(4), ..none };
        assert_eq!(both.used(&FRESH), Some(0.5));
    }
}
