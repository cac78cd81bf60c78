//! Memory with which one thread grows and draws candidates.

use super::task::Task;
use super::units::Units;
use crate::evaluator::{Buffers, SilhouetteGoal};
use crate::problem::{Objective, Terms};
use pleach_silhouette::{Bitmap, Detail, Frame, Layer, LayerPainter, Stack, View};
use pleach_tree::math;
use pleach_tree::{CheckedParams, Draws, Growth, StemKind, Tree, Workspace};
use std::sync::{Mutex, PoisonError};

/// The goals, and everything else that all workers share.
pub(super) struct Scene<'a> {
    pub(super) task: &'a Task<'a>,
    pub(super) params: CheckedParams,
    pub(super) views: Vec<SilhouetteGoal>,
    pub(super) placed: Vec<(View, Frame)>,
}

/// How one picture compares with its goal, each in 0..=1.
pub(super) struct Comparison {
    /// The value that is maximised.
    pub(super) value: f64,
    pub(super) iou: f64,
    pub(super) likeness: f64,
}

/// Likeness above which only overlap counts: the best of two trees of a species. [`Objective::Overlap`] has a lower
/// one, since whole trees do not reach it.
const ALIKE: f64 = 0.93;

/// As fine as a search draws.
pub(super) const DETAIL: Detail = Detail::Half;

impl Scene<'_> {
    /// Compares `picture` with goal number `view`.
    pub(super) fn compare(&self, view: usize, picture: &Bitmap, buffers: &mut Buffers) -> Comparison {
        let found =
            self.views[view].compare(picture, Terms { objective: Objective::Blend, likeness: true }, buffers);
        let likeness = found.likeness.unwrap_or_default();
        let overlap = f64::midpoint(found.iou, found.value);
        Comparison { value: overlap * math::powi((likeness / ALIKE).min(1.0), 2), iou: found.iou, likeness }
    }
}

/// Memory of one thread.
pub(super) struct Worker {
    workspace: Workspace,
    pub(super) tree: Tree,
    part: Tree,
    painters: Vec<LayerPainter>,
    pub(super) picture: Bitmap,
    pub(super) buffers: Buffers,
}

impl Worker {
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
            buffers: Buffers::default(),
        }
    }

    /// Grows the tree with these draws; whether it has grown.
    pub(super) fn grow(&mut self, scene: &Scene<'_>, draws: &Draws) -> bool {
        let Task { problem, genome, limits, .. } = scene.task;
        let growth = Growth {
            limits: *limits,
            foliage: problem.foliage,
            draws: Some(draws),
            ..Growth::seed(genome.tree_seed)
        };
        // A part of the last tree may have been nearly all of it.
        self.part.release_spare();
        problem.start.generator.grow(&scene.params, &growth, &mut self.workspace, &mut self.tree).is_ok()
    }

    /// Takes a part of the tree, for drawing.
    pub(super) fn take(&mut self, units: &Units, part: usize) {
        units.copy(&self.tree, part, &mut self.part);
    }

    /// Lowest height of the stems that were taken, without roots, in metres; 0 without any.
    pub(super) fn lowest(&self) -> f64 {
        let stems = self.part.stems.iter().filter(|stem| stem.kind != StemKind::Root);
        stems.flat_map(|stem| self.part.knots_of(stem)).map(|knot| knot.point.z).fold(0.0, f64::min)
    }

    /// The layers of the taken part, view by view.
    pub(super) fn layers(&mut self, scene: &Scene<'_>) -> Vec<Layer> {
        let parts = scene.task.problem.foliage.into();
        let draw = |painter: &mut LayerPainter| {
            let mut layer = Layer::default();
            painter.draw(&self.part, parts, &mut layer);
            layer
        };
        self.painters.iter_mut().map(draw).collect()
    }

    /// Draws the taken part in place of `old` in goal number `view`.
    pub(super) fn show(&mut self, scene: &Scene<'_>, view: usize, stack: &Stack, old: &Layer) {
        let parts = scene.task.problem.foliage.into();
        self.painters[view].exchanged(&self.part, parts, stack, old, &mut self.picture);
    }
}

/// A pool of memory for threads.
#[derive(Default)]
pub(super) struct Workers(Mutex<Vec<Worker>>);

impl Workers {
    pub(super) fn with<T>(&self, scene: &Scene<'_>, work: impl FnOnce(&mut Worker) -> T) -> T {
        let pool = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let taken = pool().pop();
        let mut worker = taken.unwrap_or_else(|| Worker::new(scene));
        let result = work(&mut worker);
        pool().push(worker);
        result
    }
}
