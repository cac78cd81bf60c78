//! What a kind is worth: trees of other seeds against the goal.

use super::stop;
use pleach_fit::{FitProblem, Genome, Objective, fresh_seeds};
use pleach_tree::{Limits, Species};

/// Trees of other seeds that a kind is judged by.
pub(super) const FRESH: usize = 16;

/// Mean likeness to the goals of `problem` of trees of `species`, with the leaves that it says, of [`FRESH`] seeds
/// after `seed`; 0 where one of them does not grow.
pub(super) fn fresh(problem: &FitProblem, species: &Species, seed: u64) -> anyhow::Result<f64> {
    let own = FitProblem { start: species.clone(), foliage: species.foliage, goals: problem.goals.clone() };
    let genome = Genome::new(species.params.values().to_vec(), seed);
    let until = stop::flag().into();
    let fresh = fresh_seeds(&own, Objective::Likeness, Limits::DEFAULT, &genome, FRESH, until)?;
    Ok(fresh.map_or(0.0, |fresh| fresh.likeness.mean))
}
