//! The hulls of a goal, and the course of its trunk, for trees whose crowns can grow into a hull.

use super::cells::{CELLS, Cells};
use super::state::State;
use super::worker::Scene;
use crate::problem::GoalView;
use pleach_reading::Reading;
use pleach_silhouette::Frame;
use pleach_tree::Hull;

/// The cells of all goals.
pub(super) struct Crown {
    cells: Vec<Cells>,
    trunk: Vec<[f64; 2]>,
}

impl Crown {
    /// Of the goals of `scene`, for trees of the height `height`; `None` where a goal has no crown or does not show how
    /// high things are.
    pub(super) fn new(scene: &Scene<'_>, height: f64) -> Option<Self> {
        let goals = scene.task.problem.goals.iter().zip(&scene.placed);
        let trunks: Vec<_> = goals.clone().map(|(goal, (_, frame))| trunk(goal, frame, height)).collect();
        let cells = goals.zip(&trunks);
        let cells = cells.map(|((goal, placed), trunk)| Cells::new(&goal.goal, placed, height, trunk));
        let cells = cells.collect::<Option<_>>()?;
        let points = trunks.first()?.iter();
        Some(Self { cells, trunk: points.map(|point| [point[0], point[1]]).collect() })
    }

    /// Densities of a hull, view by view; see [`Cells::levels`].
    pub(super) fn levels(&self, margin: i32, is_even: bool) -> Vec<Vec<f64>> {
        self.cells.iter().map(|cells| cells.levels(margin, is_even)).collect()
    }

    /// How much ink the tree of `state` lacks in each cell, view by view; see [`Cells::lacking`].
    pub(super) fn lacking(&self, scene: &Scene<'_>, state: &State, height: f64) -> Vec<Vec<f64>> {
        let placed = state.pictures().zip(&scene.placed);
        let cells = self.cells.iter().zip(placed);
        cells.map(|(cells, (picture, (_, frame)))| cells.lacking(picture, frame, height)).collect()
    }

    /// The hull whose densities are `levels`, view by view.
    pub(super) fn hull(&self, levels: &[Vec<f64>], seed: u32) -> Hull {
        let views = self.cells.iter().zip(levels).map(|(cells, levels)| cells.view(levels)).collect();
        Hull { views, trunk: self.trunk.clone(), seed }
    }
}

/// Place, height and width of the trunk over `height` as far up as it is bare, in each row of cells.
fn trunk(goal: &GoalView, frame: &Frame, height: f64) -> Vec<[f64; 3]> {
    let read = || Reading::from_silhouette(&goal.goal);
    let reading = goal.reading.clone().unwrap_or_else(read);
    let Some((_, top, _, bottom)) = goal.goal.ink_box() else { return Vec::new() };
    let scale = f64::from(bottom + 1 - top) * frame.meters_per_pixel / height;
    let bare = reading.bare_height.unwrap_or(0.0);
    let mut points = Vec::new();
    for pair in reading.trunk.windows(2) {
        let [from, to] = [pair[0], pair[1]].map(|point| point.map(|value| value * scale));
        let (first, last) =
            ((from[1] * CELLS).ceil() as i64, (to[1].min(bare * scale) * CELLS).floor() as i64);
        for row in first.max(0)..=last {
            let z = row as f64 / CELLS;
            let part = (z - from[1]) / (to[1] - from[1]).max(1e-9);
            points.push([from[0] + (to[0] - from[0]) * part, z, from[2] + (to[2] - from[2]) * part]);
        }
    }
    points
}
