//! From where the goals are seen, and where in their pictures trees stand.

use crate::problem::{FitProblem, Placement, Unknown};
use pleach_silhouette::{Frame, Projection, View};

/// The direction and the frame of a goal, for individuals with nuisance parameters.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Viewpoint {
    view: View,
    frame: Frame,
    unknown: Unknown,
    registered: Placement,
    /// Number of its first unknown among all nuisances.
    first: usize,
}

impl Viewpoint {
    /// Those of the goals of `problem`.
    pub(super) fn from_problem(problem: &FitProblem) -> Vec<Self> {
        let mut first = 0;
        let mut viewpoints = Vec::with_capacity(problem.goals.len());
        for goal in &problem.goals {
            let (view, frame, unknown, registered) = (goal.view, goal.frame, goal.unknown, goal.registered);
            viewpoints.push(Self { view, frame, unknown, registered, first });
            first += unknown.count();
        }
        viewpoints
    }

    /// Direction and frame for an individual with these `nuisances`.
    pub(super) fn placed(&self, nuisances: &[f64]) -> (View, Frame) {
        let own = nuisances.get(self.first..).unwrap_or_default();
        let placement = self.unknown.placement(&self.view, own).and(&self.registered);
        (placement.view(&self.view), placement.frame(&self.frame))
    }

    /// Whether a tree twice as large is twice as large in the picture, wherever it stands.
    pub(super) fn is_orthographic(&self) -> bool {
        self.view.projection == Projection::Orthographic
    }
}
