//! How the time of a fit is shared out, so that all of it together takes as long as it may.

use pleach_fit::{AssessmentSettings, CostModel, Deadline, GoalSettings, IndividualSettings, Reserve};
use std::time::Duration;

/// How the whole of a fit's time is shared out: what is for this very tree is its
/// [`IndividualSettings::time`], and all else is for the first guess, the search, the assessment and the caller's work on
/// the result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shares {
    whole: Duration,
    /// All but what is for this very tree: [`pleach_fit::Budget::timeout`]. What the search has to leave of it is
    /// [`Shares::bound`]'s to say.
    pub search: Duration,
    /// Upper bounds of the parts of it for the assessment, and for the assessment and the caller's work together.
    assessment: Duration,
    reserve: Duration,
}

/// The parts of the whole that assessment gets, one of this many: more where this very tree can use what it
/// leaves.
const ASSESSMENT: u32 = 8;
const ASSESSMENT_ALONE: u32 = 16;
/// The part that pictures and files get, one of this many: at least what they take for most species, where there
/// is time.
const RESULT: u32 = 20;
const MIN_RESULT: Duration = Duration::from_secs(2);
const MAX_RESULT_PART: u32 = 8;
/// Trees that assessment grows, for most species.
const ASSESSED: f64 = 300.0;

/// What callers that paint no pictures do with a tree that is found: draw and score it once more.
pub const DRAWING: CostModel = CostModel { fixed: Duration::from_millis(100), serial: 3.0, parallel: 0.0 };

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
        let result = (whole / RESULT).max(MIN_RESULT.min(whole / MAX_RESULT_PART));
        let search = whole.saturating_sub(taken);
        let left = search.saturating_sub(result);
        let assessment = (whole / if takes_rest { ASSESSMENT } else { ASSESSMENT_ALONE }).min(left / 2);
        Self { whole, search, assessment, reserve: search - left + assessment }
    }

    /// `settings` whose search has [`Shares::search`], so that all of the fit ends on time with what its caller does
    /// with the tree of the kind and with an individual, each, and with every further individual.
    ///
    /// A continued fit has used time before: the timeout in `settings` is longer by that.
    #[must_use]
    pub fn bound(&self, mut settings: GoalSettings, result: CostModel, further: CostModel) -> GoalSettings {
        let used = settings.search.budget.timeout.unwrap_or(self.search).saturating_sub(self.search);
        let cost = CostModel { parallel: result.parallel + REGISTERED + ASSESSED, ..result };
        settings.search.budget.reserve = Some(Reserve { max: self.reserve, cost });
        settings.assessment =
            settings.assessment.map(|how| AssessmentSettings { time: Some(self.assessment), ..how });
        settings.deadline = Some(Deadline { after: self.whole + used, result, further });
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
            [shares.search, shares.assessment, shares.reserve].map(|time| time.as_secs_f64())
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
        let none = CostModel::default();
        let after =
            |settings: &GoalSettings| shares.bound(settings.clone(), none, none).deadline.unwrap().after;
        assert_eq!(after(&settings), Duration::from_secs(80));
        settings.search.budget.timeout = Some(Duration::from_secs(92));
        assert_eq!(after(&settings), Duration::from_secs(92));
    }
}
