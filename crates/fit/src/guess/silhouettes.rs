//! The silhouettes of a tree of the library, with leaves and without.

use crate::evaluator::FineSilhouette;
use pleach_tree::Foliage;
use serde::{Deserialize, Serialize};

/// The silhouettes of an entry's trees.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Silhouettes {
    /// Height of the first in metres.
    pub(super) height: f64,
    /// Whether any of them has leaves or blobs of foliage.
    pub(super) has_foliage: bool,
    /// Seed by seed, and of each view by view.
    pub(super) views: Vec<FineSilhouette>,
}

/// With leaves, then without; `None` where they were not asked for.
pub(super) type BothSilhouettes = [Option<Silhouettes>; 2];

/// Index into [`BothSilhouettes`].
pub(super) fn index_of(foliage: Foliage) -> usize {
    usize::from(foliage == Foliage::None)
}
