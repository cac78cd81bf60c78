//! How all of a fit ends on time: what follows a search takes as long as its trees do.

use crate::budget::Clock;
use crate::error::FitError;
use crate::fit_goal::GoalSettings;
use crate::individual::IndividualSettings;
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// Work that is done on a result, such as judging it or painting it, and how long it takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Aftermath {
    /// What it takes whatever the tree is.
    pub fixed: Duration,
    /// And as long as so many trees like the result, grown and scored one after the other.
    pub trees: f64,
    /// And as so many more, on all threads.
    pub spread: f64,
}

impl Aftermath {
    /// What it takes for a tree that is grown and scored in `tree`.
    #[must_use]
    pub fn takes(&self, tree: Duration) -> Duration {
        let trees = self.trees + self.spread / rayon::current_num_threads() as f64;
        let of_trees = Duration::try_from_secs_f64(tree.as_secs_f64() * trees).unwrap_or(Duration::MAX);
        self.fixed.saturating_add(of_trees)
    }
}

/// What a search leaves of its [`timeout`](crate::Budget::timeout) to what follows it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Kept {
    /// At most. Once no more than this is left, one tree like the best is timed.
    pub most: Duration,
    /// What follows.
    pub aftermath: Aftermath,
}

/// When all of a fit is over, with what its caller does with the result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ending {
    /// Time since the fit began, all parts of a resumed one together.
    pub after: Duration,
    /// What the caller does with the tree of the kind, and with an individual.
    pub writing: Aftermath,
    /// What it does with each further individual.
    pub further: Aftermath,
}

/// What is left of the time of a fit whose search is over.
pub(crate) struct Rest<'a> {
    ending: Option<Ending>,
    individual: Option<IndividualSettings>,
    /// What had passed when the search was over, and the clock then.
    searched: Duration,
    from: Duration,
    clock: &'a dyn Clock,
    /// What a tree like the best takes to be grown and scored.
    tree: Duration,
}

impl<'a> Rest<'a> {
    /// After a search that took `searched`; `evaluate` grows and scores a tree like its best.
    pub(crate) fn new(
        settings: &GoalSettings,
        searched: Duration,
        clock: &'a dyn Clock,
        evaluate: impl FnOnce() -> Result<(), FitError>,
    ) -> Result<Self, FitError> {
        let GoalSettings { ending, individual, .. } = *settings;
        let from = clock.elapsed();
        if ending.is_some() {
            evaluate()?;
        }
        let tree = clock.elapsed().saturating_sub(from);
        Ok(Self { ending, individual, searched, from, clock, tree })
    }

    /// What is left until so many trees have to be written, if there is a bound.
    fn until(&self, written: impl FnOnce(&Ending, Duration) -> Duration) -> Option<Duration> {
        let ending = self.ending?;
        let passed = self.searched + self.clock.elapsed().saturating_sub(self.from);
        Some(ending.after.saturating_sub(passed + written(&ending, self.tree)))
    }

    /// What judging may take, whose share is `share`.
    pub(crate) fn for_judging(&self, share: Option<Duration>) -> Option<Duration> {
        let Some(individual) = self.individual else {
            return self.until(|ending, tree| ending.writing.takes(tree)).or(share);
        };
        let left = self.until(Ending::writing_all(individual));
        match (left, individual.time) {
            (Some(left), Some(time)) if !individual.takes_rest => Some(left.saturating_sub(time)),
            (Some(left), _) => Some(share.map_or(left, |share| share.min(left))),
            (None, _) => share,
        }
    }

    /// What the search for individuals may take.
    pub(crate) fn for_individuals(&self) -> Option<Duration> {
        let individual = self.individual?;
        match (self.until(Ending::writing_all(individual)), individual.time) {
            (Some(left), Some(time)) if !individual.takes_rest => Some(left.min(time)),
            (left, time) => left.or(time),
        }
    }
}

impl Ending {
    /// What writing the tree of the kind and those of `individual` takes.
    fn writing_all(individual: IndividualSettings) -> impl FnOnce(&Self, Duration) -> Duration {
        move |ending, tree| {
            let further = u32::from(individual.count.saturating_sub(1));
            ending.writing.takes(tree) * 2 + ending.further.takes(tree) * further
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

    /// The rest of a fit of a hundred seconds, sixty of which it searched, and whose trees take a second: writing one
    /// takes five, a further one takes one. Two seconds after the search it is asked.
    fn rest(ends: bool, individual: Option<IndividualSettings>, ask: impl Fn(&Rest<'_>)) {
        let aftermath = |fixed, trees| Aftermath { fixed: seconds(fixed), trees, spread: 0.0 };
        let ending = Ending { after: seconds(100), writing: aftermath(2, 3.0), further: aftermath(1, 0.0) };
        let settings =
            GoalSettings { individual, ending: ends.then_some(ending), ..GoalSettings::new(Vec::new()) };
        let now = Cell::new(seconds(7));
        let clock = || now.get();
        let evaluate = || {
            now.set(seconds(8));
            Ok(())
        };
        let rest = Rest::new(&settings, seconds(60), &clock, evaluate).unwrap();
        now.set(seconds(9));
        ask(&rest);
    }

    #[test]
    fn what_is_left_goes_to_what_comes_last() {
        let third = IndividualSettings { takes_rest: true, ..IndividualSettings::time(seconds(33)) };
        let share = Some(seconds(12));
        rest(true, None, |rest| {
            assert_eq!(rest.for_judging(share), Some(seconds(33)), "all but the writing of one tree");
        });
        rest(true, Some(third), |rest| {
            assert_eq!((rest.for_judging(share), rest.for_individuals()), (share, Some(seconds(28))));
        });
        rest(true, Some(IndividualSettings { count: 9, ..third }), |rest| {
            assert_eq!(rest.for_individuals(), Some(seconds(20)));
        });
        // So long, and no longer.
        rest(true, Some(IndividualSettings::time(seconds(8))), |rest| {
            assert_eq!(
                (rest.for_judging(share), rest.for_individuals()),
                (Some(seconds(20)), Some(seconds(8)))
            );
        });
        rest(true, Some(IndividualSettings::time(seconds(99))), |rest| {
            assert_eq!(
                (rest.for_judging(share), rest.for_individuals()),
                (Some(seconds(0)), Some(seconds(28)))
            );
        });
        // So many trees, as far as there is time.
        rest(true, Some(IndividualSettings::trees(5)), |rest| {
            assert_eq!((rest.for_judging(share), rest.for_individuals()), (share, Some(seconds(28))));
        });
        rest(false, Some(third), |rest| {
            assert_eq!((rest.for_judging(share), rest.for_individuals()), (share, Some(seconds(33))));
        });
    }
}
