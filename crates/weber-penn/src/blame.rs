//! Which parameters are to blame for a tree that is too large.

use crate::budget::{Budget, Cause, Exceeded};
use crate::model::Model;
use crate::params::table::Id;
use crate::stem::StemSpec;
use pleach_tree::{Blame, Conflict, GrowError, StemKind, Tree};

/// The error of a tree that passed a limit, of which `tree` and `waiting` stems had been made.
pub(crate) fn error(
    exceeded: Exceeded,
    model: &Model,
    budget: &Budget<'_>,
    tree: &Tree,
    waiting: &[StemSpec],
) -> GrowError {
    let limits = budget.limits();
    match exceeded {
        Exceeded::Stems => {
            GrowError::TooManyStems { limit: limits.stems, blame: stems(model, tree, waiting) }
        }
        Exceeded::Leaves => GrowError::TooManyLeaves { limit: limits.leaves, blame: leaves(model) },
        Exceeded::Knots => GrowError::TooManyKnots { limit: limits.knots, blame: knots(model, tree) },
        Exceeded::Work => GrowError::TooMuchWork { limit: limits.work, blame: work(model, budget) },
        Exceeded::Waiting => GrowError::TooManyWaiting { blame: stems(model, tree, waiting) },
    }
}

/// What the number of stems of level `level` follows from, most of all first.
pub(crate) fn counts(model: &Model, level: usize) -> Vec<String> {
    let crowded = |&level: &usize| count(model, level) >= 10.0;
    let shallower = (0..level).rev().filter(crowded);
    std::iter::once(level).chain(shallower).map(|level| count_name(model, level)).collect()
}

fn count(model: &Model, level: usize) -> f64 {
    if level == 0 { f64::from(model.trunks()) } else { model.levels[level].branches.abs() }
}

fn count_name(model: &Model, level: usize) -> String {
    if level == 0 && model.floor_splits > 0 {
        Id::floor_splits.slot_name(0)
    } else {
        Id::branches.slot_name(level)
    }
}

pub(crate) fn leaves(model: &Model) -> Blame {
    let stems = counts(model, model.level_count - 1).into_iter().filter(|_| model.level_count > 1);
    Blame(std::iter::once(Id::leaf_blos_num.slot_name(0)).chain(stems).collect())
}

fn stems(model: &Model, tree: &Tree, waiting: &[StemSpec]) -> Blame {
    let (mut stems, mut forked_stems) = ([0_usize; 4], [0_usize; 4]);
    for stem in &tree.stems {
        let level = usize::from(stem.level);
        stems[level] += 1;
        forked_stems[level] += usize::from(stem.kind == StemKind::Fork);
    }
    waiting.iter().for_each(|stem| stems[stem.level] += 1);
    let level = most(&stems);
    let mut names = counts(model, level);
    if 2 * forked_stems[level] > stems[level] {
        names.insert(0, Id::seg_splits.slot_name(level));
    }
    Blame(names)
}

fn knots(model: &Model, tree: &Tree) -> Blame {
    let mut knots = [0_usize; 4];
    for stem in &tree.stems {
        knots[usize::from(stem.level)] += stem.knot_count as usize;
    }
    let level = most(&knots);
    let first = if model.levels[level].taper > 1.0 { Id::taper } else { Id::curve_res };
    Blame(std::iter::once(first.slot_name(level)).chain(counts(model, level)).collect())
}

fn work(model: &Model, budget: &Budget<'_>) -> Blame {
    let (cause, level) = budget.most_work();
    let first = match cause {
        Cause::Darts => vec![],
        Cause::Walk => vec![Id::curve_res.slot_name(level)],
        Cause::Pruning => vec![Id::prune_ratio.slot_name(0), Id::curve_res.slot_name(level)],
        Cause::Children => {
            let next = (level + 1).min(3);
            vec![Id::branches.slot_name(next), Id::base_size.slot_name(level)]
        }
        Cause::Leaves => vec![Id::leaf_blos_num.slot_name(0), Id::base_size.slot_name(level)],
    };
    Blame(first.into_iter().chain(counts(model, level)).collect())
}

/// What leaves nothing of a tree: a trunk without length, or pruning.
pub(crate) fn nothing_left(model: &Model) -> Conflict {
    let trunk = &model.levels[0];
    let is_short = trunk.length - trunk.length_v <= 0.0;
    let prunes = model.prune_ratio > 0.0;
    let short = [Id::length, Id::length_v].into_iter().filter(|_| is_short);
    let pruned = [Id::prune_ratio].into_iter().filter(|_| prunes);
    Conflict::NothingLeft { blame: Blame(short.chain(pruned).map(|id| id.slot_name(0)).collect()) }
}

/// The deepest level that has the most.
fn most(counts: &[usize; 4]) -> usize {
    counts.iter().enumerate().max_by_key(|(_, count)| **count).map_or(0, |(level, _)| level)
}
