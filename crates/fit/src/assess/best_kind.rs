//! Validation of the former bests of a search on other seeds.
//!
//! A search sees one tree of each parameter list. Near its end it gains in part because branches of that tree happen
//! to lie well: other seeds of the same list get worse again. So a few former bests are kept, and the result is the
//! one whose other seeds are best as well (early stopping by validation; Prechelt 1998, *Automatic early stopping
//! using cross validation*).

use crate::control::Until;
use crate::error::FitError;
use crate::evaluator::Evaluator;
use crate::problem::FitProblem;
use crate::problem::Objective;
use crate::problem::{Genome, Scored};
use pleach_tree::Limits;

/// Trees of other seeds per finalist, and the weight of the one that the search has seen.
///
/// Over 24 goals (fourteen species of seed 11, ten of other programs), a thousand trees each, four seeds gained 0.005
/// of the likeness of sixteen more with that one counted twice, for 0.005 of its own; counted once 0.007 for 0.010;
/// eight times 0.002 for nothing. The best possible choice would gain 0.012.
///
/// Two seeds are looked at in a round, and after each the better half goes on: successive halving (Karnin, Koren and
/// Somekh 2013, *Almost optimal exploration in multi-armed bandits*) grows 28 trees for eight finalists in place of 48.
const ROUNDS: u64 = 3;
const SEEDS_PER_ROUND: u64 = 2;
const OWN: f64 = 2.0;
/// Offset of their seeds from the fitted one: different from those of [`crate::fresh_seeds`].
const FIRST: u64 = 2000;

/// Index of the best kind among the `finalists` of a search for `problem`. The last is the search's best, and the
/// answer if there is no time.
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
    let mut sums: Vec<f64> = finalists.iter().map(|one| OWN * one.score.cost).collect();
    let mut left: Vec<usize> = (0..finalists.len()).rev().collect();
    for round in 0..ROUNDS {
        let seeds = (0..SEEDS_PER_ROUND).map(|seed| FIRST + SEEDS_PER_ROUND * round + seed);
        let trees: Vec<Genome> = seeds
            .flat_map(|far| left.iter().map(move |&one| (&finalists[one].genome, far)))
            .map(|(genome, far)| Genome { tree_seed: genome.tree_seed.wrapping_add(far), ..genome.clone() })
            .collect();
        let scores = until.map(&trees, |tree| evaluator.score(tree))?;
        // A seed of which some are missing says nothing.
        for seed in scores.chunks_exact(left.len()) {
            left.iter().zip(seed).for_each(|(&one, score)| sums[one] += score.cost);
        }
        left.sort_by(|&a, &b| sums[a].total_cmp(&sums[b]));
        if scores.len() < trees.len() {
            break;
        }
        left.truncate(left.len().div_ceil(2));
    }
    Ok(left.first().copied().unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::GoalView;
    use crate::problem::Score;
    use pleach_silhouette::{Frame, View, silhouette};
    use pleach_tree::Parts;
    use std::sync::atomic::AtomicBool;
    use std::time::Duration;

    fn scored(values: Vec<f64>, cost: f64) -> Scored {
        Scored { genome: Genome::new(values, 1), score: Score::from_cost(cost) }
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
