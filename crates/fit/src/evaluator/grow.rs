//! Memory for growing and comparing trees.

use pleach_silhouette::{Detail, Rasterizer};
use pleach_tree::{CheckedParams, Generator, Growth, StemKind, Tree, Workspace};
use std::any::Any;

/// Memory that one thread reuses from one evaluation to the next: about the largest tree so far.
#[derive(Debug)]
pub struct EvalWorkspace {
    params: CheckedParams,
    pub(super) values: Vec<f64>,
    pub(super) tree: Tree,
    workspace: Workspace,
    /// Of each goal what its evidence needs.
    pub(super) evidence: Vec<Box<dyn Any + Send>>,
    /// For fine silhouettes: at twice the goal's size half the samples are as many. They are drawn as any picture
    /// is, so that the drawings of known species that are built in stay as they are.
    pub(super) fine: Rasterizer,
}

impl EvalWorkspace {
    /// For trees of `generator`.
    ///
    /// # Panics
    /// If the generator's defaults are not allowed by its own declarations: a mistake there.
    pub(super) fn new(generator: &dyn Generator, evidence: Vec<Box<dyn Any + Send>>) -> Self {
        let space = generator.space();
        Self {
            params: space.check(space.defaults()).expect("defaults are allowed values"),
            values: Vec::new(),
            tree: Tree::default(),
            workspace: Workspace::default(),
            evidence,
            fine: Rasterizer::with_detail(Detail::Draft),
        }
    }

    /// Grows the tree of `values`; whether it has grown.
    pub(super) fn grow(&mut self, generator: &dyn Generator, growth: &Growth) -> bool {
        self.params.set(&self.values).is_ok()
            && generator.grow(&self.params, growth, &mut self.workspace, &mut self.tree).is_ok()
    }

    /// Whether the tree stands on one trunk. The distance between several trunks need not grow with them.
    pub(super) fn has_one_trunk(&self) -> bool {
        let mut trunks = self.tree.stems.iter().filter(|stem| stem.kind == StemKind::Trunk);
        trunks.next().is_some() && trunks.next().is_none()
    }

    /// The tree of the last evaluation.
    #[must_use]
    pub const fn tree(&self) -> &Tree {
        &self.tree
    }
}
