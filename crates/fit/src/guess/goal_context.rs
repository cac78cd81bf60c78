//! What the comparisons of a first guess have in common.

use super::candidate::{Candidate, Models};
use super::drawings::Drawings;
use crate::error::FitError;
use crate::evaluator::{Evaluator, SilhouetteGoal};
use crate::problem::Objective;
use crate::problem::{Azimuth, FitProblem};
use crate::run::FitSettings;
use std::sync::atomic::AtomicBool;

/// Goals, candidates, and how they are compared.
pub(super) struct GoalContext<'a> {
    /// The goals whose views are known.
    pub(super) problem: &'a FitProblem,
    pub(super) candidates: &'a [Candidate],
    pub(super) models: Models,
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
        Self { problem, candidates, models, silhouettes, settings, stop, drawings }
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
