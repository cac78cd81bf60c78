//! Measured trees as species of one tree each.

use pleach_tree::{
    Appearance, Blame, CheckedParams, Foliage, Generator, GrowError, Growth, ParamSpace, Species, Tree,
    Workspace,
};
use std::sync::{Arc, LazyLock};

/// What the family of measured trees is called. No species file can name it: the tree is in a file of its own.
const FAMILY: &str = "measured";

/// A measured tree has no numbers.
static SPACE: LazyLock<Arc<ParamSpace>> =
    LazyLock::new(|| Arc::new(ParamSpace::new(Vec::new()).expect("no declaration contradicts another")));

/// Grows the same tree from every seed: one that was measured.
#[derive(Debug)]
struct Measured {
    tree: Tree,
}

impl Generator for Measured {
    fn family(&self) -> &'static str {
        FAMILY
    }

    fn space(&self) -> &Arc<ParamSpace> {
        &SPACE
    }

    fn grow(
        &self,
        params: &CheckedParams,
        growth: &Growth<'_>,
        _: &mut Workspace,
        tree: &mut Tree,
    ) -> Result<(), GrowError> {
        params.values_in(&SPACE)?;
        let (limits, blame) = (&growth.limits, Blame::default());
        if self.tree.stems.len() > limits.stems {
            return Err(GrowError::TooManyStems { limit: limits.stems, blame });
        }
        if self.tree.knots.len() > limits.knots {
            return Err(GrowError::TooManyKnots { limit: limits.knots, blame });
        }
        tree.clear();
        tree.stems.extend_from_slice(&self.tree.stems);
        tree.knots.extend_from_slice(&self.tree.knots);
        Ok(())
    }

    /// The hash of the tree, which tells it from others; the tree itself is not a part of a species file.
    fn structure(&self) -> String {
        format!("tree = \"{:016x}\"\n", self.tree.digest())
    }
}

/// The species whose only tree is `tree`, of stems alone.
pub(crate) fn species(tree: Tree) -> Species {
    let params = SPACE.check(Vec::new()).expect("no number is out of range");
    Species {
        name: String::new(),
        description: "a measured tree".to_owned(),
        generator: Arc::new(Measured { tree }),
        params,
        tree_seed: None,
        foliage: Foliage::None,
        appearance: Appearance::default(),
    }
}
