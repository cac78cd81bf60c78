//! Of many candidates, those that a goal is compared with closely.

use super::shown::Shown;
use super::tries::Try;

/// Up to so many candidates are all compared closely.
const FEW: usize = 24;
/// Of more, so many of the nearest.
const NEAREST: usize = 16;
/// And so many of each family at least: a race is between families.
const OF_FAMILY: usize = 3;
/// Where the front drawings have chosen, so many are compared in the goals' own views, and one of each family.
pub(super) const FROM_ELSEWHERE: usize = 3;

/// The trees that are looked at: one of each candidate at first, and all seeds and variations of those
/// that are near the goal.
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
    /// Before anything is known of the goals that are `shown`.
    pub(super) fn at_first(shown: &Shown<'_>) -> Self {
        let count = shown.candidates.len();
        if count <= FEW { Self::All } else { Self::Of(vec![false; count]) }
    }

    /// The candidates of the least `costs`, some of each family.
    pub(super) fn nearest(shown: &Shown<'_>, costs: &[f64]) -> Self {
        Self::Of(marked(shown, costs, NEAREST, OF_FAMILY))
    }

    /// Fewer of them, and nothing of the others.
    pub(super) fn few(shown: &Shown<'_>, costs: &[f64]) -> Self {
        Self::Only(marked(shown, costs, FROM_ELSEWHERE, 1))
    }

    /// Whether `attempt` is looked at.
    pub(super) fn has(&self, attempt: &Try) -> bool {
        match self {
            Self::All => true,
            Self::Of(marked) => attempt.is_first || marked[attempt.candidate],
            Self::Only(marked) => marked[attempt.candidate],
        }
    }
}

/// The `most` candidates of the least `costs`, and the best `of_family` of each family.
fn marked(shown: &Shown<'_>, costs: &[f64], most: usize, of_family: usize) -> Vec<bool> {
    let mut order: Vec<usize> = (0..costs.len()).collect();
    order.sort_by(|&a, &b| costs[a].total_cmp(&costs[b]));
    let mut marked = vec![false; costs.len()];
    let mut families: Vec<(&str, usize)> = Vec::new();
    for (place, candidate) in order.into_iter().enumerate() {
        let family = shown.family(candidate);
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
