//! A goal as candidates are shown beside it.

use super::candidate::{Candidate, Models};
use super::drawings::Drawings;
use crate::evaluator::Evaluator;
use crate::problem::FitProblem;
use crate::settings::FitSettings;
use std::sync::atomic::AtomicBool;

/// Goals, what they are compared with, and how.
pub(super) struct Shown<'a> {
    /// The goals whose views are known.
    pub(super) problem: &'a FitProblem,
    pub(super) candidates: &'a [Candidate],
    pub(super) models: Models,
    pub(super) settings: &'a FitSettings,
    pub(super) stop: &'a AtomicBool,
    /// Of trees that need not be grown.
    pub(super) drawings: Option<Drawings>,
}

impl<'a> Shown<'a> {
    pub(super) fn new(
        problem: &'a FitProblem,
        candidates: &'a [Candidate],
        looks: &Evaluator,
        settings: &'a FitSettings,
        stop: &'a AtomicBool,
        drawings: Option<Drawings>,
    ) -> Self {
        Self { problem, candidates, models: Models::new(candidates, looks), settings, stop, drawings }
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
