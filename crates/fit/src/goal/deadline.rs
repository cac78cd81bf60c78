//! How a whole fit ends on time: work on the result takes as long as its trees do.

use crate::control::{Clock, CostModel};
use crate::error::FitError;
use crate::individual::IndividualSettings;
use std::time::Duration;

/// Deadline of a whole fit, including the caller's work on its result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deadline {
    /// Time since the fit began, all parts of a resumed one together.
    pub after: Duration,
    /// What the caller does with the result of the search, and again with an individual.
    pub result: CostModel,
    /// What it does with each further individual.
    pub further: CostModel,
}

/// The time left to a fit whose search is over.
pub(super) struct TimeLeft<'a> {
    deadline: Option<Deadline>,
    individual: Option<IndividualSettings>,
    /// Time that had passed at the end of the search, and the clock then.
    searched: Duration,
    from: Duration,
    clock: &'a dyn Clock,
    /// Time of one evaluation of a tree like the best.
    evaluation: Duration,
}

impl<'a> TimeLeft<'a> {
    /// After a search that took `searched`; `evaluate` evaluates a tree like its best.
    pub(super) fn new(
        deadline: Option<Deadline>,
        individual: Option<IndividualSettings>,
        searched: Duration,
        clock: &'a dyn Clock,
        evaluate: impl FnOnce() -> Result<(), FitError>,
    ) -> Result<Self, FitError> {
        let from = clock.elapsed();
        if deadline.is_some() {
            evaluate()?;
        }
        let evaluation = clock.elapsed().saturating_sub(from);
        Ok(Self { deadline, individual, searched, from, clock, evaluation })
    }

    /// The time before the caller's work, which takes `work`; `None` without a deadline.
    fn before(&self, work: impl FnOnce(&Deadline, Duration) -> Duration) -> Option<Duration> {
        let deadline = self.deadline?;
        let passed = self.searched + self.clock.elapsed().saturating_sub(self.from);
        Some(deadline.after.saturating_sub(passed + work(&deadline, self.evaluation)))
    }

    /// The time of assessment, whose share of a fit's time is `share`.
    pub(super) fn for_assessment(&self, share: Option<Duration>) -> Option<Duration> {
        let Some(individual) = self.individual else {
            return self.before(|deadline, evaluation| deadline.result.time(evaluation)).or(share);
        };
        let left = self.before(Deadline::with_individuals(individual));
        match (left, individual.time) {
            (Some(left), Some(time)) if !individual.takes_rest => Some(left.saturating_sub(time)),
            (Some(left), _) => Some(share.map_or(left, |share| share.min(left))),
            (None, _) => share,
        }
    }

    /// The time of the search for individuals.
    pub(super) fn for_individuals(&self) -> Option<Duration> {
        let individual = self.individual?;
        match (self.before(Deadline::with_individuals(individual)), individual.time) {
            (Some(left), Some(time)) if !individual.takes_rest => Some(left.min(time)),
            (left, time) => left.or(time),
        }
    }
}

impl Deadline {
    /// The time of the caller's work on the result and on the individuals.
    fn with_individuals(individual: IndividualSettings) -> impl FnOnce(&Self, Duration) -> Duration {
        move |deadline, evaluation| {
            let further = u32::from(individual.count.saturating_sub(1));
            deadline.result.time(evaluation) * 2 + deadline.further.time(evaluation) * further
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    const fn seconds(seconds: u64) -> Duration {
        Duration::from_secs(seconds)
    }

    /// The time left to a fit of a hundred seconds that searched for sixty and whose evaluations take a second:
    /// work on the result takes five, on a further individual one. It is asked two seconds after the search.
    fn time_left(has_deadline: bool, individual: Option<IndividualSettings>, ask: impl Fn(&TimeLeft<'_>)) {
        let cost = |fixed, serial| CostModel { fixed: seconds(fixed), serial, parallel: 0.0 };
        let deadline = Deadline { after: seconds(100), result: cost(2, 3.0), further: cost(1, 0.0) };
        let now = Cell::new(seconds(7));
        let clock = || now.get();
        let evaluate = || {
            now.set(seconds(8));
            Ok(())
        };
        let deadline = has_deadline.then_some(deadline);
        let left = TimeLeft::new(deadline, individual, seconds(60), &clock, evaluate).unwrap();
        now.set(seconds(9));
        ask(&left);
    }

    #[test]
    fn the_last_stage_gets_the_time_left() {
        let third = IndividualSettings { takes_rest: true, ..IndividualSettings::time(seconds(33)) };
        let share = Some(seconds(12));
        time_left(true, None, |left| {
            assert_eq!(left.for_assessment(share), Some(seconds(33)), "all but the work on one tree");
        });
        time_left(true, Some(third), |left| {
            assert_eq!((left.for_assessment(share), left.for_individuals()), (share, Some(seconds(28))));
        });
        time_left(true, Some(IndividualSettings { count: 9, ..third }), |left| {
            assert_eq!(left.for_individuals(), Some(seconds(20)));
        });
        // A fixed time.
        time_left(true, Some(IndividualSettings::time(seconds(8))), |left| {
            assert_eq!(
                (left.for_assessment(share), left.for_individuals()),
                (Some(seconds(20)), Some(seconds(8)))
            );
        });
        time_left(true, Some(IndividualSettings::time(seconds(99))), |left| {
            assert_eq!(
                (left.for_assessment(share), left.for_individuals()),
                (Some(seconds(0)), Some(seconds(28)))
            );
        });
        // A number of trees, as far as there is time.
        time_left(true, Some(IndividualSettings::trees(5)), |left| {
            assert_eq!((left.for_assessment(share), left.for_individuals()), (share, Some(seconds(28))));
        });
        time_left(false, Some(third), |left| {
            assert_eq!((left.for_assessment(share), left.for_individuals()), (share, Some(seconds(33))));
        });
    }
}
