//! The assessment of a result: its trees of other seeds, how well the goal determines each number, and reference
//! values for its likeness.

use super::fresh::{FreshSeeds, fresh_seeds};
use super::profile::{Profile, profile};
use super::substitutes::substitutes;
use crate::control::Clock;
use crate::control::PreparedSearch;
use crate::control::Until;
use crate::error::FitError;
use crate::guess::{Candidate, GuessLibrary, References};
use crate::posterior::PosteriorNumber;
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
    /// Time by the caller's clock; `None`: unlimited. If it is short, fewer trees and fewer numbers are tried.
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
    /// Slots of variations of size, which are 0 because one tree does not show them.
    pub settled: Vec<Slot>,
    /// Reference values for its likeness.
    pub references: References,
    /// Duration of the assessment, by the caller's clock.
    pub elapsed: Duration,
}

/// Shares of the time after which other seeds and profiles end.
const UNTIL_FRESH: f64 = 0.5;
const UNTIL_PROFILED: f64 = 0.9;

/// Change of the cost that counts as visible, where the spread over seeds is unknown.
const TOLERANCE: f64 = 0.01;

/// An assessment of the result of a search.
pub(crate) struct Assessor<'a> {
    pub(crate) prepared: &'a PreparedSearch,
    /// Earlier bests of the search.
    pub(crate) finalists: &'a [Scored],
    pub(crate) settings: AssessmentSettings,
    pub(crate) candidates: &'a [Candidate],
    /// What is known of numbers without a move.
    pub(crate) known: &'a [PosteriorNumber],
    pub(crate) clock: &'a dyn Clock,
    pub(crate) stop: &'a AtomicBool,
}

impl Assessor<'_> {
    /// Assesses `best` and returns it. If it does not grow from other seeds, the nearest individual that does is assessed
    /// and returned in its place.
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
        let (best, held_out) = self.growing(best, until(UNTIL_FRESH))?;
        let tolerance = held_out.as_ref().map_or(TOLERANCE, |fresh| fresh.cost.sd);
        let profiles = profile(problem, settings, &best, self.known, tolerance, until(UNTIL_PROFILED))?;
        let references = match guess {
            Some(guess) => guess.references.clone(),
            // Without trees there is the ellipse.
            None if until(1.0).is_late() => library.references(problem, settings, &[], stop)?,
            None => library.references(problem, settings, candidates, stop)?,
        };
        let settled = settled(problem, settings, &best.genome)?;
        let elapsed = clock.elapsed().saturating_sub(from);
        Ok((best, Assessment { held_out, profiles, settled, references, elapsed }))
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
