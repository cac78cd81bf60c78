//! How many stems and leaves a tree has for certain, by its numbers alone.
//!
//! A lower bound: trees that are certain to be too large are refused before anything grows, and no others.
//! It counts children on the lower parts of stems that cannot fork, be pruned or run out of
//! thickness; where it knows nothing it says zero.

use crate::blame;
use crate::crown;
use crate::model::{Level, Model};
use pleach_tree::{Blame, Foliage, GrowError, Growth};

/// Children of a stem of each level are counted up to this part of it: beyond, the thinnest cone may
/// be too thin for any.
const COUNTED_PART: [f64; 3] = [0.9, 0.8, 0.5];
/// Places that rounding at segments and at the two ends may cost.
const ROUNDING: f64 = 8.0;
/// Twice the radius and the length below which a stem bears or is nothing, in metres.
const SAFE_SIZE: f64 = 2e-4;
/// Branches have at least this radius in metres, unless their parent is thinner.
const BRANCH_RADIUS: f64 = 0.005;

/// The least numbers of stems of each level, and of leaves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Certain {
    pub(crate) stems: [f64; 4],
    pub(crate) leaves: f64,
}

/// The error of a tree that is certain to be too large.
pub(crate) fn refusal(model: &Model, growth: &Growth<'_>) -> Option<GrowError> {
    // A hull may leave nothing of a tree.
    if growth.hull().is_some() {
        return None;
    }
    let certain = Certain::new(model);
    let limits = growth.limits;
    let deepest = model.level_count - 1;
    if certain.stems.iter().sum::<f64>() > limits.stems as f64 {
        let most = (0..=deepest).max_by(|&a, &b| certain.stems[a].total_cmp(&certain.stems[b]));
        let blame = Blame(blame::counts(model, most.unwrap_or(0)));
        return Some(GrowError::TooManyStems { limit: limits.stems, blame });
    }
    if growth.foliage == Foliage::All && certain.leaves > limits.leaves as f64 {
        return Some(GrowError::TooManyLeaves { limit: limits.leaves, blame: blame::leaves(model) });
    }
    None
}

impl Certain {
    pub(crate) fn new(model: &Model) -> Self {
        let mut certain = Self::default();
        if model.prune_ratio > 0.0 {
            return certain;
        }
        let scale = (model.g_scale - model.g_scale_v).max(model.g_scale * 1e-3);
        let trunk = &model.levels[0];
        let mut length = scale * (trunk.length - trunk.length_v).max(0.0);
        let mut radius = length * model.ratio * trunk.radius_mod;
        if length < SAFE_SIZE {
            return certain;
        }
        certain.stems[0] = f64::from(model.trunks());
        // Length of a stem over the greatest of its siblings', at least.
        let mut relative = 1.0;
        for (depth, &counted) in COUNTED_PART.iter().enumerate().take(model.level_count - 1) {
            let (level, next) = (&model.levels[depth], model.child_level(depth));
            let forks = level.seg_splits > 0.0 && !level.is_helix();
            radius *= 1.0 - level.taper * counted;
            if forks || level.taper > 1.0 || radius < SAFE_SIZE {
                return certain;
            }
            let children = match depth {
                0 => 0.9 * next.branches,
                1 => next.branches * (0.2 + 0.8 * relative),
                _ => 0.5 * next.branches,
            };
            let children = if next.branches < 0.0 {
                next.branches
            } else {
                children / (1.0 - level.base_size) * (counted - level.base_size)
            };
            relative = if depth == 0 { least_shape_ratio(model.shape) * crown::least(model) } else { 0.3 };
            length *= (next.length - next.length_v).max(0.0) * relative;
            radius = radius.min(BRANCH_RADIUS);
            if length < SAFE_SIZE {
                return certain;
            }
            certain.stems[depth + 1] = certain.stems[depth] * sites(children, level, next);
        }
        let deepest = model.level_count - 1;
        if deepest > 0 {
            let (level, next) = (&model.levels[deepest], model.child_level(deepest));
            let count = model.leaf_blos_num * scale / model.g_scale * relative;
            let count = if count < 0.0 { count } else { count * (1.0 - level.base_size) };
            certain.leaves = certain.stems[deepest] * sites(count, level, next);
        }
        certain
    }
}

