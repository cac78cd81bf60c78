//! Which numbers can matter to a tree.

use super::table::{ACTIVE, Level, Model};
use crate::solid::Surroundings;
use pleach_tree::param::SlotInfo;

/// What the activity of a number depends on: the other numbers, and which of its parameter's it is.
#[derive(Debug)]
pub(crate) struct Facts {
    pub(super) model: Model,
    /// Whether solids stand for the pruning envelope.
    has_solids: bool,
    pub(super) index: usize,
}

/// Whether the number at `slot` can change a tree of `model`.
pub(crate) fn is_active(model: Model, surroundings: &Surroundings, slot: SlotInfo) -> bool {
    ACTIVE[slot.param](&Facts { model, has_solids: surroundings.inside.is_some(), index: slot.index })
}

pub(super) const fn always(_: &Facts) -> bool {
    true
}

impl Facts {
    fn level(&self) -> &Level {
        &self.model.levels[self.index]
    }

    /// Whether the tree has more than trunks.
    pub(super) const fn has_branches(&self) -> bool {
        self.model.level_count > 1
    }

    /// Whether there are stems of this level.
    pub(super) const fn has_stems(&self) -> bool {
        self.index < self.model.level_count
    }

    /// Whether there are stems of this level, and they are not helices.
    pub(super) fn has_curved_stems(&self) -> bool {
        self.has_stems() && !self.level().is_helix()
    }

    /// Whether the stems of this level fork.
    pub(super) fn forks(&self) -> bool {
        self.level().seg_splits > 0.0 || (self.index == 0 && self.model.base_splits != 0)
    }

    pub(super) fn has_leaves(&self) -> bool {
        self.has_branches() && self.model.leaf_blos_num != 0.0
    }

    /// Whether stems or leaves are placed by the numbers of this level. Leaves use the level after
    /// the deepest, at most the last.
    pub(super) fn places_children(&self) -> bool {
        let places_leaves = self.has_leaves() && self.index == self.model.level_count.min(3);
        self.index > 0 && (self.has_stems() || places_leaves)
    }

    /// Whether this level places leaves alone, as fans.
    pub(super) fn is_leaf_fan(&self) -> bool {
        !self.has_stems() && self.model.leaf_blos_num < 0.0
    }

    pub(super) fn prunes_by_envelope(&self) -> bool {
        self.model.prune_ratio > 0.0 && !self.has_solids
    }

    /// Whether the envelope shapes anything: what is pruned, or the crown.
    pub(super) fn has_envelope(&self) -> bool {
        self.prunes_by_envelope() || (self.model.shape == 8 && self.has_branches())
    }
}
