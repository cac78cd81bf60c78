//! One population and what it has learnt.

use super::super::is_individual;
use super::moves::{Birth, Breeder, Move};
use super::settings::EvolutionSettings;
use crate::genome::{Genome, Score, Scored};
use crate::space::SearchSpace;
use crate::stream::Stream;
use serde::{Deserialize, Serialize};

/// A population, best first, with the steps and the chances of moves that have served it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Lane {
    population: Vec<Scored>,
    /// Step of each gene as a part of its range; empty before the first children.
    steps: Vec<f64>,
    /// How much each gene has helped of late, relative to the least that it is tried.
    promise: Vec<f64>,
    /// How much each move has helped of late.
    credit: Vec<f64>,
    /// Where the children come from that are being evaluated.
    births: Vec<Birth>,
    /// Generations since the best became better by more than [`GAIN`] of its cost.
    idle: u64,
    /// The cost that has to be beaten for a lane not to be idle.
    mark: f64,
}

/// Part of the cost that counts as progress.
const GAIN: f64 = 1e-3;
/// Factors on a gene's step after a success and after a failure: steady at one success in five.
const LONGER: f64 = 1.5;
const SHORTER: f64 = 0.9;
/// Steps stay between these parts of the range.
const STEPS: (f64, f64) = (2e-3, 0.5);
/// What a child earns its move that is better than the best, and than its parent.
const BEST_REWARD: f64 = 1.0;
const BETTER_REWARD: f64 = 0.2;
/// Weight of the newest reward, and the least credit, of moves and of genes.
const MOVE_MEMORY: f64 = 0.02;
const GENE_MEMORY: f64 = 0.05;
const MIN_MOVE: f64 = 0.01;
const MIN_GENE: f64 = 0.06;

impl Lane {
    pub(super) fn is_empty(&self) -> bool {
        self.population.is_empty()
    }

    pub(super) fn best(&self) -> Option<&Scored> {
        self.population.first()
    }

    pub(super) const fn idle(&self) -> u64 {
        self.idle
    }

    /// Puts `newborn` among the population and keeps the best `most`; of equal costs only one, since
    /// it is the same tree.
    pub(super) fn settle(&mut self, newborn: Vec<Scored>, most: usize) {
        if self.population.is_empty() {
            self.mark = f64::INFINITY;
        }
        self.population.extend(newborn);
        self.population.sort_by(|a, b| a.score.cost.total_cmp(&b.score.cost));
        self.population.dedup_by(|a, b| a.score.cost == b.score.cost);
        self.population.truncate(most.max(2));
        self.births.clear();
        let best = self.best().map_or(f64::INFINITY, |best| best.score.cost);
        if best < self.mark * (1.0 - GAIN) || self.mark == f64::INFINITY {
            self.mark = best;
            self.idle = 0;
        } else {
            self.idle += 1;
        }
    }

    /// Whether this can be a lane of a search in `space`: see [`super::Method::suits`].
    pub(super) fn suits(
        &self,
        space: &SearchSpace,
        settings: &EvolutionSettings,
        generations: u64,
        pending: usize,
    ) -> bool {
        let genes = space.genes().len();
        let has_learnt = self.credit.len() == Move::ALL.len()
            && (self.steps.len(), self.promise.len()) == (genes, genes)
            && (self.steps.iter().chain(&self.promise).chain(&self.credit))
                .all(|number| number.is_finite() && *number > 0.0);
        let is_new = self.credit.is_empty() && self.steps.is_empty() && self.promise.is_empty();
        // Champions that meet may be more than survive a generation.
        let most = settings.parents.max(2).max(settings.lanes.saturating_add(1));
        (has_learnt || (is_new && self.births.is_empty()))
            && self.idle <= generations
            && self.population.len() <= most
            && self.population.iter().all(|one| is_individual(&one.genome, space))
            && self.births.iter().flat_map(|birth| &birth.genes).all(|&gene| gene < genes)
            && (pending == 0 || self.is_empty() || self.births.len() == pending)
    }

    /// Before the first children: nothing is known yet.
    pub(super) fn prepare(&mut self, space: &SearchSpace, settings: &EvolutionSettings) {
        if self.credit.is_empty() {
            let genes = space.genes().len();
            self.steps = vec![settings.step; genes];
            self.promise = vec![4.0 * MIN_GENE; genes];
            self.credit = vec![0.1; Move::ALL.len()];
        }
    }

    /// A child that is not one of the population itself, as far as a few tries can tell.
    pub(super) fn breed(
        &mut self,
        space: &SearchSpace,
        settings: &EvolutionSettings,
        draws: &mut Stream,
    ) -> Genome {
        let breeder = Breeder {
            space,
            population: &self.population,
            steps: &self.steps,
            promise: &self.promise,
            credit: &self.credit,
            greed: settings.greed,
        };
        let (mut child, mut birth) = breeder.child(draws);
        for _ in 0..5 {
            if self.population.iter().all(|old| old.genome != child) {
                break;
            }
            (child, birth) = breeder.child(draws);
        }
        self.births.push(birth);
        child
    }

    /// Rewards moves and genes for the children they have made, and adapts the steps.
    pub(super) fn learn(&mut self, scores: &[Score]) {
        let best = self.best().map_or(f64::INFINITY, |best| best.score.cost);
        for (birth, score) in self.births.iter().zip(scores) {
            let better = score.cost < birth.parent_cost;
            let reward = if score.cost < best {
                BEST_REWARD
            } else if better {
                BETTER_REWARD
            } else {
                0.0
            };
            let credit = &mut self.credit[birth.by as usize];
            *credit = (*credit + MOVE_MEMORY * (reward - *credit)).max(MIN_MOVE);
            // One gene is judged by what it did alone; among several each has its share of it.
            let share = if birth.genes.len() == 1 { 1.0 } else { 0.3 };
            for &gene in &birth.genes {
                let factor = if better { LONGER } else { SHORTER };
                self.steps[gene] = (self.steps[gene] * factor.powf(share)).clamp(STEPS.0, STEPS.1);
                let promise = &mut self.promise[gene];
                *promise = (*promise + share * GENE_MEMORY * (reward - *promise)).max(MIN_GENE);
            }
        }
    }
}
