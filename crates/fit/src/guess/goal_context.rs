//! What the comparisons of a first guess have in common.

use super::candidate::{Candidate, Models};
use super::drawings::Drawings;
use super::settings::Contradictions;
use crate::error::FitError;
use crate::evaluator::{Evaluator, SilhouetteGoal};
use crate::problem::Objective;
use crate::problem::{Azimuth, FitProblem, GoalView};
use crate::run::FitSettings;
use pleach_reading::Reading;
use pleach_silhouette::View;
use std::sync::atomic::AtomicBool;

/// Goals, candidates, and how they are compared.
pub(super) struct GoalContext<'a> {
    /// The goals whose views are known.
    pub(super) problem: &'a FitProblem,
    pub(super) candidates: &'a [Candidate],
    pub(super) models: Models,
    /// What is in the first of them; `None` if contradictions are ignored, or if it is not seen from the side.
    pub(super) reading: Option<Reading>,
    /// How much of its likeness a tree loses for a contradiction: more where a person has corrected the reading.
    pub(super) weight: f64,
    /// Their silhouettes.
    pub(super) silhouettes: Vec<SilhouetteGoal>,
    pub(super) settings: &'a FitSettings,
    pub(super) stop: &'a AtomicBool,
    /// Drawings of trees that need not be grown.
    pub(super) drawings: Option<Drawings>,
}

impl<'a> GoalContext<'a> {
    pub(super) fn new(
        problem: &'a FitProblem,
        candidates: &'a [Candidate],
        evaluator: &Evaluator,
        settings: &'a FitSettings,
        stop: &'a AtomicBool,
        drawings: Option<Drawings>,
    ) -> Self {
        let silhouettes = problem.goals.iter().map(|goal| SilhouetteGoal::new(&goal.goal)).collect();
        let models = Models::new(candidates, evaluator);
        Self {
            problem,
            candidates,
            models,
            reading: None,
            weight: 1.0,
            silhouettes,
            settings,
            stop,
            drawings,
        }
    }

    /// The same, with what is in the first goal where `contradictions` are counted.
    pub(super) fn with_contradictions(mut self, contradictions: Contradictions) -> Self {
        let first = self.problem.goals.first().filter(|goal| is_level(&goal.view));
        if contradictions == Contradictions::Counted {
            let read = |goal: &GoalView| Reading::from_silhouette(&goal.goal);
            if first.is_some_and(|goal| goal.reading.is_some()) {
                self.weight = CORRECTED;
            }
            self.reading = first.map(|goal| goal.reading.clone().unwrap_or_else(|| read(goal)));
        }
        self
    }

    /// Makes the tree of `values` larger by `factor`, if the candidate's generator can.
    pub(super) fn resize(&self, candidate: usize, values: &mut [f64], factor: f64) -> bool {
        self.candidates[candidate].species.generator.resize(values, factor)
    }

    /// The family of candidate number `candidate`.
    pub(super) fn family(&self, candidate: usize) -> &'static str {
        self.candidates[candidate].species.generator.family()
    }
}

/// What a person says counts as much as so many contradictions that were read.
const CORRECTED: f64 = 2.0;
/// From above or below, in radians: farther, feet and trunks are not what a reading takes them for.
const LEVEL: f64 = 0.2;

pub(super) fn is_level(view: &View) -> bool {
    view.elevation.abs() <= LEVEL
}

/// `problem` without the pictures whose azimuth is unknown: the search has to find it first.
pub(super) fn known_views(problem: &FitProblem) -> FitProblem {
    let mut known = problem.clone();
    known.goals.retain(|goal| goal.unknown.azimuth != Azimuth::Any);
    known
}

pub(super) fn likeness_evaluator(
    problem: &FitProblem,
    settings: &FitSettings,
) -> Result<Evaluator, FitError> {
    let evaluator = Evaluator::new(problem, Objective::Likeness, settings.limits)?;
    Ok(evaluator.with_seeds(settings.robust).with_height_matching())
}
