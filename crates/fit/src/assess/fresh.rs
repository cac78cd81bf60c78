//! Scores of fitted parameters on other seeds.

use crate::control::Until;
use crate::error::FitError;
use crate::evaluator::Evaluator;
use crate::problem::FitProblem;
use crate::problem::Objective;
use crate::problem::{Genome, Score};
use pleach_tree::Limits;
use pleach_tree::math;
use serde::Serialize;

/// Mean and spread of a score over seeds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// The mean.
    pub mean: f64,
    /// The standard deviation of one seed, from the sample.
    pub sd: f64,
}

/// Scores of trees of the same parameters and of seeds that the search has not seen.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FreshSeeds {
    /// How many trees.
    pub count: usize,
    /// Intersection over union.
    pub iou: Spread,
    /// Share of equal pixels.
    pub pixel_accuracy: Spread,
    /// Likeness.
    pub likeness: Spread,
    /// The cost of the search.
    pub cost: Spread,
}

/// Offset of the first fresh seed from the fitted one: beyond any `--robust`.
const FIRST: u64 = 1000;

/// Grows `count` other trees of `genome`'s parameters and scores them against the goals of `problem`.
///
/// Fewer trees, but at least two, if it gets late. `None` if one of them does not grow within `limits`.
///
/// # Errors
/// A problem that [`Evaluator::new`] refuses, or [`FitError::Interrupted`] once asked to stop.
pub fn fresh_seeds(
    problem: &FitProblem,
    objective: Objective,
    limits: Limits,
    genome: &Genome,
    count: usize,
    until: Until<'_>,
) -> Result<Option<FreshSeeds>, FitError> {
    let seeds = (0..count as u64).map(|i| genome.tree_seed.wrapping_add(FIRST + i));
    let trees: Vec<Genome> = seeds.map(|tree_seed| Genome { tree_seed, ..genome.clone() }).collect();
    let evaluator = Evaluator::new(problem, objective, limits)?;
    let scores = until.map(&trees, |tree| evaluator.evaluate_with_likeness(tree))?;
    if scores.is_empty() || scores.iter().any(|score| !score.cost.is_finite()) {
        return Ok(None);
    }
    let spread = |of: fn(&Score) -> f64| Spread::new(scores.iter().map(of));
    Ok(Some(FreshSeeds {
        count: scores.len(),
        iou: spread(|score| score.iou),
        pixel_accuracy: spread(|score| score.accuracy),
        likeness: spread(|score| score.likeness.unwrap_or_default()),
        cost: spread(|score| score.cost),
    }))
}

impl Spread {
    /// Of at least one value; a single value has a spread of 0.
    fn new(values: impl ExactSizeIterator<Item = f64> + Clone) -> Self {
        let n = values.len() as f64;
        let mean = values.clone().sum::<f64>() / n;
        let squares: f64 = values.map(|v| math::powi(v - mean, 2)).sum();
        Self { mean, sd: (squares / (n - 1.0).max(1.0)).sqrt() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spreads_are_of_one_sample() {
        assert_eq!(Spread::new([1.0, 3.0].into_iter()), Spread { mean: 2.0, sd: 2.0_f64.sqrt() });
        assert_eq!(Spread::new([5.0].into_iter()), Spread { mean: 5.0, sd: 0.0 });
    }
}