/// Places that are left of `count` after all rounding; a negative count is a fan.
fn sites(count: f64, level: &Level, next: &Level) -> f64 {
    if count < 0.0 {
        return (-count * (1.0 - 1e-9)).floor();
    }
    let whorls =
        if next.branch_dist > 1.0 { f64::from(level.curve_res + 1) * (next.branch_dist + 3.0) } else { 0.0 };
    (count - ROUNDING - whorls).floor().max(0.0)
}

/// The least relative length of a first-level branch; 0 for shapes that come to a point.
const fn least_shape_ratio(shape: i64) -> f64 {
    match shape {
        3 => 1.0,
        4 | 7 => 0.5,
        5 | 8 => 0.0,
        _ => 0.2,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::space;
    use crate::params::table::Id;
    use pleach_tree::param::table::Parameters;
    use pleach_tree::{Key, Limits, Species};

    fn species() -> Species {
        crate::preset("lombardy_poplar").unwrap()
    }

    /// Values with some numbers of the search's and the declared ranges, small enough to grow.
    fn values(case: u64) -> Vec<f64> {
        let key = Key::root(case);
        let space = space();
        let mut values =
            if case.is_multiple_of(2) { species().params.values().to_vec() } else { space.defaults() };
        for (slot, value) in space.slots().zip(values.iter_mut()) {
            let (id, kind, number) =
                (Id::ALL[space.info(slot).param], space.kind_of(slot), slot.index() as u32);
            let often = matches!(id, Id::branches | Id::taper | Id::base_size | Id::branch_dist | Id::shape);
            if key.unit(0, number) > if often { 0.5 } else { 0.1 } {
                continue;
            }
            let (low, high) = match id {
                Id::branches => (-30.0, 60.0),
                Id::leaf_blos_num => (-50.0, 300.0),
                Id::floor_splits => (0.0, 5.0),
                Id::prune_ratio => (0.0, 0.0),
                Id::curve_res => (1.0, 12.0),
                _ if kind.is_choice() => kind.range(),
                _ => space.search_range(slot),
            };
            *value = kind.repair(low + (high - low) * key.unit(1, number));
        }
        values
    }

    #[test]
    fn no_tree_has_fewer_than_is_certain() {
        let (mut grown, mut said) = (0, 0);
        for case in 0..80 {
            let values = values(case);
            let certain = Certain::new(&Model::read(&values));
            let params = space().check(values).unwrap();
            // Bounded by work, of which the numbers say nothing.
            let limits = Limits { work: 600_000, ..Limits::default() };
            let growth = Growth { limits, ..Growth::seed(case) };
            let Ok(tree) = Species { params, ..species() }.grow_with(&growth) else { continue };
            grown += 1;
            let mut stems = [0.0; 4];
            tree.stems.iter().for_each(|stem| stems[usize::from(stem.level)] += 1.0);
            for (level, (least, has)) in certain.stems.iter().zip(stems).enumerate() {
                assert!(*least <= has, "case {case}: {has} stems of level {level}, {least} were certain");
                said += usize::from(level > 0 && *least > 0.0);
            }
            let leaves = (tree.leaves.len() + tree.blossoms.len()) as f64;
            assert!(certain.leaves <= leaves, "case {case}: {leaves} leaves, {} certain", certain.leaves);
            said += usize::from(certain.leaves > 0.0);
        }
        assert!(grown > 30 && said > 15, "{grown} trees grew, {said} bounds were above zero");
    }

    #[test]
    fn monsters_are_seen_by_their_numbers() {
        let mut values = species().params.values().to_vec();
        let first = Id::branches.slot(0).index();
        assert!(refusal(&Model::read(&values), &Growth::seed(1)).is_none());
        values[first] = 10_000.0;
        let told = refusal(&Model::read(&values), &Growth::seed(1)).unwrap().to_string();
        assert!(told.contains("stems") && told.contains("`branches[0]`"), "{told}");
        values[Id::level_count.slot(0).index()] = 4.0;
        values[Id::length.slot(3).index()] = 0.5;
        values[first..first + 4].copy_from_slice(&[1.0, 1000.0, 1000.0, 1000.0]);
        let told = refusal(&Model::read(&values), &Growth::seed(1)).unwrap().to_string();
        assert!(told.contains("because of `branches[3]`, `branches[2]` and `branches[1]`"), "{told}");
    }
}
