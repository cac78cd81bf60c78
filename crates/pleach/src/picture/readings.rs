//! What is in a goal and in the trees of its fit, side by side.

use super::drawn::FittedTree;
use pleach_fit::{KindVerdict, Verdict};
use pleach_reading::{Difference, Reading};
use serde::Serialize;

/// What is in a goal and in the pictures of the trees that were found, read by the same code.
#[derive(Clone, Debug, Serialize)]
pub struct Readings {
    /// Of the goal.
    pub goal: Reading,
    /// Of the kind's own tree.
    pub kind: Reading,
    /// Of the goal's own tree, where there is one.
    pub individual: Option<Reading>,
    /// In what the kind's own tree differs from the goal, the largest difference first.
    pub differences: Vec<Difference>,
}

/// From this size of a difference on, a tree is only roughly of the goal's kind …
const ROUGHLY: f64 = 1.5;
/// … and from this one on, it is not.
const NOT_AT_ALL: f64 = 2.5;
/// The measures that a kind has: others are the single tree's.
const OF_A_KIND: [&str; 4] = ["feet", "trunk", "bare_height", "leaves"];

impl Readings {
    pub(super) fn new(goal: &Reading, kind: &FittedTree, individual: Option<&FittedTree>) -> Self {
        let goal = goal.clone();
        let kind = Reading::from_silhouette(&kind.silhouette);
        let individual = individual.map(|tree| Reading::from_silhouette(&tree.silhouette));
        let differences = goal.differences(&kind);
        Self { goal, kind, individual, differences }
    }

    /// `verdict`, no better than what the tree's measures allow: a clump of canes is not of the kind of a tree with one
    /// trunk, however alike their outlines are.
    pub(super) fn bound(&self, verdict: Verdict) -> Verdict {
        let of_kind = self.differences.iter().filter(|one| OF_A_KIND.contains(&one.measure));
        let largest = of_kind.map(|one| one.size).fold(0.0, f64::max);
        if largest >= NOT_AT_ALL {
            verdict.at_most(KindVerdict::NotOfItsKind)
        } else if largest >= ROUGHLY {
            verdict.at_most(KindVerdict::Roughly)
        } else {
            verdict
        }
    }
}
