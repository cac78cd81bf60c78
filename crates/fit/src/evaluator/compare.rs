//! One silhouette against one goal.

use crate::nuisance::{Placement, Unknown};
use crate::objective::Objective;
use crate::problem::{FitProblem, GoalView};
use pleach_silhouette::score::fast::{Overlaps, PreparedGoal, Scratch};
use pleach_silhouette::score::likeness::{self, Descriptor};
use pleach_silhouette::{Bitmap, Frame, Projection, View};
use pleach_tree::math;

/// Memory of the comparisons.
#[derive(Debug, Default)]
pub(crate) struct Comparisons {
    overlaps: Scratch,
    likeness: likeness::Scratch,
}

/// A goal, with what comparisons need of it.
#[derive(Debug)]
pub(crate) struct PreparedView {
    prepared: PreparedGoal,
    descriptor: Descriptor,
    pub(crate) goal: Bitmap,
    pub(crate) view: View,
    pub(crate) frame: Frame,
    unknown: Unknown,
    registered: Placement,
    /// Number of its first unknown among all nuisances.
    first: usize,
}

/// Whether likeness is measured where the objective does not look at it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Likeness {
    /// Only if the objective looks at it.
    IfNeeded,
    /// In any case.
    Always,
}

/// What is measured of one silhouette against one goal, each in 0..=1.
pub(crate) struct Agreement {
    /// Share of equal pixels.
    pub(crate) accuracy: f64,
    /// Intersection over union of the ink, pixel by pixel.
    pub(crate) iou: f64,
    /// What the objective makes large.
    pub(crate) value: f64,
    /// Likeness, where it was measured.
    pub(crate) likeness: Option<f64>,
}

impl PreparedView {
    /// The goals of `problem`, which has been checked.
    pub(crate) fn of_problem(problem: &FitProblem) -> Vec<Self> {
        let mut first = 0;
        let prepare = |GoalView { goal, view, frame, unknown, registered, .. }: &GoalView| {
            let of_own = first;
            first += unknown.count();
            Self {
                prepared: PreparedGoal::new(goal),
                descriptor: Descriptor::new(goal, &mut likeness::Scratch::default()),
                goal: goal.clone(),
                view: *view,
                frame: *frame,
                unknown: *unknown,
                registered: *registered,
                first: of_own,
            }
        };
        problem.goals.iter().map(prepare).collect()
    }

    /// From where the picture was taken, and its frame.
    pub(crate) fn placed(&self, nuisances: &[f64]) -> (View, Frame) {
        let own = nuisances.get(self.first..).unwrap_or_default();
        let placement = self.unknown.placement(&self.view, own).and(&self.registered);
        (placement.view(&self.view), placement.frame(&self.frame))
    }

    /// Whether a tree twice as large is twice as large in the picture, wherever it stands.
    pub(crate) fn is_orthographic(&self) -> bool {
        self.view.projection == Projection::Orthographic
    }

    pub(crate) fn compare(
        &self,
        bitmap: &Bitmap,
        objective: Objective,
        likeness: Likeness,
        memory: &mut Comparisons,
    ) -> Agreement {
        let overlaps = self.prepared.overlaps(bitmap, &mut memory.overlaps);
        let accuracy = 1.0 - overlaps.differing as f64 / self.goal.area() as f64;
        let iou = overlaps.iou();
        let is_measured = likeness == Likeness::Always || objective.looks();
        let likeness = is_measured.then(|| {
            let descriptor = Descriptor::new(bitmap, &mut memory.likeness);
            self.descriptor.compare(&descriptor).value()
        });
        let alike = likeness.unwrap_or_default();
        let value = match objective {
            Objective::Accuracy => accuracy,
            Objective::Iou => iou,
            Objective::Blend => blend(&overlaps),
            Objective::Likeness => alike,
            Objective::Balance => f64::midpoint(blend(&overlaps), alike),
            Objective::Overlap => {
                f64::midpoint(iou, blend(&overlaps)) * math::powi((alike / ALIKE).min(1.0), 2)
            }
        };
        Agreement { accuracy, iou, value, likeness }
    }
}

/// Likeness from which on [`Objective::Overlap`] asks for no more: a little less than two trees of a species
/// have to each other, and enough for three quarters where a picture is drawn more finely than in a search.
const ALIKE: f64 = 0.765;

/// The mean of overlaps over cell sizes: cells of 32, 16, 8, 4 and 2 pixels, then single pixels.
///
/// All weigh the same: chosen by experiment over the fifteen species.
pub(crate) fn blend(overlaps: &Overlaps) -> f64 {
    // `pyramid` goes from cells of 2 pixels up. The order of the sum is part of its last bit.
    let scales = overlaps.pyramid.iter().rev().copied().chain([overlaps.iou()]);
    let (sum, count) = scales.fold((0.0, 0.0), |(sum, count), overlap| (sum + overlap, count + 1.0));
    sum / count
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A filled box.
    fn picture(left: u32, right: u32) -> Bitmap {
        let mut bitmap = Bitmap::new(64, 64);
        for row in 8..60 {
            for column in left..right {
                bitmap.set(column, row, true);
            }
        }
        bitmap
    }

    fn box_views() -> Vec<PreparedView> {
        let frame =
            Frame { width: 64, height: 64, meters_per_pixel: 0.1, axis_column: 32.0, ground_row: 60.0 };
        let view = GoalView::new(picture(20, 40), View::FRONT, frame);
        let problem = FitProblem::new(pleach_generators::preset("palm").unwrap(), view);
        PreparedView::of_problem(&problem)
    }

    #[test]
    fn overlap_counts_what_is_near_and_as_far_as_it_is_alike() {
        let views = box_views();
        let value = |picture: &Bitmap, objective| {
            let memory = &mut Comparisons::default();
            views[0].compare(picture, objective, Likeness::Always, memory)
        };
        for (left, right) in [(20, 40), (21, 40), (4, 60)] {
            let picture = picture(left, right);
            let found = value(&picture, Objective::Overlap);
            let overlaps = f64::midpoint(found.iou, value(&picture, Objective::Blend).value);
            let share = (found.likeness.unwrap() / ALIKE).min(1.0);
            assert!((found.value - overlaps * share * share).abs() < 1e-12, "{left} to {right}");
        }
        // Beside each other: a search sees which of two is nearer.
        let [near, far] = [(42, 60), (50, 60)].map(|(l, r)| value(&picture(l, r), Objective::Overlap));
        assert!(near.iou == 0.0 && far.iou == 0.0 && near.value > far.value);
    }
}
