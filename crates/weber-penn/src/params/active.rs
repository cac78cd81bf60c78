//! Which numbers can matter to a tree.

use super::table::{Level, Model};
use crate::solid::Surroundings;
use pleach_tree::Slot;
use pleach_tree::param::table::Parameters;

/// What decides whether a number matters: the other numbers, and its index within its parameter.
#[derive(Debug)]
pub(crate) struct Facts {
    pub(super) model: Model,
    /// Whether solids stand for the pruning envelope.
    has_solids: bool,
    pub(super) index: usize,
}

/// Whether the number in `slot` can change a tree of `model`.
pub(crate) fn is_active(model: Model, surroundings: &Surroundings, slot: Slot) -> bool {
    let index = Model::space().info(slot).index;
    Model::is_active(slot, &Facts { model, has_solids: surroundings.inside.is_some(), index })
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

#[cfg(test)]
mod tests {
    use super::super::HEIGHTS;
    use super::super::table::Id;
    use super::*;

    /// A tree that has everything, with changes.
    fn whole(set: &[(Id, usize, f64)]) -> Model {
        let mut values = Model::space().defaults();
        let whole = [(Id::level_count, 0, 4.0), (Id::blossom_rate, 0, 0.5), (Id::prune_ratio, 0, 0.5)];
        let forks = (0..4).map(|level| (Id::seg_splits, level, 0.1));
        for (id, index, value) in whole.into_iter().chain(forks).chain(set.iter().copied()) {
            values[id.slot(index).index()] = value;
        }
        Model::read(&values)
    }

    fn inactive(set: &[(Id, usize, f64)], has_solids: bool) -> Vec<String> {
        let (space, model) = (Model::space(), whole(set));
        let is_active = |slot: &Slot| {
            Model::is_active(*slot, &Facts { model, has_solids, index: space.info(*slot).index })
        };
        space.slots().filter(|slot| !is_active(slot)).map(|slot| space.slot_name(slot)).collect()
    }

    /// What does not matter because of what `set` changes, in order.
    fn without(set: &[(Id, usize, f64)]) -> Vec<String> {
        let mut names = inactive(set, false);
        let before = inactive(&[], false);
        names.retain(|name| !before.contains(name));
        names
    }

    fn names(ids: &[Id], index: usize) -> Vec<String> {
        ids.iter().map(|id| id.slot_name(index)).collect()
    }

    const PLACES_CHILDREN: [Id; 5] =
        [Id::down_angle, Id::down_angle_v, Id::rotate, Id::rotate_v, Id::branch_dist];
    const OF_CURVED_STEMS: [Id; 6] =
        [Id::seg_splits, Id::split_angle, Id::split_angle_v, Id::curve, Id::curve_back, Id::bend_v];
    const OF_LEAVES: [Id; 3] = [Id::leaf_shape, Id::leaf_scale, Id::leaf_scale_x];
    const OF_BLOSSOMS: [Id; 2] = [Id::blossom_shape, Id::blossom_scale];

    #[test]
    fn a_tree_that_has_everything_has_all_parameters() {
        // Trunks stand on the ground: nothing places them along a parent.
        assert_eq!(inactive(&[], false), names(&PLACES_CHILDREN, 0));
    }

    #[test]
    fn levels_that_are_not_there_have_no_numbers() {
        let space = Model::space();
        let of_levels = |range: std::ops::RangeFrom<usize>| -> Vec<String> {
            let is_level = |slot: &Slot| {
                let shape = &space.param_of(*slot).shape;
                let by_level =
                    matches!(shape, pleach_tree::param::Shape::List { index, .. } if index == "level");
                by_level && range.contains(&space.info(*slot).index)
            };
            space.slots().filter(is_level).map(|slot| space.slot_name(slot)).collect()
        };
        let sorted = |mut names: Vec<String>| {
            names.sort();
            names
        };
        let of_foliage =
            [names(&OF_LEAVES, 0), names(&OF_BLOSSOMS, 0), names(&[Id::leaf_bend, Id::blossom_rate], 0)];
        let of_branches = [
            names(&[Id::shape, Id::ratio_power, Id::leaf_blos_num, Id::side, Id::crown_depth], 0),
            (0..HEIGHTS).map(|place| Id::outline.slot_name(place)).collect(),
        ]
        .concat();
        let of_trunk_alone =
            [of_foliage.concat(), of_branches, names(&[Id::tropism], 2), of_levels(1..)].concat();
        assert_eq!(sorted(without(&[(Id::level_count, 0, 1.0)])), sorted(of_trunk_alone));

        // Leaves on the deepest stems are placed by the level after it.
        let mut of_twigs = of_levels(2..);
        of_twigs.retain(|name| !names(&PLACES_CHILDREN, 2).contains(name));
        of_twigs.push("tropism.z".to_owned());
        assert_eq!(without(&[(Id::level_count, 0, 2.0)]), of_twigs);
        let fan = without(&[(Id::level_count, 0, 2.0), (Id::leaf_blos_num, 0, -40.0)]);
        let added: Vec<&String> = fan.iter().filter(|name| !of_twigs.contains(name)).collect();
        assert_eq!(added, ["branch_dist[2]"], "a fan has no places along its stem");
    }

    #[test]
    fn what_is_not_there_has_no_parameters() {
        let of_foliage = [
            names(&OF_LEAVES, 0),
            names(&[Id::leaf_bend], 0),
            names(&OF_BLOSSOMS, 0),
            names(&[Id::blossom_rate], 0),
        ];
        assert_eq!(without(&[(Id::leaf_blos_num, 0, 0.0)]), of_foliage.concat());
        assert_eq!(without(&[(Id::blossom_rate, 0, 1.0)]), names(&OF_LEAVES, 0));
        assert_eq!(without(&[(Id::blossom_rate, 0, 0.0)]), names(&OF_BLOSSOMS, 0));

        assert_eq!(without(&[(Id::curve_v, 1, -1.0)]), names(&OF_CURVED_STEMS, 1), "a helix");
        let of_trunk = [names(&[Id::base_splits], 0), names(&OF_CURVED_STEMS, 0)];
        assert_eq!(without(&[(Id::curve_v, 0, -1.0)]), of_trunk.concat(), "a trunk that is a helix");

        let angles = [Id::split_angle, Id::split_angle_v];
        assert_eq!(without(&[(Id::seg_splits, 1, 0.0)]), names(&angles, 1));
        assert_eq!(without(&[(Id::seg_splits, 0, 0.0)]), names(&angles, 0));
        let base_splits = (Id::base_splits, 0, 1.0);
        assert_eq!(without(&[(Id::seg_splits, 0, 0.0), base_splits]), [""; 0]);
        assert_eq!(without(&[(Id::seg_splits, 1, 0.0), base_splits]), names(&angles, 1));
    }

    #[test]
    fn solids_take_the_envelopes_place() {
        let envelope = [Id::prune_width, Id::prune_width_peak, Id::prune_power_low, Id::prune_power_high];
        assert_eq!(without(&[(Id::prune_ratio, 0, 0.0)]), names(&envelope, 0));
        let solids = [names(&PLACES_CHILDREN, 0), names(&envelope, 0)];
        assert_eq!(inactive(&[], true), solids.concat());
        // The crown has the envelope's shape all the same, but for its width.
        let custom = [(Id::prune_ratio, 0, 0.0), (Id::shape, 0, 8.0)];
        assert_eq!(without(&custom), names(&[Id::prune_width], 0));
        let bare = without(&[custom[0], custom[1], (Id::level_count, 0, 1.0)]);
        assert!(names(&envelope, 0).iter().all(|name| bare.contains(name)), "{bare:?}");
    }
}
