//! Which numbers of a problem are free.

use pleach_tree::ParamSpace;
use pleach_tree::param::Problem;
use serde::{Deserialize, Serialize};

/// Which slots are free, by the patterns of [`ParamSpace::select`]: a slot (`length[1]`), a
/// parameter (`length`), a group (`leaves`), or `level:N`.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Freedom {
    /// Only these are free. All are if the list is empty, but for [opt-in](pleach_tree::Param::opt_in) ones that the
    /// start has at their defaults.
    pub free: Vec<String>,
    /// These keep the value of the start, whatever `free` says.
    pub fix: Vec<String>,
}

/// Which tree is grown from the parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum TreeSeed {
    /// The same for every individual, as in the dissertation (§3.3.2).
    Fixed(u64),
    /// Part of the genome: searched like the parameters.
    Any,
}

/// The reason why there is no search space.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SpaceError {
    /// A pattern that names no parameter.
    #[error("`{pattern}` {problem}")]
    Pattern {
        /// As it was given.
        pattern: String,
        /// The problem.
        problem: Problem,
    },
    /// Every slot is fixed, and the tree's seed too.
    #[error("no parameter is free: nothing to search")]
    NothingFree,
    /// A start whose values do not belong to this generator.
    #[error("start values: {0}")]
    Start(#[from] pleach_tree::param::SlotError),
}

/// Checks that every pattern of `freedom` names parameters of `params`, and that something is left to search.
///
/// # Errors
/// The first pattern that names none, or [`SpaceError::NothingFree`]: the errors of [`crate::fit`], before a first
/// guess.
pub fn check_freedom(params: &ParamSpace, freedom: &Freedom, tree_seed: TreeSeed) -> Result<(), SpaceError> {
    let is_any_free = free_slots(params, freedom)?.contains(&true);
    if is_any_free || tree_seed == TreeSeed::Any { Ok(()) } else { Err(SpaceError::NothingFree) }
}

/// Whether `freedom` lets all numbers change that differ between `from` and `to`, opt-in ones included.
///
/// # Errors
/// As [`check_freedom`], but for nothing being free.
pub(crate) fn may_change(
    params: &ParamSpace,
    freedom: &Freedom,
    from: &[f64],
    to: &[f64],
) -> Result<bool, SpaceError> {
    let is_free = free_slots(params, freedom)?;
    Ok(from.iter().zip(to).zip(is_free).all(|((from, to), is_free)| is_free || from == to))
}

/// For each slot whether it is free.
pub(super) fn free_slots(params: &ParamSpace, freedom: &Freedom) -> Result<Vec<bool>, SpaceError> {
    let mut is_free = vec![freedom.free.is_empty(); params.len()];
    for (patterns, value) in [(&freedom.free, true), (&freedom.fix, false)] {
        for pattern in patterns {
            let slots = params
                .select(pattern)
                .map_err(|problem| SpaceError::Pattern { pattern: pattern.clone(), problem })?;
            for slot in slots {
                is_free[slot.index()] = value;
            }
        }
    }
    Ok(is_free)
}
