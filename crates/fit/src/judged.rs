//! What a result is worth once the search has ended: how it does with other seeds, what of it the goal
//! determines, and what its likeness stands beside.

use crate::begun::Begun;
use crate::budget::Clock;
use crate::cancellable::Until;
use crate::error::FitError;
use crate::fresh::{FreshSeeds, fresh_seeds};
use crate::genome::Scored;
use crate::guess::{Candidate, GuessLibrary, References};
use crate::instead::instead_of;
use crate::method::Start;
use crate::problem::FitProblem;
use crate::profile::{Profile, profile, reset_unidentified};
use crate::run::settled;
use pleach_tree::{Limits, Slot};
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// How a result is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Judging {
    /// Trees of other seeds.
    pub seeds: usize,
    /// Time by the caller's clock; where it is short there are fewer trees and fewer numbers are tried, and where
    /// there is none to spare, numbers that the goal does not show stay as they are.
    pub time: Option<Duration>,
}

impl Default for Judging {
    /// By sixteen seeds, whatever the time.
    fn default() -> Self {
        Self { seeds: 16, time: None }
    }
}

/// What is known of a result beside its score.
#[derive(Clone, Debug)]
pub struct Judged {
    /// How trees of seeds do that the search has not seen; none if one of them does not grow.
    pub held_out: Option<FreshSeeds>,
    /// How well the goal determines each free number.
    pub profiles: Vec<Profile>,
    /// Slots that the goal does not show and that went back to the start's value.
    pub put_back: Vec<Slot>,
    /// Slots of variations of size, which are 0 because one tree does not show them.
    pub settled: Vec<Slot>,
    /// What its likeness stands beside.
    pub references: References,
    /// What judging took, by the caller's clock.
    pub elapsed: Duration,
}

/// The shares of the time at which other seeds, numbers, and numbers that go back have had enough of it.
const UNTIL_FRESH: f64 = 0.3;
const UNTIL_PROFILED: f64 = 0.7;
const UNTIL_PUT_BACK: f64 = 0.85;

/// Cost beyond which a change is seen, where no spread over seeds is known.
const TOLERANCE: f64 = 0.01;

/// What judging needs beside the result.
pub(crate) struct Judge<'a> {
    pub(crate) begun: &'a Begun,
    /// Earlier bests of the search.
    pub(crate) finalists: &'a [Scored],
    pub(crate) judging: Judging,
    pub(crate) candidates: &'a [Candidate],
    pub(crate) clock: &'a dyn Clock,
    pub(crate) stop: &'a AtomicBool,
}

impl Judge<'_> {
    /// Judges `best`; returns it with numbers that the goal does not show back at the start's. If it does not grow
    /// from other seeds, the nearest one that does is judged and returned in its place.
    ///
    /// # Errors
    /// Those of [`crate::fit`], and [`FitError::Interrupted`] once the flag is raised.
    pub(crate) fn judge(
        &self,
        best: &Scored,
        library: &mut GuessLibrary,
    ) -> Result<(Scored, Judged), FitError> {
        let Self { begun: Begun { problem, settings, guess }, judging, candidates, clock, stop, .. } = *self;
        let from = clock.elapsed();
        let until = |share: f64| {
            let time = judging.time.map(|time| from + time.mul_f64(share));
            Until::from(stop).or_late(clock, time)
        };
        let (best, first) = &self.growing(best, until(UNTIL_FRESH))?;
        let first = *first;
        let tolerance = first.as_ref().map_or(TOLERANCE, |fresh| fresh.cost.sd);
        let profiles = profile(problem, settings, best, tolerance, until(UNTIL_PROFILED))?;
        let (kept, put_back) = match &settings.start {
            // Other numbers would have to be judged again.
            Start::Lists(lists) if !until(UNTIL_PROFILED).is_late() => {
                let until = until(UNTIL_PUT_BACK);
                reset_unidentified(problem, settings, best, &profiles, &lists[0], tolerance, until)?
            }
            _ => (best.clone(), Vec::new()),
        };
        // Numbers that no tree reads went back for the reader of the file; the trees are the same.
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
        Ok((kept, Judged { held_out, profiles, put_back, settled, references, elapsed }))
    }

    /// The first of `best` and what may stand for it that grows from other seeds, with how its trees do; `best`
    /// if none does.
    fn growing(&self, best: &Scored, until: Until<'_>) -> Result<(Scored, Option<FreshSeeds>), FitError> {
        let first = self.held_out(best, until)?;
        if first.is_none() {
            for other in instead_of(best, self.finalists, &self.begun.problem, &self.begun.settings)? {
                let held_out = self.held_out(&other, until)?;
                if held_out.is_some() {
                    return Ok((other, held_out));
                }
            }
        }
        Ok((best.clone(), first))
    }

    /// Other trees of the same numbers, in the limits of growing: a search gives up trees that are no
    /// trouble to grow.
    fn held_out(&self, best: &Scored, until: Until<'_>) -> Result<Option<FreshSeeds>, FitError> {
        let Begun { problem, settings, .. } = self.begun;
        let limits = Limits::default();
        fresh_seeds(problem, settings.objective, limits, &best.genome, self.judging.seeds, until)
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
