//! The last bests of a search, and which of them is the best kind.
//!
//! A search sees one tree of each list of numbers, and what it gains near its end it gains in part because branches
//! of that tree happen to lie well: other seeds of the same numbers get worse again. So a few of its bests are kept,
//! and the result is the one of which other seeds are best as well (early stopping by validation; Prechelt 1998,
//! *Automatic early stopping using cross validation*).

use crate::cancellable::Until;
use crate::error::FitError;
use crate::evaluator::Evaluator;
use crate::genome::{Genome, Scored};
use crate::method::is_individual;
use crate::objective::Objective;
use crate::problem::FitProblem;
use crate::space::SearchSpace;
use pleach_tree::Limits;
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// Bests that are kept beside the last one.
const MOST: usize = 7;
/// The cost of each of them is at most this part of the one before.
const STEP: f64 = 0.98;
/// Trees of other seeds that each is judged by, and as how many of them the one counts that the search has seen.
///
/// Over 24 goals (fourteen species of seed 11, ten of other programs), a thousand trees each, four seeds gained 0.005
/// of the likeness of sixteen more with that one counted twice, for 0.005 of its own; counted once 0.007 for 0.010;
/// eight times 0.002 for nothing. Who knew the best one beforehand would gain 0.012.
const SEEDS: u64 = 6;
const OWN: f64 = 2.0;
/// How far their seeds are from the fitted one: others than those that a result is reported by.
const FIRST: u64 = 2000;

/// Bests of a search that were replaced since, oldest first.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Finalists(VecDeque<Scored>);

impl Finalists {
    pub(crate) const fn new() -> Self {
        Self(VecDeque::new())
    }

    /// Takes a best that was replaced.
    pub(crate) fn add(&mut self, former: Scored) {
        let is_new = |last: &Scored| former.score.cost <= STEP * last.score.cost;
        if former.score.cost.is_finite() && self.0.back().is_none_or(is_new) {
            self.0.push_back(former);
            if self.0.len() > MOST {
                self.0.pop_front();
            }
        }
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = &Scored> {
        self.0.iter()
    }

    /// Whether they can be those of a search in `space`.
    pub(crate) fn suit(&self, space: &SearchSpace) -> bool {
        self.0.len() <= MOST && self.0.iter().all(|one| is_individual(&one.genome, space))
    }
}

/// Which of the `finalists` of a search for `problem` is the best kind. The last is the search's best, and the answer
/// where it is too late to find out.
///
/// # Errors
/// A problem that [`Evaluator::new`] refuses, or [`FitError::Interrupted`] once asked to stop.
pub(crate) fn best_kind(
    problem: &FitProblem,
    objective: Objective,
    finalists: &[Scored],
    until: Until<'_>,
) -> Result<usize, FitError> {
    let evaluator = Evaluator::new(problem, objective, Limits::default())?;
    let trees: Vec<Genome> = (0..SEEDS)
        .flat_map(|i| finalists.iter().map(move |one| (one, FIRST + i)))
        .map(|(one, far)| Genome { tree_seed: one.genome.tree_seed.wrapping_add(far), ..one.genome.clone() })
        .collect();
    let scores = until.map(&trees, |tree| evaluator.evaluate_with_likeness(tree))?;
    let cost_of = |one: usize| {
        let fresh = scores.chunks_exact(finalists.len()).map(|seed| seed[one].cost);
        fresh.fold(OWN * finalists[one].score.cost, |sum, cost| sum + cost)
    };
    let of_all = (0..finalists.len()).rev().min_by(|&a, &b| cost_of(a).total_cmp(&cost_of(b)));
    Ok(of_all.unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::genome::Score;
    use crate::problem::GoalView;
    use pleach_silhouette::{Frame, View, silhouette};
    use pleach_tree::Parts;
    use std::sync::atomic::AtomicBool;
    use std::time::Duration;

    fn scored(values: Vec<f64>, cost: f64) -> Scored {
        Scored { genome: Genome::new(values, 1), score: Score::from_cost(cost) }
    }

    #[test]
    fn a_few_are_kept_that_differ() {
        let mut kept = Finalists::new();
        let costs = |kept: &Finalists| kept.iter().map(|one| one.score.cost).collect::<Vec<_>>();
        for cost in [f64::INFINITY, 1.0, 0.99, 0.981, 0.98, 0.9, 0.89] {
            kept.add(scored(vec![cost], cost));
        }
        assert_eq!(costs(&kept), [1.0, 0.98, 0.9]);
        for cost in [0.8, 0.7, 0.6, 0.5, 0.4] {
            kept.add(scored(vec![cost], cost));
        }
        assert_eq!(costs(&kept), [0.98, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4]);
    }

    #[test]
    fn the_kind_is_the_one_whose_other_seeds_are_alike() {
        let [palm, poplar] = ["palm", "lombardy_poplar"].map(|name| pleach_generators::preset(name).unwrap());
        let tree = palm.grow(5).unwrap();
        let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 64, 64);
        let goal = GoalView::new(silhouette(&tree, View::FRONT, 64), View::FRONT, frame);
        let problem = FitProblem::new(palm.clone(), goal);
        let stop = AtomicBool::new(false);
        let best = |costs: [f64; 2], until| {
            let [palm, poplar] = [&palm, &poplar].map(|species| species.params.values().to_vec());
            let finalists = [scored(palm, costs[0]), scored(poplar, costs[1])];
            best_kind(&problem, Objective::Balance, &finalists, until).unwrap()
        };
        let until = Until::from(&stop);
        assert_eq!(best([0.3, 0.29], until), 0, "palms are like a palm");
        assert_eq!(best([3.0, 0.29], until), 1, "its own tree counts as well");
        let clock = || Duration::from_secs(9);
        let late = until.or_late(&clock, Some(Duration::from_secs(1)));
        assert_eq!(best([0.3, 0.29], late), 0, "one seed each is looked at whatever the time");
        stop.store(true, std::sync::atomic::Ordering::Relaxed);
        let finalists = [scored(palm.params.values().to_vec(), 0.3)];
        let asked = best_kind(&problem, Objective::Balance, &finalists, until);
        assert!(matches!(asked, Err(FitError::Interrupted)));
    }
}
