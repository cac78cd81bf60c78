//! Smaller leaves for a result, where the picture looks the same with them.
//!
//! A search sees a picture of some hundred pixels and grows thousands of trees, so that it is content with few and large
//! leaves. A person who looks at the tree is not.

use crate::control::Until;
use crate::error::FitError;
use crate::evaluator::Evaluator;
use crate::problem::{FitProblem, Genome, Objective, Scored};
use crate::space::{Freedom, may_change};
use pleach_tree::{Foliage, Limits};

/// Trees of other seeds, and the offset of their seeds from the fitted one: others than those of
/// [`super::best_kind`] and [`crate::fresh_seeds`].
const SEEDS: u64 = 4;
const FIRST: u64 = 3000;
/// By how much their mean cost may rise, and within what it is the same.
const MAX_LOSS: f64 = 0.01;
const NOISE: f64 = 0.004;
/// Largest number of leaves of a tree: what can still be looked at and exported.
const MAX_LEAVES: usize = 250_000;

/// `best` with the finest leaves that its generator offers of those whose other seeds cost least; `best` itself if they
/// cost more by over [`MAX_LOSS`], if there are none that `freedom` allows, or if it is late.
///
/// # Errors
/// A problem that [`Evaluator::new`] refuses, or [`FitError::Interrupted`] once asked to stop.
pub(crate) fn finer_leaves(
    problem: &FitProblem,
    objective: Objective,
    freedom: &Freedom,
    best: Scored,
    until: Until<'_>,
) -> Result<Scored, FitError> {
    let species = &problem.start;
    let offered = if problem.foliage == Foliage::None {
        Vec::new()
    } else {
        species.generator.finer_leaves(&best.genome.values)
    };
    let mut lists = vec![best.genome.values.clone()];
    for values in offered {
        if may_change(species.params.space(), freedom, &best.genome.values, &values)? {
            lists.push(values);
        }
    }
    if lists.len() == 1 {
        return Ok(best);
    }
    let limits = Limits { leaves: MAX_LEAVES, ..Limits::DEFAULT };
    let evaluator = Evaluator::new(problem, objective, limits)?;
    let trees: Vec<Genome> = lists
        .iter()
        .flat_map(|values| (0..SEEDS).map(move |seed| (values, seed)))
        .map(|(values, seed)| Genome {
            values: values.clone(),
            tree_seed: best.genome.tree_seed.wrapping_add(FIRST + seed),
            ..best.genome.clone()
        })
        .collect();
    let scores = until.map(&trees, |tree| evaluator.evaluate_with_likeness(tree))?;
    let costs: Vec<f64> = scores
        .chunks_exact(SEEDS as usize)
        .map(|seeds| seeds.iter().map(|score| score.cost).sum::<f64>() / SEEDS as f64)
        .collect();
    let least = costs.iter().skip(1).copied().fold(f64::INFINITY, f64::min);
    let most = (least + NOISE).min(costs[0] + MAX_LOSS);
    let is_good = |one: &usize| costs[*one].is_finite() && costs[*one] <= most;
    if let Some(finest) = (1..costs.len()).find(is_good) {
        let genome = Genome { values: lists.swap_remove(finest), ..best.genome.clone() };
        let score = evaluator.evaluate_with_likeness(&genome);
        if score.cost.is_finite() {
            return Ok(Scored { genome, score });
        }
    }
    Ok(best)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::{GoalView, Score};
    use pleach_silhouette::{Frame, View, silhouette};
    use pleach_tree::{Parts, Species};
    use std::sync::atomic::AtomicBool;
    use std::time::Duration;

    fn oak(leaflets: f64) -> Species {
        let oak = pleach_generators::preset("english_oak").unwrap();
        let space = oak.params.space();
        let slot = |name: &str| space.select(name).unwrap()[0].index();
        let mut values = oak.params.values().to_vec();
        values[slot("leaflets")] = leaflets;
        values[slot("leaf_length")] = 0.5;
        let params = space.check(values).unwrap();
        Species { params, ..oak }
    }

    fn problem(goal: &Species) -> FitProblem {
        let tree = goal.grow(5).unwrap();
        let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 96, 96);
        let goal = GoalView::new(silhouette(&tree, View::FRONT, 96), View::FRONT, frame);
        FitProblem::new(oak(1.0), goal)
    }

    fn leaflets(problem: &FitProblem, freedom: &Freedom, until: Until<'_>) -> Result<f64, FitError> {
        let values = problem.start.params.values().to_vec();
        let best = Scored { genome: Genome::new(values, 5), score: Score::from_cost(0.5) };
        let found = finer_leaves(problem, Objective::Balance, freedom, best, until)?;
        let slot = problem.start.params.space().select("leaflets").unwrap()[0];
        Ok(found.genome.values[slot.index()])
    }

    #[test]
    fn leaves_get_finer_where_the_picture_allows_it() {
        let stop = AtomicBool::new(false);
        let until = Until::from(&stop);
        let free = Freedom::default();
        let fine = problem(&oak(7.0));
        assert!(leaflets(&fine, &free, until).unwrap() >= 5.0);
        let fixed = Freedom { fix: vec!["leaflets".to_owned()], ..Freedom::default() };
        assert_eq!(leaflets(&fine, &fixed, until).unwrap(), 1.0);
        let others = Freedom { free: vec!["crown".to_owned()], ..Freedom::default() };
        assert_eq!(leaflets(&fine, &others, until).unwrap(), 1.0);
        let bare = FitProblem { foliage: Foliage::None, ..fine.clone() };
        assert_eq!(leaflets(&bare, &free, until).unwrap(), 1.0);
        let clock = || Duration::from_secs(9);
        let late = until.or_late(&clock, Some(Duration::from_secs(1)));
        assert_eq!(leaflets(&fine, &free, late).unwrap(), 1.0);
        stop.store(true, std::sync::atomic::Ordering::Relaxed);
        assert!(matches!(leaflets(&fine, &free, until), Err(FitError::Interrupted)));
    }
}
