//! One population, and the operators and steps that have worked in it.

use super::operators::{Offspring, Operator, Variation};
use super::settings::EvolutionSettings;
use crate::method::is_individual;
use crate::problem::{Genome, Score, Scored};
use crate::space::{SearchSpace, Stream};
use pleach_tree::math;
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// A population, best first, with the steps and the chances of operators that have worked.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Island {
    population: Vec<Scored>,
    /// Step of each gene as a part of its range; empty before the first children.
    steps: Vec<f64>,
    /// How much each gene has helped recently, relative to the least that it is tried.
    weight: Vec<f64>,
    /// How much each operator has helped recently.
    operator_credit: Vec<f64>,
    /// The origin of the children of each batch in flight, oldest first.
    offspring: VecDeque<Vec<Offspring>>,
    /// Children since the best became better by more than [`GAIN`] of its cost.
    stagnation: u64,
    /// The cost that has to be beaten for an island not to stagnate.
    mark: f64,
}

/// Part of the cost that counts as progress.
const GAIN: f64 = 1e-3;
/// Factors on a gene's step after a success and after a failure: steady at one success in five.
const LONGER: f64 = 1.5;
const SHORTER: f64 = 0.9;
/// Steps stay between these parts of the range.
const STEPS: (f64, f64) = (2e-3, 0.5);
/// What a child earns its operator that is better than the best, and than its parent.
const BEST_REWARD: f64 = 1.0;
const BETTER_REWARD: f64 = 0.2;
/// Weight of the newest reward, and the least credit, of operators and of genes.
const OPERATOR_MEMORY: f64 = 0.02;
const GENE_MEMORY: f64 = 0.05;
const MIN_OPERATOR: f64 = 0.01;
const MIN_GENE: f64 = 0.06;

impl Island {
    pub(super) fn is_empty(&self) -> bool {
        self.population.is_empty()
    }

    pub(super) fn best(&self) -> Option<&Scored> {
        self.population.first()
    }

    /// Batches without scores.
    pub(super) fn in_flight(&self) -> usize {
        self.offspring.len()
    }

    pub(super) const fn stagnation(&self) -> u64 {
        self.stagnation
    }

    /// Adds `newborn` to the population and keeps the best `most`; of equal costs only one, since they are
    /// the same tree.
    pub(super) fn settle(&mut self, newborn: Vec<Scored>, most: usize) {
        if self.population.is_empty() {
            self.mark = f64::INFINITY;
        }
        self.population.extend(newborn);
        self.population.sort_by(|a, b| a.score.cost.total_cmp(&b.score.cost));
        self.population.dedup_by(|a, b| a.score.cost == b.score.cost);
        self.population.truncate(most.max(2));
        let best = self.best().map_or(f64::INFINITY, |best| best.score.cost);
        if best < self.mark * (1.0 - GAIN) || self.mark == f64::INFINITY {
            self.mark = best;
            self.stagnation = 0;
        }
    }

    /// Counts `children` towards stagnation, before their scores are known.
    pub(super) const fn age(&mut self, children: usize) {
        self.stagnation += children as u64;
    }

    /// Whether this can be an island of a search in `space`: see [`crate::Method::suits`].
    pub(super) fn suits(
        &self,
        space: &SearchSpace,
        settings: &EvolutionSettings,
        children: u64,
        pending: &[usize],
    ) -> bool {
        let genes = space.genes().len();
        let has_learnt = self.operator_credit.len() == Operator::ALL.len()
            && (self.steps.len(), self.weight.len()) == (genes, genes)
            && (self.steps.iter().chain(&self.weight).chain(&self.operator_credit))
                .all(|number| number.is_finite() && *number > 0.0);
        let is_new = self.operator_credit.is_empty() && self.steps.is_empty() && self.weight.is_empty();
        // The elites that meet may be more than survive a generation.
        let most = settings.parents.max(2).max(settings.islands.saturating_add(1));
        (has_learnt || (is_new && self.offspring.is_empty()))
            && self.stagnation <= children
            && self.population.len() <= most
            && self.population.iter().all(|one| is_individual(&one.genome, space))
            && self
                .offspring
                .iter()
                .flatten()
                .flat_map(|offspring| &offspring.genes)
                .all(|&gene| gene < genes)
            && if self.is_empty() {
                pending.len() <= 1 && self.offspring.is_empty()
            } else {
                self.offspring.iter().map(Vec::len).eq(pending.iter().copied())
            }
    }

    /// Before the first children: nothing is known yet.
    fn prepare(&mut self, space: &SearchSpace, settings: &EvolutionSettings) {
        if self.operator_credit.is_empty() {
            let genes = space.genes().len();
            self.steps = vec![settings.step; genes];
            self.weight = vec![4.0 * MIN_GENE; genes];
            self.operator_credit = vec![0.1; Operator::ALL.len()];
        }
    }

    /// Appends `size` children to `members`; `draws` gives each its own stream.
    pub(super) fn make_children(
        &mut self,
        space: &SearchSpace,
        settings: &EvolutionSettings,
        size: usize,
        draws: impl Fn(u32) -> Stream,
        members: &mut Vec<Genome>,
    ) {
        self.prepare(space, settings);
        let variation = Variation {
            space,
            population: &self.population,
            steps: &self.steps,
            weight: &self.weight,
            operator_credit: &self.operator_credit,
            selection_pressure: settings.selection_pressure,
        };
        let children = (0..size).map(|member| self.child(&variation, draws(member as u32)));
        let (genomes, offspring): (Vec<_>, Vec<_>) = children.unzip();
        members.extend(genomes);
        self.offspring.push_back(offspring);
    }

    /// A child that is not one of the population itself, as far as a few tries can tell.
    fn child(&self, variation: &Variation<'_>, mut draws: Stream) -> (Genome, Offspring) {
        let (mut child, mut offspring) = variation.child(&mut draws);
        for _ in 0..5 {
            if self.population.iter().all(|old| old.genome != child) {
                break;
            }
            (child, offspring) = variation.child(&mut draws);
        }
        (child, offspring)
    }

    /// Rewards operators and genes for the children they have made, and adapts the steps.
    pub(super) fn learn(&mut self, scores: &[Score]) {
        let best = self.best().map_or(f64::INFINITY, |best| best.score.cost);
        for (offspring, score) in self.offspring.pop_front().unwrap_or_default().iter().zip(scores) {
            let better = score.cost < offspring.parent_cost;
            let reward = if score.cost < best {
                BEST_REWARD
            } else if better {
                BETTER_REWARD
            } else {
                0.0
            };
            let operator_credit = &mut self.operator_credit[offspring.by as usize];
            *operator_credit =
                (*operator_credit + OPERATOR_MEMORY * (reward - *operator_credit)).max(MIN_OPERATOR);
            // One gene is judged by what it did alone; among several each has its share of it.
            let share = if offspring.genes.len() == 1 { 1.0 } else { 0.3 };
            for &gene in &offspring.genes {
                let factor = if better { LONGER } else { SHORTER };
                self.steps[gene] = (self.steps[gene] * math::pow(factor, share)).clamp(STEPS.0, STEPS.1);
                let weight = &mut self.weight[gene];
                *weight = (*weight + share * GENE_MEMORY * (reward - *weight)).max(MIN_GENE);
            }
        }
    }
}
