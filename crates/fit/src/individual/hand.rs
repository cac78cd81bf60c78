//! What one thread grows and draws candidates with.

use super::Quest;
use super::units::Units;
use crate::evaluator::{Agreement, Comparisons, Likeness, PreparedView};
use pleach_silhouette::{Bitmap, Detail, Frame, Layer, LayerPainter, View};
use pleach_tree::{CheckedParams, Draws, Growth, Tree, Workspace};

/// The pictures of the goals, and what all hands share.
pub(super) struct Scene<'a> {
    pub(super) quest: &'a Quest<'a>,
    pub(super) params: CheckedParams,
    pub(super) views: Vec<PreparedView>,
    pub(super) placed: Vec<(View, Frame)>,
}

/// As fine as a search draws.
pub(super) const DETAIL: Detail = Detail::Half;

impl Scene<'_> {
    /// Shows `picture` of goal number `view`.
    pub(super) fn compare(&self, view: usize, picture: &Bitmap, memory: &mut Comparisons) -> Agreement {
        let objective = self.quest.settings.objective;
        self.views[view].compare(picture, objective, Likeness::IfNeeded, memory)
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
        problem.start.generator.grow(&scene.params, &growth, &mut self.workspace, &mut self.tree).is_ok()
    }

    /// Draws a part of the tree into the layer of each view.
    pub(super) fn draw(&mut self, scene: &Scene<'_>, units: &Units, part: usize, layers: &mut Vec<Layer>) {
        units.copy(&self.tree, part, &mut self.part);
        layers.resize_with(self.painters.len(), Layer::default);
        for (painter, layer) in self.painters.iter_mut().zip(layers) {
            painter.draw(&self.part, scene.quest.problem.foliage.into(), layer);
        }
    }
}
