//! Which of many candidates a goal is compared with closely.

use super::goal_context::GoalContext;
use super::samples::Sample;

/// Up to this many candidates, all are compared closely.
const FEW: usize = 24;
/// With more, this many of the nearest.
const NEAREST: usize = 16;
/// At least this many of each family, and an equal part of [`NEAREST`]: a race is between families, and the nearest
/// species of one whose trees are farther away at first may win it.
const OF_FAMILY: usize = 3;
/// Where front drawings choose, this many are compared in the goals' own views, and one of each family.
pub(super) const FROM_ELSEWHERE: usize = 3;

/// Which trees are compared: one of each candidate at first, and all seeds and variations of those that are near the
/// goal.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Near {
    /// All trees of all candidates.
    All,
    /// The first tree of every candidate, and all of those that are marked.
    Of(Vec<bool>),
    /// All trees of the candidates that are marked, and of no others.
    Only(Vec<bool>),
}

impl Near {
    /// Before any comparison.
    pub(super) fn at_first(context: &GoalContext<'_>) -> Self {
        let count = context.candidates.len();
        if count <= FEW { Self::All } else { Self::Of(vec![false; count]) }
    }

    /// The candidates of the least `costs`, some of each family.
    pub(super) fn nearest(context: &GoalContext<'_>, costs: &[f64]) -> Self {
        let mut families: Vec<&str> = (0..costs.len()).map(|candidate| context.family(candidate)).collect();
        families.sort_unstable();
        families.dedup();
        let of_family = OF_FAMILY.max(NEAREST / families.len().max(1));
        Self::Of(marked(context, costs, NEAREST, of_family))
    }

    /// Fewer of them, and no tree of the others.
    pub(super) fn few(context: &GoalContext<'_>, costs: &[f64]) -> Self {
        Self::Only(marked(context, costs, FROM_ELSEWHERE, 1))
    }

    /// Whether `sample` is compared.
    pub(super) fn has(&self, sample: &Sample) -> bool {
        match self {
            Self::All => true,
            Self::Of(marked) => sample.is_first || marked[sample.candidate],
            Self::Only(marked) => marked[sample.candidate],
        }
    }
}

/// The `most` candidates of the least `costs`, and the best `of_family` of each family.
fn marked(context: &GoalContext<'_>, costs: &[f64], most: usize, of_family: usize) -> Vec<bool> {
    let mut order: Vec<usize> = (0..costs.len()).collect();
    order.sort_by(|&a, &b| costs[a].total_cmp(&costs[b]));
    let mut marked = vec![false; costs.len()];
    let mut families: Vec<(&str, usize)> = Vec::new();
    for (place, candidate) in order.into_iter().enumerate() {
        let family = context.family(candidate);
        let known = families.iter().position(|(name, _)| *name == family).unwrap_or_else(|| {
            families.push((family, 0));
            families.len() - 1
        });
        let count = &mut families[known].1;
        marked[candidate] = place < most || *count < of_family;
        *count += 1;
    }
    marked
}
