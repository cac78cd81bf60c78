//! Candidates and individuals in the order of their likeness to the goal.

use super::candidate::{Candidate, Models};
use super::contradiction::NO_START;
use super::found::Guess;
use super::goal_context::GoalContext;
use super::library::{Entry, Resemblance};
use crate::control::interrupt;
use crate::error::FitError;
use crate::evaluator::Evaluator;
use crate::problem::{FitProblem, Genome};
use pleach_tree::math;

/// This many times the kept trees are scored by the cost of the search, and of each family an equal part of them, but at
/// least as many as are kept: the trees of a family that looks less like the goal at first may come nearer to it.
const ALIKE: usize = 3;
/// How much lower the likeness of a candidate is that is e times less probable. Chosen by the trees of
/// [`super::learnt`]: with 0.02 the right species had 0.03 of the confidence in the geometric mean.
const DOUBT: f64 = 0.08;

/// 1 minus the likeness of an individual, with what contradicts the goal; its candidate, and the individual.
pub(super) type Alike = (f64, usize, Genome);

/// The least cost of each candidate, and the individuals that look most like the goal, at its height:
/// some of all, and `keep` of each family.
pub(super) fn ranked(
    context: &GoalContext<'_>,
    (entries, found): (&[Entry], &[Option<Resemblance>]),
    keep: usize,
) -> (Vec<f64>, Vec<Alike>) {
    let mut costs = vec![f64::INFINITY; context.candidates.len()];
    let mut alike = Vec::new();
    let (mut least, mut contradictions) = (Least::default(), Vec::new());
    for (Entry { sample, .. }, found) in entries.iter().zip(found) {
        let Some(Resemblance { likeness, contradiction, factor, .. }) = found else { continue };
        let cost = 1.0 - likeness + contradiction;
        costs[sample.candidate] = costs[sample.candidate].min(cost);
        if sample.may_start {
            let mut genome = sample.genome.clone();
            context.resize(sample.candidate, &mut genome.values, *factor);
            alike.push((cost, sample.candidate, genome));
            least.add(context.family(sample.candidate), *contradiction);
            contradictions.push(*contradiction);
        }
    }
    // Where some tree of a family does not contradict the goal, no search of the family starts from one that does.
    let mut contradictions = contradictions.into_iter();
    alike.retain(|(_, candidate, _)| {
        contradictions.next().is_some_and(|one| one <= least.get(context.family(*candidate)) + NO_START)
    });
    alike.sort_by(|a, b| a.0.total_cmp(&b.0));
    let of_each = keep.max(keep * ALIKE / least.0.len().max(1));
    let mut kept = Vec::<Alike>::new();
    let of_family =
        |kept: &[Alike], family| kept.iter().filter(|one| context.family(one.1) == family).count();
    for one in alike {
        if kept.len() < keep * ALIKE || of_family(&kept, context.family(one.1)) < of_each {
            kept.push(one);
        }
    }
    (costs, kept)
}

/// The least contradiction of each family.
#[derive(Default)]
struct Least(Vec<(&'static str, f64)>);

impl Least {
    fn add(&mut self, family: &'static str, contradiction: f64) {
        match self.0.iter_mut().find(|(known, _)| *known == family) {
            Some((_, least)) => *least = least.min(contradiction),
            None => self.0.push((family, contradiction)),
        }
    }

    fn get(&self, family: &str) -> f64 {
        self.0.iter().find(|(known, _)| *known == family).map_or(f64::INFINITY, |(_, least)| *least)
    }
}

/// Individuals with their candidates, scored by the cost of the search, best first; without those that do not grow.
pub(super) fn scored(
    problem: &FitProblem,
    context: &GoalContext<'_>,
    alike: Vec<Alike>,
) -> Result<Vec<(usize, Guess)>, FitError> {
    let settings = context.settings;
    let exact = Evaluator::new(problem, settings.objective, settings.limits)?.with_seeds(settings.robust);
    let exact = Models::new(context.candidates, &exact);
    let score = |(_, candidate, genome): &Alike| exact.evaluator(*candidate).score(genome);
    let scores = interrupt::map(&alike, context.stop, score)?;
    let name = |candidate: usize| context.candidates[candidate].species.name.clone();
    let mut nearest: Vec<(usize, Guess)> = (alike.into_iter().zip(scores))
        .filter(|(_, score)| score.cost.is_finite())
        .map(|((_, candidate, genome), score)| {
            (candidate, Guess { name: name(candidate), values: genome.values, score })
        })
        .collect();
    nearest.sort_by(|a, b| a.1.score.cost.total_cmp(&b.1.score.cost));
    Ok(nearest)
}

/// The candidate of the least cost, if one grew.
pub(super) fn first_of(costs: &[f64]) -> Option<usize> {
    let (first, cost) = costs.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1))?;
    cost.is_finite().then_some(first)
}

/// Names with their confidence, the most probable first.
pub(super) fn confidence(candidates: &[Candidate], costs: &[f64]) -> Vec<(String, f64)> {
    let best = costs.iter().copied().fold(f64::INFINITY, f64::min);
    let weights: Vec<f64> = costs.iter().map(|cost| math::exp((best - cost) / DOUBT)).collect();
    let sum: f64 = weights.iter().sum();
    let mut names: Vec<_> =
        candidates.iter().zip(&weights).map(|(c, weight)| (c.species.name.clone(), weight / sum)).collect();
    names.sort_by(|a, b| b.1.total_cmp(&a.1));
    names
}
