//! Substitutes for a best that does not grow from other seeds.
//!
//! A search grows one tree of each list of numbers. Where forks multiply, a grammar draws its rules, or something
//! else depends on the draws, other trees of the same list may exceed a limit or have no stem at all. They would
//! occur in a forest of the result.

use crate::error::FitError;
use crate::evaluator::Evaluator;
use crate::method::Start;
use crate::problem::FitProblem;
use crate::problem::{Genome, Scored};
use crate::run::FitSettings;
use crate::run::{evaluator_in, search_space};
use crate::space::SearchSpace;

/// Positions of the lists between the start (0) and the best (1).
const PARTS: [f64; 3] = [0.5, 0.25, 0.0];

/// Substitutes for `best`, the one of least cost first: former bests of the search, and lists between the start and
/// `best`.
///
/// # Errors
/// Those of [`crate::fit`] on the same problem and settings.
pub(crate) fn substitutes(
    best: &Scored,
    finalists: &[Scored],
    problem: &FitProblem,
    settings: &FitSettings,
) -> Result<Vec<Scored>, FitError> {
    if settings.rules.is_some() {
        // The numbers of each belong to a structure of its own.
        return Ok(Vec::new());
    }
    let mut list: Vec<Scored> = finalists.iter().filter(|one| one.genome != best.genome).cloned().collect();
    if let Start::Lists(lists) = &settings.start {
        let space = search_space(problem, settings)?;
        let evaluator = evaluator_in(&space, problem, settings)?;
        list.extend(PARTS.iter().filter_map(|&part| between(best, &lists[0], part, &space, &evaluator)));
    }
    list.sort_by(|a, b| a.score.cost.total_cmp(&b.score.cost));
    Ok(list)
}

/// The list that is `part` of the way from `start` to `best`, at the goal's height; `None` if it does not grow.
fn between(
    best: &Scored,
    start: &[f64],
    part: f64,
    space: &SearchSpace,
    evaluator: &Evaluator,
) -> Option<Scored> {
    let mut genome = Genome { values: start.to_vec(), ..best.genome.clone() };
    for gene in space.genes().iter().filter(|gene| part > 0.0 && gene.slot().is_some() && !gene.is_choice()) {
        let [from, to] = [gene.get(&genome), gene.get(&best.genome)].map(|value| gene.to_unit(value));
        gene.set(&mut genome, gene.from_unit(from + part * (to - from)));
    }
    space.settle(&mut genome);
    let score = evaluator.score(&genome);
    space.resize(&mut genome, score.resized);
    score.cost.is_finite().then_some(Scored { genome, score })
}
