//! The assessment of a result: its trees of other seeds, how well the goal determines each number, and reference
//! values for its likeness.

use super::fresh::{FreshSeeds, fresh_seeds};
use super::profile::{Profile, profile, reset_unidentified};
use super::substitutes::substitutes;
use crate::control::Clock;
use crate::control::PreparedSearch;
use crate::control::Until;
use crate::error::FitError;
use crate::guess::{Candidate, GuessLibrary, References};
use crate::method::Start;
use crate::problem::FitProblem;
use crate::problem::Scored;
use crate::run::settled;
use pleach_tree::{Limits, Slot};
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// Settings of an assessment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AssessmentSettings {
    /// Trees of other seeds.
    pub seeds: usize,
    /// Time by the caller's clock; `None`: unlimited. If it is short, fewer trees and fewer numbers are tried, and
    /// numbers that the goal does not determine stay as they are.
    pub time: Option<Duration>,
}

impl Default for AssessmentSettings {
    /// Sixteen seeds, unlimited time.
    fn default() -> Self {
        Self { seeds: 16, time: None }
    }
}

/// An assessment of a result.
#[derive(Clone, Debug)]
pub struct Assessment {
    /// Scores of trees of seeds that the search has not seen; `None` if one of them does not grow.
    pub held_out: Option<FreshSeeds>,
    /// How well the goal determines each free number.
    pub profiles: Vec<Profile>,
    /// Slots that the goal does not determine and that were reset to the start's value.
    pub put_back: Vec<Slot>,
    /// Slots of variations of size, which are 0 because one tree does not show them.
    pub settled: Vec<Slot>,
    /// Reference values for its likeness.
    pub references: References,
    /// Duration of the assessment, by the caller's clock.
    pub elapsed: Duration,
}

/// Shares of the time after which other seeds, profiles, and resets end.
const UNTIL_FRESH: f64 = 0.3;
const UNTIL_PROFILED: f64 = 0.7;
const UNTIL_PUT_BACK: f64 = 0.85;

/// Change of the cost that counts as visible, where the spread over seeds is unknown.
const TOLERANCE: f64 = 0.01;

/// An assessment of the result of a search.
pub(crate) struct Assessor<'a> {
    pub(crate) prepared: &'a PreparedSearch,
    /// Earlier bests of the search.
    pub(crate) finalists: &'a [Scored],
    pub(crate) settings: AssessmentSettings,
    pub(crate) candidates: &'a [Candidate],
    pub(crate) clock: &'a dyn Clock,
    pub(crate) stop: &'a AtomicBool,
}

impl Assessor<'_> {
    /// Assesses `best`; returns it with numbers that the goal does not determine reset to the start's. If it does not
    /// grow from other seeds, the nearest individual that does is assessed and returned in its place.
    ///
    /// # Errors
    /// Those of [`crate::fit`], and [`FitError::Interrupted`] once the flag is raised.
    pub(crate) fn assess(
        &self,
        best: &Scored,
        library: &mut GuessLibrary,
    ) -> Result<(Scored, Assessment), FitError> {
        let Self { prepared: PreparedSearch { problem, settings, guess }, candidates, clock, stop, .. } =
            *self;
        let from = clock.elapsed();
        let until = |share: f64| {
            let time = self.settings.time.map(|time| from + time.mul_f64(share));
            Until::from(stop).or_late(clock, time)
        };
        let (best, first) = &self.growing(best, until(UNTIL_FRESH))?;
        let first = *first;
        let tolerance = first.as_ref().map_or(TOLERANCE, |fresh| fresh.cost.sd);
        let profiles = profile(problem, settings, best, tolerance, until(UNTIL_PROFILED))?;
        let (kept, put_back) = match &settings.start {
            // Reset numbers have to be assessed again, for which there has to be time.
            Start::Lists(lists) if !until(UNTIL_PROFILED).is_late() => {
                let until = until(UNTIL_PUT_BACK);
                reset_unidentified(problem, settings, best, &profiles, &lists[0], tolerance, until)?
            }
            _ => (best.clone(), Vec::new()),
        };
        // Inactive numbers were reset for readers of the file; the trees are the same.
        let (kept, put_back, held_out) =
            if same_trees(problem, &best.genome.values, &kept.genome.values, &put_back) {
                (kept, put_back, first)
            } else {
                match (first, self.held_out(&kept, until(1.0))?) {
                    // They grew before.
                    (Some(_), None) => (best.clone(), Vec::new(), first),
                    (_, held_out) => (kept, put_back, held_out),
                }
            };
        let references = match guess {
            Some(guess) => guess.references.clone(),
            // Without trees there is the ellipse.
            None if until(1.0).is_late() => library.references(problem, settings, &[], stop)?,
            None => library.references(problem, settings, candidates, stop)?,
        };
        let settled = settled(problem, settings, &kept.genome)?;
        let elapsed = clock.elapsed().saturating_sub(from);
        Ok((kept, Assessment { held_out, profiles, put_back, settled, references, elapsed }))
    }

    /// The first of `best` and its substitutes that grows from other seeds, with the scores of its trees; `best` if
    /// none does.
    fn growing(&self, best: &Scored, until: Until<'_>) -> Result<(Scored, Option<FreshSeeds>), FitError> {
        let first = self.held_out(best, until)?;
        if first.is_none() {
            for other in substitutes(best, self.finalists, &self.prepared.problem, &self.prepared.settings)? {
                let held_out = self.held_out(&other, until)?;
                if held_out.is_some() {
                    return Ok((other, held_out));
                }
            }
        }
        Ok((best.clone(), first))
    }

    /// Other trees of the same numbers, in the default limits: a search abandons trees that are not too large to
    /// grow.
    fn held_out(&self, best: &Scored, until: Until<'_>) -> Result<Option<FreshSeeds>, FitError> {
        let PreparedSearch { problem, settings, .. } = self.prepared;
        let limits = Limits::default();
        fresh_seeds(problem, settings.objective, limits, &best.genome, self.settings.seeds, until)
    }
}

/// Whether lists that differ in `slots` only, one after the other, grow the same trees from any seed.
fn same_trees(problem: &FitProblem, before: &[f64], after: &[f64], slots: &[Slot]) -> bool {
    let mut values = before.to_vec();
    slots.iter().all(|&slot| {
        let is_active = problem.start.generator.is_active(&values, slot);
        values[slot.index()] = after[slot.index()];
        !is_active
    })
}
