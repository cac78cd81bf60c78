//! Numbers that the goal hardly shows, as trees that look like it have them.
//!
//! A search sees the cost of one tree. Where a number hardly changes the picture it ends anywhere, and where it does it
//! also fits what the draws of that one tree have made. So numbers are moved to where they are expected, as far as the
//! trees of a few seeds look as much like the goal as before: by group testing (Dorfman 1943), since most of them make no
//! difference and trees are dear.

use crate::control::Until;
use crate::error::FitError;
use crate::evaluator::Evaluator;
use crate::problem::{FitProblem, Genome, Scored};
use crate::run::{FitSettings, search_space};
use crate::space::{Gene, SearchSpace};
use pleach_tree::Slot;
use std::collections::VecDeque;
use std::ops::RangeInclusive;

/// Trees of other seeds, the offset of their seeds from the fitted one (others than those of [`super::best_kind`],
/// [`super::finer_leaves`] and [`crate::fresh_seeds`]), and the weight of the tree that the search has seen.
const SEEDS: u64 = 3;
const FIRST: u64 = 4000;
const OWN: f64 = 2.0;
/// By how much that tree may cost more.
const MAX_RISE: f64 = 0.01;
/// A tree of a lower cost is the very tree of the goal, and stays as it is: two trees of a species have about 0.2.
const FOUND: f64 = 0.1;
/// So many of them are looked at first: a move by which they cost this much more is not worth the others.
const FIRST_SEEDS: u64 = 1;
const HOPELESS: f64 = 0.005;
/// Moves that are tried: of all numbers together by all of the way, the half and a quarter, then of parts of them.
const TRIALS: usize = 14;
const NEAREST: f64 = 0.25;

/// `best` with numbers where they are expected (`expected`, the least certain last) as far as its trees look as much like
/// the goals as before, and the slots that have exactly the numbers that are expected; as it is where trees of other seeds
/// do not grow, and where it is the goal's own tree.
///
/// # Errors
/// Those of [`crate::fit`] on the same problem and settings, and [`FitError::Interrupted`] once asked to stop.
pub fn with_expected_numbers(
    problem: &FitProblem,
    settings: &FitSettings,
    best: &Scored,
    expected: &[(Slot, f64)],
    until: Until<'_>,
) -> Result<(Scored, Vec<Slot>), FitError> {
    let space = search_space(problem, settings)?;
    let evaluator = Evaluator::new(problem, settings.objective, settings.limits)?;
    let Some(before) = costs(&evaluator, &best.genome, 0..=SEEDS, until)? else {
        return Ok((best.clone(), Vec::new()));
    };
    if !mean(&before).is_finite() || before[0] < FOUND {
        return Ok((best.clone(), Vec::new()));
    }
    let mut kept = best.genome.clone();
    let moves = Moves::new(&space, &mut kept, expected);
    let mut waiting = VecDeque::from([(0..moves.0.len(), 1.0)]);
    for _ in 0..TRIALS {
        let Some((part, share)) = waiting.pop_front() else { break };
        let moved = moves.made(&kept, &moves.0[part.clone()], share);
        let found = if moved == kept { Some(true) } else { is_no_worse(&evaluator, &moved, &before, until)? };
        let Some(is_accepted) = found else { break };
        if is_accepted {
            kept = moved;
        }
        if is_accepted && share == 1.0 {
            continue;
        }
        if !is_accepted && part.len() == moves.0.len() && share > NEAREST {
            waiting.push_back((part, 0.5 * share));
        } else if part.len() > 1 {
            let middle = part.start + part.len() / 2;
            waiting.extend([(part.start..middle, 1.0), (middle..part.end, 1.0)]);
        }
    }
    if kept == best.genome {
        return Ok((best.clone(), Vec::new()));
    }
    let evaluator = evaluator.with_seeds(settings.robust);
    let score = evaluator.evaluate_with_likeness(&kept);
    let there = expected.iter().filter(|(slot, value)| {
        kept.values[slot.index()] == *value && best.genome.values[slot.index()] != *value
    });
    let slots = there.map(|(slot, _)| *slot).collect();
    Ok((Scored { genome: kept, score }, slots))
}

/// Whether the trees of `genome` cost no more in the mean than those of costs `before`; `None` if it is late.
fn is_no_worse(
    evaluator: &Evaluator,
    genome: &Genome,
    before: &[f64],
    until: Until<'_>,
) -> Result<Option<bool>, FitError> {
    let Some(mut after) = costs(evaluator, genome, 0..=FIRST_SEEDS, until)? else { return Ok(None) };
    if after[0] > before[0] + MAX_RISE {
        return Ok(Some(false));
    }
    if mean(&after) > mean(&before[..after.len()]) + HOPELESS {
        return Ok(Some(false));
    }
    let Some(others) = costs(evaluator, genome, FIRST_SEEDS + 1..=SEEDS, until)? else { return Ok(None) };
    after.extend(others);
    Ok(Some(mean(&after) <= mean(before)))
}

/// The costs of trees `numbers`, of which the first has the seed of `genome`; `None` if it is late.
fn costs(
    evaluator: &Evaluator,
    genome: &Genome,
    numbers: RangeInclusive<u64>,
    until: Until<'_>,
) -> Result<Option<Vec<f64>>, FitError> {
    if until.is_late() {
        return Ok(None);
    }
    let tree = |number| {
        let far = if number == 0 { 0 } else { FIRST + number };
        Genome { tree_seed: genome.tree_seed.wrapping_add(far), ..genome.clone() }
    };
    let trees: Vec<Genome> = numbers.map(tree).collect();
    let scores = until.map(&trees, |tree| evaluator.score(tree))?;
    Ok((scores.len() == trees.len()).then(|| scores.iter().map(|score| score.cost).collect()))
}

/// The mean of costs, of which the first is that of the tree that the search has seen.
fn mean(costs: &[f64]) -> f64 {
    let sum = costs.iter().skip(1).fold(OWN * costs[0], |sum, cost| sum + cost);
    sum / (OWN + (costs.len() - 1) as f64)
}

/// Numbers and where they are expected.
struct Moves<'a>(Vec<(&'a Gene, f64)>);

impl<'a> Moves<'a> {
    /// Those of `expected` that `space` may change in `genome`. Numbers that are not read make no other tree, and are set
    /// there at once.
    fn new(space: &'a SearchSpace, genome: &mut Genome, expected: &[(Slot, f64)]) -> Self {
        let hidden = space.hidden_jitters(&genome.values);
        let mut moves = Vec::new();
        for &(slot, value) in expected {
            let gene = space.genes().iter().find(|gene| gene.slot() == Some(slot));
            let Some(gene) = gene.filter(|_| !hidden.contains(&slot)) else { continue };
            let value = gene.clamp(value);
            if space.is_active(&genome.values, gene) {
                moves.push((gene, value));
            } else {
                gene.set(genome, value);
            }
        }
        Self(moves)
    }

    /// `genome` with the numbers of `part` by `share` of the way to where they are expected; choices go all of it.
    fn made(&self, genome: &Genome, part: &[(&Gene, f64)], share: f64) -> Genome {
        let mut moved = genome.clone();
        for &(gene, there) in part {
            let value = if gene.is_choice() || share == 1.0 {
                there
            } else {
                let [from, to] = [gene.get(genome), there].map(|value| gene.to_unit(value));
                gene.from_unit(from + share * (to - from))
            };
            gene.set(&mut moved, value);
        }
        moved
    }
}
