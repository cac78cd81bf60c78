//! Goals that are not seen from the front, compared with drawings from the front.
//!
//! Trees look alike from all sides, at least to likeness: front views show which species a side view is of. Growing
//! all candidates for the views of a goal takes ten times as long as growing the few near it, and longer than the
//! time of some whole fits.

use super::candidate::Candidate;
use super::found::Reference;
use super::goal_context::{GoalContext, likeness_evaluator};
use super::library::GuessLibrary;
use super::near::FROM_ELSEWHERE;
use super::ranking::ranked;
use super::references;
use super::settings::GuessSettings;
use crate::error::FitError;
use crate::problem::{FitProblem, GoalView};
use crate::run::FitSettings;
use crate::space::TreeSeed;
use pleach_silhouette::View;
use pleach_tree::Foliage;
use std::num::NonZeroU32;
use std::sync::atomic::AtomicBool;

/// Elevation in radians, 30 degrees, above which a goal is not like a view from the front.
const LEVEL: f64 = std::f64::consts::FRAC_PI_6;

/// The comparison of front views with a goal that is seen from elsewhere.
pub(super) struct Preview {
    /// Whether it has leaves.
    pub(super) foliage: Foliage,
    /// 1 minus the likeness of the best tree of each candidate.
    pub(super) costs: Vec<f64>,
    /// Likeness and overlap of each candidate's trees.
    by_candidate: Vec<Vec<Reference>>,
}

impl GuessLibrary {
    /// Compares front views with the first goal whose view is about level. `None` if the goal is seen from the front,
    /// if no goal is level, and for few candidates, which are all compared closely.
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
        // The trees of the built-in drawings, whatever is searched afterwards.
        let usual = FitSettings::default();
        let settings = FitSettings {
            seed: usual.seed,
            tree_seed: TreeSeed::Fixed(1),
            robust: NonZeroU32::MIN,
            ..settings.clone()
        };
        let guess = GuessSettings { variants: 0, ..*guess };
        let evaluator = likeness_evaluator(&front, &settings)?;
        let context =
            GoalContext::new(&front, candidates, &evaluator, &settings, stop, self.prepared.clone());
        let (entries, foliage, found) = self.seen(&context, &guess, progress)?;
        let (costs, _) = ranked(&context, (entries, &found), 0);
        let by_candidate = references::by_candidate(candidates.len(), entries, &found);
        Ok(Some(Preview { foliage, costs, by_candidate }))
    }
}

impl Preview {
    /// Adds the values from front views for candidates that were not compared closely: they are no nearer than those
    /// that were.
    pub(super) fn complete(self, costs: &mut [f64], by_candidate: &mut [Vec<Reference>]) {
        let compared = costs.iter().copied().filter(|cost| cost.is_finite());
        let farthest = compared.fold(f64::NEG_INFINITY, f64::max);
        for (cost, seen) in costs.iter_mut().zip(self.costs) {
            if !cost.is_finite() {
                *cost = seen.max(farthest);
            }
        }
        for (list, seen) in by_candidate.iter_mut().zip(self.by_candidate) {
            if list.is_empty() {
                *list = seen;
            }
        }
    }
}
