//! A look at goals from elsewhere through the drawings that there are: those from the front.
//!
//! Trees look alike from all sides, to likeness at least: which species a side view is of can be told from front views.
//! To grow all candidates for the views of a goal takes ten times as long as to grow the few that are near it, and is
//! longer than some whole fits may take.

use super::candidate::Candidate;
use super::library::GuessLibrary;
use super::near::FROM_ELSEWHERE;
use super::references::{self, Reference};
use super::settings::GuessSettings;
use super::shown::Shown;
use super::{looks, ranked};
use crate::error::FitError;
use crate::problem::{FitProblem, GoalView};
use crate::settings::FitSettings;
use crate::space::TreeSeed;
use pleach_silhouette::View;
use pleach_tree::Foliage;
use std::num::NonZeroU32;
use std::sync::atomic::AtomicBool;

/// Elevation in radians, 30 degrees, from which on a goal is not like a view from the front.
const LEVEL: f64 = std::f64::consts::FRAC_PI_6;

/// What front views say of a goal that is seen from elsewhere.
pub(super) struct Preview {
    /// Whether it has leaves.
    pub(super) foliage: Foliage,
    /// What the best tree of each candidate lacks of a likeness of 1.
    pub(super) costs: Vec<f64>,
    /// What trees of each candidate have.
    of_species: Vec<Vec<Reference>>,
}

impl GuessLibrary {
    /// Compares front views with the first goal that is seen from about level; none where the front is what is seen
    /// anyway, where no goal is level, and of few candidates, which are all compared closely.
    pub(super) fn preview(
        &mut self,
        known: &FitProblem,
        settings: &FitSettings,
        candidates: &[Candidate],
        guess: &GuessSettings,
        stop: &AtomicBool,
        progress: impl FnMut(usize, usize),
    ) -> Result<Option<Preview>, FitError> {
        let is_front = known.goals.len() == 1 && known.goals[0].view == View::FRONT;
        let level = known.goals.iter().find(|goal| goal.view.elevation.abs() < LEVEL);
        let Some(goal) = level.filter(|_| !is_front && candidates.len() > FROM_ELSEWHERE) else {
            return Ok(None);
        };
        let goal = GoalView::new(goal.goal.clone(), View::FRONT, goal.frame);
        let front = FitProblem { goals: vec![goal], ..known.clone() };
        // The trees that there are drawings of, whatever is searched afterwards.
        let usual = FitSettings::default();
        let settings = FitSettings {
            seed: usual.seed,
            tree_seed: TreeSeed::Fixed(1),
            robust: NonZeroU32::MIN,
            ..settings.clone()
        };
        let guess = GuessSettings { variants: 0, ..*guess };
        let looks = looks(&front, &settings)?;
        let shown = Shown::new(&front, candidates, &looks, &settings, stop, self.prepared.clone());
        let (entries, foliage, found) = self.seen(&shown, &guess, progress)?;
        let (costs, _) = ranked(&shown, (entries, &found), 0);
        let of_species = references::of_species(candidates.len(), entries, &found);
        Ok(Some(Preview { foliage, costs, of_species }))
    }
}

impl Preview {
    /// Completes what is known of candidates that were compared closely by what front views say of the others: they
    /// are no nearer than those.
    pub(super) fn complete(self, costs: &mut [f64], of_species: &mut [Vec<Reference>]) {
        let compared = costs.iter().copied().filter(|cost| cost.is_finite());
        let farthest = compared.fold(f64::NEG_INFINITY, f64::max);
        for (cost, seen) in costs.iter_mut().zip(self.costs) {
            if !cost.is_finite() {
                *cost = seen.max(farthest);
            }
        }
        for (list, seen) in of_species.iter_mut().zip(self.of_species) {
            if list.is_empty() {
                *list = seen;
            }
        }
    }
}
