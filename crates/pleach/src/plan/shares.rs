//! How the time of a fit is shared out, so that all of it together takes as long as it may.

use pleach_fit::IndividualSettings;
use std::time::Duration;

/// What of the time is for the search with its first guess, and for judging; the rest is for this very tree and for
/// writing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shares {
    /// For the first guess and the search: [`pleach_fit::Budget::timeout`].
    pub search: Duration,
    /// For judging: [`pleach_fit::Judging::time`].
    pub judging: Duration,
}

/// The parts of the whole that judging gets: more where what it leaves is of use to this very tree.
const JUDGING: u32 = 8;
const JUDGING_ALONE: u32 = 16;
/// The part that pictures and files get: no less than they take for most species, where there is time.
const WRITING: u32 = 20;
const LEAST_WRITING: Duration = Duration::from_secs(2);
const MOST_OF_LITTLE: u32 = 8;

impl Shares {
    /// Of a fit that is to take `whole`.
    #[must_use]
    pub fn new(whole: Duration, individual: Option<&IndividualSettings>) -> Self {
        let individual = individual.filter(|one| one.time.is_some());
        let taken = individual.and_then(|one| one.time).unwrap_or_default();
        let takes_rest = individual.is_some_and(|one| one.takes_rest);
        let writing = (whole / WRITING).max(LEAST_WRITING.min(whole / MOST_OF_LITTLE));
        let left = whole.saturating_sub(taken + writing);
        let judging = (whole / if takes_rest { JUDGING } else { JUDGING_ALONE }).min(left / 2);
        Self { search: left - judging, judging }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_make_up_the_whole() {
        let seconds = Duration::from_secs_f64;
        let alone = Shares::new(seconds(80.0), None);
        assert_eq!((alone.search, alone.judging), (seconds(71.0), seconds(5.0)));
        let third = IndividualSettings { takes_rest: true, ..IndividualSettings::time(seconds(30.0)) };
        let beside = Shares::new(seconds(80.0), Some(&third));
        assert_eq!((beside.search, beside.judging), (seconds(36.0), seconds(10.0)));
        let short = Shares::new(seconds(16.0), None);
        assert_eq!((short.search, short.judging), (seconds(13.0), seconds(1.0)));
        // Hardly any is left.
        let all = IndividualSettings::time(seconds(70.0));
        let tight = Shares::new(seconds(80.0), Some(&all));
        assert_eq!((tight.search, tight.judging), (seconds(3.0), seconds(3.0)));
    }
}
