//! What the parts of a growth share.

use crate::budget::Budget;
use crate::course::Course;
use crate::model::Model;
use crate::path::PathPoint;
use crate::solid::Surroundings;
use crate::stem::StemSpec;
use pleach_tree::{Growth, Tree};

/// One growth of one tree: what does not change while it grows.
#[derive(Clone, Copy)]
pub(crate) struct GrowContext<'a> {
    pub(crate) model: &'a Model,
    pub(crate) surroundings: &'a Surroundings,
    /// By how far the tree will be displaced once it has grown; `None` where it stays upright.
    pub(crate) course: Option<Course>,
    pub(crate) growth: &'a Growth<'a>,
    /// Whether trunks are pruned, and not their branches alone.
    pub(crate) prunes_trunks: bool,
}

impl GrowContext<'_> {
    /// Whether stems may be pruned.
    pub(crate) fn prunes(&self) -> bool {
        self.model.prune_ratio > 0.0 || self.growth.hull().is_some()
    }
}

/// Memory reused from tree to tree.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    pub(crate) path: Vec<PathPoint>,
    forked_stems: Vec<StemSpec>,
    children: Vec<StemSpec>,
}

impl Scratch {
    /// Empty stacks to grow `tree` with.
    pub(crate) fn buffers<'a>(&'a mut self, tree: &'a mut Tree, budget: Budget<'a>) -> Buffers<'a> {
        let Self { path, forked_stems, children } = self;
        path.clear();
        forked_stems.clear();
        children.clear();
        Buffers { tree, path, forked_stems, children, budget }
    }
}

/// The tree being grown and the stacks that growing it needs.
pub(crate) struct Buffers<'a> {
    pub(crate) tree: &'a mut Tree,
    pub(crate) path: &'a mut Vec<PathPoint>,
    pub(crate) forked_stems: &'a mut Vec<StemSpec>,
    /// Stems that wait to be grown. Within a stem's own, the next to grow is the last.
    pub(crate) children: &'a mut Vec<StemSpec>,
    pub(crate) budget: Budget<'a>,
}
