//! What is in a goal and in the trees of its fit, side by side.

use super::drawn::FittedTree;
use super::goal_reading::GoalReading;
use pleach_fit::{KindVerdict, Verdict};
use pleach_reading::{Difference, Measure, Reading};
use serde::Serialize;

/// What is in a goal and in the pictures of the trees that were found, read by the same code.
#[derive(Clone, Debug, Serialize)]
pub struct Readings {
    /// Of the goal.
    pub goal: GoalReading,
    /// Of the kind's own tree.
    pub kind: Reading,
    /// Of the goal's own tree, where there is one.
    pub individual: Option<Reading>,
    /// How far the kind's own tree stands from the goal by these measures, in 0..=1: see [`Reading::distance`].
    pub distance: f64,
    /// In what the kind's own tree differs from the goal, the largest difference first.
    pub differences: Vec<Difference>,
}

/// From this size of a difference on, a tree is only roughly of the goal's kind …
const ROUGHLY: f64 = 1.5;
/// … and from this one on, it is not.
const NOT_AT_ALL: f64 = 2.5;
impl Readings {
    pub(super) fn new(goal: &GoalReading, kind: &FittedTree, individual: Option<&FittedTree>) -> Self {
        let goal = goal.clone();
        let trunks = kind.species.generator.trunks(kind.species.params.values());
        let kind = kind.measures.clone();
        let individual = individual.map(|tree| tree.measures.clone());
        let differences = goal.measures.differences_from(&kind, trunks);
        let distance = goal.measures.distance(&kind, trunks);
        Self { goal, kind, individual, distance, differences }
    }

    /// `verdict` on a picture in colour whose trees cost `fresh` in the mean, and its own tree `own`: by their distance
    /// from the picture, but never of its kind where trunks or leaves contradict it.
    pub(super) fn judge_colored(&self, verdict: Verdict, fresh: f64, own: f64) -> Verdict {
        let verdict = verdict.with_distance(fresh + self.distance, own + self.distance);
        self.at_most(verdict, |measure| matches!(measure, Measure::Feet | Measure::Leaves))
    }

    /// `verdict` on a silhouette, no better than what the tree's measures allow: a clump of canes is not of the kind of a tree with one
    /// trunk, and a curtain of hanging twigs not of that of an open crown, however alike their outlines are.
    pub(super) fn bound(&self, verdict: Verdict) -> Verdict {
        self.at_most(verdict, Measure::is_of_kind)
    }

    /// `verdict`, no better than what the differences in those measures that count allow.
    fn at_most(&self, verdict: Verdict, counts: impl Fn(Measure) -> bool) -> Verdict {
        let counts = |one: &&Difference| counts(one.measure);
        let largest = self.differences.iter().filter(counts).map(|one| one.size).fold(0.0, f64::max);
        if largest >= NOT_AT_ALL {
            verdict.at_most(KindVerdict::NotOfItsKind)
        } else if largest >= ROUGHLY {
            verdict.at_most(KindVerdict::Roughly)
        } else {
            verdict
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_verdict_is_no_better_than_the_measures_of_a_species_allow() {
        let best = Verdict {
            kind: KindVerdict::OfItsKind,
            tree: KindVerdict::OfItsKind,
            share: 0.9,
            distance: None,
            off: None,
        };
        let readings = |differences: &[(Measure, f64)]| {
            let one = |&(measure, size): &(Measure, f64)| Difference {
                measure,
                size,
                confidence: 0.9,
                words: String::new(),
            };
            let reading = Reading::default();
            let goal = GoalReading::new(reading.clone(), None, None, Vec::new());
            let differences = differences.iter().map(one).collect();
            Readings { goal, kind: reading, individual: None, distance: 0.1, differences }
        };
        let bound = |differences: &[(Measure, f64)]| readings(differences).bound(best).kind;
        assert_eq!(bound(&[]), KindVerdict::OfItsKind);
        assert_eq!(bound(&[(Measure::Feet, 1.4)]), KindVerdict::OfItsKind);
        assert_eq!(bound(&[(Measure::Width, 1.5)]), KindVerdict::Roughly);
        assert_eq!(bound(&[(Measure::Lean, 9.0), (Measure::BareHeight, 1.6)]), KindVerdict::Roughly);
        assert_eq!(bound(&[(Measure::Feet, 2.5)]), KindVerdict::NotOfItsKind);
        assert_eq!(bound(&[(Measure::Leaves, 3.0)]), KindVerdict::NotOfItsKind);
        assert_eq!(bound(&[(Measure::Grain, 2.6)]), KindVerdict::NotOfItsKind);
        assert_eq!(bound(&[(Measure::Crown, 1.6)]), KindVerdict::Roughly);
        // How a single tree leans, forks or is heavier on one side is not of its species.
        assert_eq!(bound(&[(Measure::Lean, 9.0), (Measure::FirstFork, 4.0)]), KindVerdict::OfItsKind);
        // Of a picture in colour the distance decides, and trunks and leaves are a veto.
        let colored =
            |differences: &[(Measure, f64)], cost| readings(differences).judge_colored(best, cost, 0.2).kind;
        assert_eq!(colored(&[], 0.3), KindVerdict::OfItsKind);
        assert_eq!(colored(&[], 0.4), KindVerdict::Roughly);
        assert_eq!(colored(&[], 0.7), KindVerdict::NoMoreThanAnother);
        assert_eq!(colored(&[(Measure::Grain, 2.6)], 0.3), KindVerdict::OfItsKind);
        assert_eq!(colored(&[(Measure::Feet, 2.6)], 0.3), KindVerdict::NotOfItsKind);
        assert_eq!(colored(&[(Measure::Leaves, 1.6)], 0.3), KindVerdict::Roughly);
        // What is bad already stays.
        let bad = Verdict { kind: KindVerdict::NoMoreThanAnother, ..best };
        assert_eq!(bad.at_most(KindVerdict::Roughly).kind, KindVerdict::NoMoreThanAnother);
    }
}
