//! Growing and drawing in memory that is kept.

use super::compare::Comparisons;
use pleach_silhouette::{Bitmap, Detail, Rasterizer};
use pleach_tree::{CheckedParams, Generator, Growth, StemKind, Tree, Workspace};

/// Memory that one thread reuses from one evaluation to the next: about the largest tree so far.
#[derive(Debug)]
pub struct EvalWorkspace {
    params: CheckedParams,
    pub(super) values: Vec<f64>,
    pub(super) tree: Tree,
    workspace: Workspace,
    pub(super) rasterizer: Rasterizer,
    /// For pictures at twice the goal's size: there half the samples are as many. They are drawn
    /// as any picture is, so that the drawings of known species that are built in stay as they are.
    pub(super) fine: Rasterizer,
    pub(super) bitmap: Bitmap,
    pub(super) comparisons: Comparisons,
}

impl EvalWorkspace {
    /// For trees of `generator`.
    ///
    /// # Panics
    /// If the generator's defaults are not allowed by its own declarations: a mistake there.
    pub(super) fn new(generator: &dyn Generator) -> Self {
        let space = generator.space();
        Self {
            params: space.check(space.defaults()).expect("defaults are allowed values"),
            values: Vec::new(),
            tree: Tree::default(),
            workspace: Workspace::default(),
            rasterizer: Rasterizer::for_searches(Detail::Half),
            fine: Rasterizer::with_detail(Detail::Draft),
            bitmap: Bitmap::default(),
            comparisons: Comparisons::default(),
        }
    }

    /// Grows the tree of `values`; whether it has grown.
    pub(super) fn grow(&mut self, generator: &dyn Generator, growth: &Growth) -> bool {
        self.params.set(&self.values).is_ok()
            && generator.grow(&self.params, growth, &mut self.workspace, &mut self.tree).is_ok()
    }

    /// Whether the tree stands on one trunk. How far apart several stand may not grow with them.
    pub(super) fn has_one_trunk(&self) -> bool {
        let mut trunks = self.tree.stems.iter().filter(|stem| stem.kind == StemKind::Trunk);
        trunks.next().is_some() && trunks.next().is_none()
    }

    /// The tree of the last evaluation.
    #[must_use]
    pub const fn tree(&self) -> &Tree {
        &self.tree
    }

    /// The silhouette of the last evaluation, in its last view.
    #[must_use]
    pub const fn bitmap(&self) -> &Bitmap {
        &self.bitmap
    }
}
