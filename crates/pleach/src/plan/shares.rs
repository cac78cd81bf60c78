//! How the time of a fit is shared out, so that all of it together takes as long as it may.

use pleach_fit::{Aftermath, Ending, GoalSettings, IndividualSettings, Judging, Kept};
use std::time::Duration;

/// How the whole of a fit's time is shared out: what is for this very tree is its
/// [`IndividualSettings::time`], and all else is for the first guess, the search, judging and writing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shares {
    whole: Duration,
    /// All but what is for this very tree: [`pleach_fit::Budget::timeout`]. What the search has to leave of it is
    /// [`Shares::bound`]'s to say.
    pub search: Duration,
    /// What of that is for judging, and for judging and writing together, at most.
    judging: Duration,
    kept: Duration,
}

/// The parts of the whole that judging gets: more where what it leaves is of use to this very tree.
const JUDGING: u32 = 8;
const JUDGING_ALONE: u32 = 16;
/// The part that pictures and files get: no less than they take for most species, where there is time.
const WRITING: u32 = 20;
const LEAST_WRITING: Duration = Duration::from_secs(2);
const MOST_OF_LITTLE: u32 = 8;
/// Trees that judging grows, for most species.
const JUDGED: f64 = 300.0;

/// What callers that paint no pictures do with a tree that is found: draw and score it once more.
pub const DRAWING: Aftermath = Aftermath { fixed: Duration::from_millis(100), trees: 3.0, spread: 0.0 };

/// What it takes to register the result, as trees on all threads: some eighty drawings, and to draw a tree takes about
/// half as long as to grow it as well.
const REGISTERED: f64 = 40.0;

impl Shares {
    /// Of a fit that is to take `whole`.
    #[must_use]
    pub fn new(whole: Duration, individual: Option<&IndividualSettings>) -> Self {
        let individual = individual.filter(|one| one.time.is_some());
        let taken = individual.and_then(|one| one.time).unwrap_or_default();
        let takes_rest = individual.is_some_and(|one| one.takes_rest);
        let writing = (whole / WRITING).max(LEAST_WRITING.min(whole / MOST_OF_LITTLE));
        let search = whole.saturating_sub(taken);
        let left = search.saturating_sub(writing);
        let judging = (whole / if takes_rest { JUDGING } else { JUDGING_ALONE }).min(left / 2);
        Self { whole, search, judging, kept: search - left + judging }
    }

    /// `settings` whose search has [`Shares::search`], so that all of the fit ends on time with what its caller does
    /// with the tree of the kind and with an individual, each, and with every further individual.
    ///
    /// A continued fit has used time before: the timeout in `settings` is longer by that.
    #[must_use]
    pub fn bound(&self, mut settings: GoalSettings, writing: Aftermath, further: Aftermath) -> GoalSettings {
        let used = settings.search.budget.timeout.unwrap_or(self.search).saturating_sub(self.search);
        let aftermath = Aftermath { spread: writing.spread + REGISTERED + JUDGED, ..writing };
        settings.search.budget.kept = Some(Kept { most: self.kept, aftermath });
        settings.judging = settings.judging.map(|judging| Judging { time: Some(self.judging), ..judging });
        settings.ending = Some(Ending { after: self.whole + used, writing, further });
        settings
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_make_up_the_whole() {
        let seconds = Duration::from_secs_f64;
        let parts = |whole: f64, individual: Option<&IndividualSettings>| {
            let shares = Shares::new(seconds(whole), individual);
            [shares.search, shares.judging, shares.kept].map(|time| time.as_secs_f64())
        };
        assert_eq!(parts(80.0, None), [80.0, 5.0, 9.0]);
        let third = IndividualSettings { takes_rest: true, ..IndividualSettings::time(seconds(30.0)) };
        assert_eq!(parts(80.0, Some(&third)), [50.0, 10.0, 14.0]);
        assert_eq!(parts(16.0, None), [16.0, 1.0, 3.0]);
        // Hardly any is left.
        let all = IndividualSettings::time(seconds(70.0));
        assert_eq!(parts(80.0, Some(&all)), [10.0, 3.0, 7.0]);
    }

    #[test]
    fn a_continued_fit_ends_so_much_later() {
        let shares = Shares::new(Duration::from_secs(80), None);
        let mut settings = GoalSettings::new(Vec::new());
        settings.search.budget.timeout = Some(shares.search);
        let none = Aftermath::default();
        let after =
            |settings: &GoalSettings| shares.bound(settings.clone(), none, none).ending.unwrap().after;
        assert_eq!(after(&settings), Duration::from_secs(80));
        settings.search.budget.timeout = Some(Duration::from_secs(92));
        assert_eq!(after(&settings), Duration::from_secs(92));
    }
}
