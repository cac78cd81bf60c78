//! What one thread grows and draws candidates with.

use super::Quest;
use super::units::Units;
use crate::evaluator::{Comparisons, Likeness, PreparedView};
use crate::objective::Objective;
use pleach_silhouette::{Bitmap, Detail, Frame, Layer, LayerPainter, Stack, View};
use pleach_tree::math;
use pleach_tree::{CheckedParams, Draws, Growth, StemKind, Tree, Workspace};

/// The pictures of the goals, and what all hands share.
pub(super) struct Scene<'a> {
    pub(super) quest: &'a Quest<'a>,
    pub(super) params: CheckedParams,
    pub(super) views: Vec<PreparedView>,
    pub(super) placed: Vec<(View, Frame)>,
}

/// How one picture compares with its goal, each in 0..=1.
pub(super) struct Looks {
    /// What is made large.
    pub(super) value: f64,
    pub(super) iou: f64,
    pub(super) likeness: f64,
}

/// Likeness from which on overlap alone counts: as much as two trees of a species have at best. As
/// [`Objective::Overlap`], which asks for less: whole trees do not come so far.
const ALIKE: f64 = 0.93;

/// As fine as a search draws.
pub(super) const DETAIL: Detail = Detail::Half;

impl Scene<'_> {
    /// What `picture` of goal number `view` is worth, and its overlap and likeness.
    pub(super) fn compare(&self, view: usize, picture: &Bitmap, memory: &mut Comparisons) -> Looks {
        let found = self.views[view].compare(picture, Objective::Blend, Likeness::Always, memory);
        let likeness = found.likeness.unwrap_or_default();
        let overlap = f64::midpoint(found.iou, found.value);
        Looks { value: overlap * math::powi((likeness / ALIKE).min(1.0), 2), iou: found.iou, likeness }
    }
}

/// Memory of one thread.
pub(super) struct Hand {
    workspace: Workspace,
    pub(super) tree: Tree,
    part: Tree,
    painters: Vec<LayerPainter>,
    pub(super) picture: Bitmap,
    pub(super) comparisons: Comparisons,
}

impl Hand {
    pub(super) fn new(scene: &Scene<'_>) -> Self {
        Self {
            workspace: Workspace::default(),
            tree: Tree::default(),
            part: Tree::default(),
            painters: scene
                .placed
                .iter()
                .map(|(view, frame)| LayerPainter::new(view, frame, DETAIL))
                .collect(),
            picture: Bitmap::default(),
            comparisons: Comparisons::default(),
        }
    }

    /// Grows the tree with these draws; whether it has grown.
    pub(super) fn grow(&mut self, scene: &Scene<'_>, draws: &Draws) -> bool {
        let Quest { problem, genome, limits, .. } = scene.quest;
        let growth = Growth {
            limits: *limits,
            foliage: problem.foliage,
            draws: Some(draws),
            ..Growth::seed(genome.tree_seed)
        };
        // The parts of the last tree may have been the whole of it.
        self.part.release_spare();
        problem.start.generator.grow(&scene.params, &growth, &mut self.workspace, &mut self.tree).is_ok()
    }

    /// Takes a part of the tree to draw.
    pub(super) fn take(&mut self, units: &Units, part: usize) {
        units.copy(&self.tree, part, &mut self.part);
    }

    /// How low the stems reach that were taken, roots left out, in metres; 0 without any.
    pub(super) fn lowest(&self) -> f64 {
        let stems = self.part.stems.iter().filter(|stem| stem.kind != StemKind::Root);
        stems.flat_map(|stem| self.part.knots_of(stem)).map(|knot| knot.point.z).fold(0.0, f64::min)
    }

    /// The layer of what was taken, view by view.
    pub(super) fn layers(&mut self, scene: &Scene<'_>) -> Vec<Layer> {
        let parts = scene.quest.problem.foliage.into();
        let draw = |painter: &mut LayerPainter| {
            let mut layer = Layer::default();
            painter.draw(&self.part, parts, &mut layer);
            layer
        };
        self.painters.iter_mut().map(draw).collect()
    }

    /// Shows what was taken in the place of `old` in goal number `view`.
    pub(super) fn show(&mut self, scene: &Scene<'_>, view: usize, stack: &Stack, old: &Layer) {
        let parts = scene.quest.problem.foliage.into();
        self.painters[view].exchanged(&self.part, parts, stack, old, &mut self.picture);
    }
}
