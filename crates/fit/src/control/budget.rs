//! When a fit ends.

use super::cost::Reserve;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::time::Duration;

/// The caller's time: this crate does not read the clock.
///
/// Any `Fn() -> Duration` is a clock, such as `|| started.elapsed()`; `|| Duration::ZERO` stands still.
pub trait Clock {
    /// Time since this run, or this part of a resumed run, began. Never less than the last answer.
    fn elapsed(&self) -> Duration;
}

impl<F: Fn() -> Duration> Clock for F {
    fn elapsed(&self) -> Duration {
        self()
    }
}

/// Limits of a fit; the first that is reached ends it. With none set it runs until interrupted.
///
/// A run may be resumed with a larger budget, and gives the same bits as a run that had it from the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Budget {
    /// Trees grown and scored; exact.
    pub evaluations: Option<u64>,
    /// Generations of the optimiser.
    pub generations: Option<u64>,
    /// Time by the caller's clock, all parts of a resumed run together. Checked about ten times per second.
    pub timeout: Option<Duration>,
    /// The part of `timeout` that is reserved for work on the result; `None`: none of it.
    pub reserve: Option<Reserve>,
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

/// How much of a [`Budget`] a run has used.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spent {
    pub(crate) evaluations: u64,
    pub(crate) generations: u64,
    pub(crate) elapsed: Duration,
    /// Time that is reserved.
    pub(crate) reserved: Duration,
    pub(crate) best_cost: f64,
    pub(crate) best_iou: f64,
    pub(crate) interrupted: bool,
}

impl Budget {
    /// The reason to stop now, if there is one.
    pub(crate) fn verdict(&self, spent: &Spent) -> Option<StopReason> {
        if self.target_iou.is_some_and(|target| spent.best_iou >= target) {
            Some(StopReason::TargetIou)
        } else if spent.best_cost <= 0.0 {
            Some(StopReason::Perfect)
        } else if self.evaluations.is_some_and(|most| spent.evaluations >= most) {
            Some(StopReason::Evaluations)
        } else if self.generations.is_some_and(|most| spent.generations >= most) {
            Some(StopReason::Generations)
        } else if self.timeout.is_some_and(|most| spent.elapsed + spent.reserved >= most) {
            Some(StopReason::Timeout)
        } else if spent.interrupted {
            Some(StopReason::Interrupted)
        } else {
            None
        }
    }

    /// The largest used share of any limit, in 0..=1; `None` without a limit.
    pub(crate) fn used(&self, spent: &Spent) -> Option<f64> {
        let parts = [
            self.evaluations.map(|most| spent.evaluations as f64 / most.max(1) as f64),
            self.generations.map(|most| spent.generations as f64 / most.max(1) as f64),
            self.timeout.map(|most| {
                let most = most.saturating_sub(spent.reserved);
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
        reserved: Duration::ZERO,
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
