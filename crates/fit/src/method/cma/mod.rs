//! CMA-ES (Hansen 2016) with margin (Hamano, Saito, Nomura and Shirakawa 2022), restarted with twice
//! the population when it stagnates (IPOP: Auger and Hansen 2005).
//!
//! A normal distribution over the free numbers, each in the units of
//! [`crate::Gene::to_unit`], is drawn from and moved to what was good. What a coordinate stands
//! for is said in `coding.rs`; `margin.rs` keeps whole numbers and choices moving.
//!
//! Individuals come back changed: resized to the goal's height, variations of size set to zero ([`crate::Search`]).
//! The distribution learns from the numbers *as it drew them*. To it, that change is part of the function: draws that
//! differ only in size cost the same, so the direction is flat, and harmless. Learning from the changed numbers would
//! put all of a generation onto one surface, and the covariance would collapse towards it for no other reason. Only
//! the first mean, the best of the first lists, is taken as it was drawn.
//!
//! Where the tree seed is free, the distribution has a seed: that of the best individual since it began. A share of
//! [`CmaSettings::reseed`] of its individuals have a new one.

mod coding;
mod distribution;
mod eigen;
mod margin;
mod normal;
mod strategy;

use super::first::{first, given};
use super::{Method, MethodSettings, Start, only_batch, ranking};
use crate::problem::{Genome, Score};
use crate::space::Stream;
use crate::space::{SearchSpace, TreeSeed};
use distribution::Distribution;
use serde::{Deserialize, Serialize};
use strategy::Strategy;

/// Settings of [`Cma`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CmaSettings {
    /// Individuals in a generation before the first restart; 0 for 4 + 3 ln n, n the free numbers.
    pub population: usize,
    /// Random lists at a beginning, the best of which is the first mean.
    pub first: usize,
    /// Largest probability that a number of a random list that may be zero is set to zero.
    pub sparsity: f64,
    /// First step σ around the best random list, as a part of search ranges.
    pub step: f64,
    /// First step σ around the best of the lists that the search was given.
    pub near_step: f64,
    /// Share of individuals with a new tree seed, if the seed is free.
    pub reseed: f64,
    /// Generations without a gain of a thousandth, over 10 + 30 n / population, after which it
    /// restarts.
    pub patience: f64,
}

impl Default for CmaSettings {
    fn default() -> Self {
        Self {
            population: 0,
            first: 200,
            sparsity: 0.8,
            step: 0.1,
            near_step: 0.03,
            reseed: 0.1,
            patience: 1.0,
        }
    }
}

/// The distribution, and what was drawn from it last.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cma {
    settings: CmaSettings,
    seed: u64,
    start: Start,
    round: u64,
    restarts: u32,
    /// `None` before the first lists have scores.
    state: Option<State>,
    /// The standard normal draws of the individuals that are being evaluated, one after the other.
    zs: Vec<f64>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct State {
    distribution: Distribution,
    population: usize,
    tree_seed: u64,
    best: f64,
    /// The cost that has to be beaten for the search not to be idle.
    mark: f64,
    idle: u64,
}

/// Purposes of the draws.
const FIRST: u32 = 0;
const SAMPLE: u32 = 1;

/// Part of the cost that counts as progress.
const GAIN: f64 = 1e-3;
/// Upper bound of the individuals in a generation, however often it restarts.
const MAX: usize = 4096;

impl Cma {
    /// Starts at the best of the lists of `start`, or of random lists.
    #[must_use]
    pub const fn new(settings: CmaSettings, seed: u64, start: Start) -> Self {
        Self { settings, seed, start, round: 0, restarts: 0, state: None, zs: Vec::new() }
    }

    /// Whether the lists that are evaluated first are those that the search was given.
    fn is_given(&self) -> bool {
        self.round == 0 && !self.start.lists().is_empty()
    }

    fn begin(&self, space: &SearchSpace, members: &mut Vec<Genome>) {
        let draws = |member| Stream::at(self.seed, FIRST, self.round, member);
        if self.is_given() {
            given(space, self.start.lists(), draws, members);
        } else {
            first(space, &[], self.settings.first.max(1), self.settings.sparsity, draws, members);
        }
    }

    /// Individuals in a generation, of `n` free numbers, since the last restart.
    fn population(&self, n: usize) -> usize {
        let smallest = match self.settings.population {
            0 => strategy::population(n),
            given => given.max(4),
        };
        smallest.saturating_mul(1_usize << self.restarts.min(16)).min(MAX.max(smallest))
    }

    /// The distribution around the best of `members`, if one of them grows.
    fn begun(&self, space: &SearchSpace, members: &[Genome], scores: &[Score]) -> Option<State> {
        let best = *ranking(scores).first()?;
        let cost = scores[best].cost;
        if cost == f64::INFINITY {
            return None;
        }
        let genes = space.genes();
        let mean = genes.iter().map(|gene| coding::encode(gene, gene.get(&members[best]))).collect();
        let sigma = if self.is_given() { self.settings.near_step } else { self.settings.step };
        let population = self.population(genes.len());
        let mut distribution = Distribution::new(mean, sigma);
        keep_margin(&mut distribution, space, population);
        let tree_seed = members[best].tree_seed;
        Some(State { distribution, population, tree_seed, best: cost, mark: cost, idle: 0 })
    }
}

/// Keeps the margin that the paper recommends: one chance in as many as numbers are drawn in a
/// generation.
fn keep_margin(distribution: &mut Distribution, space: &SearchSpace, population: usize) {
    let genes = space.genes();
    let alpha = 1.0 / (genes.len().max(1) * population) as f64;
    distribution.keep_margin(alpha, |number, x| coding::cell(&genes[number], x));
}

impl State {
    fn learn(&mut self, space: &SearchSpace, zs: &[f64], members: &[Genome], scores: &[Score]) {
        let n = space.genes().len();
        let order = ranking(scores);
        let best = order[0];
        if scores[best].cost < self.best {
            self.best = scores[best].cost;
            self.tree_seed = members[best].tree_seed;
        }
        if self.best < self.mark * (1.0 - GAIN) {
            self.mark = self.best;
            self.idle = 0;
        } else {
            self.idle += 1;
        }
        let failed = scores.iter().filter(|score| score.cost == f64::INFINITY).count();
        let sorted: Vec<&[f64]> = order.iter().map(|&member| &zs[member * n..(member + 1) * n]).collect();
        self.distribution.learn(&sorted, failed, &Strategy::new(n, self.population));
        keep_margin(&mut self.distribution, space, self.population);
    }

    fn is_stagnant(&self, space: &SearchSpace, patience: f64) -> bool {
        let generations = 10.0 + 30.0 * space.genes().len() as f64 / self.population as f64;
        self.idle as f64 > patience * generations || self.distribution.is_spent()
    }
}

impl MethodSettings for CmaSettings {
    type Method = Cma;

    fn begin(&self, seed: u64, start: Start) -> Cma {
        Cma::new(self.clone(), seed, start)
    }

    fn has_begun(&self, method: &Cma, seed: u64, start: &Start) -> bool {
        (&method.settings, method.seed, &method.start) == (self, seed, start)
    }
}

impl Method for Cma {
    fn name(&self) -> &'static str {
        "cma"
    }

    fn ask(&mut self, space: &SearchSpace, members: &mut Vec<Genome>) {
        self.zs.clear();
        let Some(state) = &self.state else {
            self.begin(space, members);
            return;
        };
        let genes = space.genes();
        for member in 0..state.population {
            let mut draws = Stream::at(self.seed, SAMPLE, self.round, member as u32);
            let any = space.tree_seed() == TreeSeed::Any;
            let is_new = any && (draws.chance(self.settings.reseed) || genes.is_empty());
            let seed = if is_new { SearchSpace::random_seed(&mut draws) } else { state.tree_seed };
            let z: Vec<f64> = genes.iter().map(|_| draws.normal()).collect();
            let mut genome = space.individual(space.base(), seed);
            for (gene, x) in genes.iter().zip(state.distribution.sample(&z)) {
                gene.set(&mut genome, coding::decode(gene, x));
            }
            members.push(genome);
            self.zs.extend(z);
        }
    }

    fn tell(&mut self, space: &SearchSpace, members: &[Genome], scores: &[Score]) {
        match &mut self.state {
            None => self.state = self.begun(space, members, scores),
            Some(state) => {
                state.learn(space, &self.zs, members, scores);
                if state.is_stagnant(space, self.settings.patience) {
                    self.state = None;
                    self.restarts += 1;
                }
            }
        }
        self.zs.clear();
        self.round += 1;
    }

    fn suits(&self, space: &SearchSpace, generations: u64, pending: &[usize]) -> bool {
        let Some(pending) = only_batch(pending) else { return false };
        let n = space.genes().len();
        let asked = self.state.as_ref().map_or(0, |_| pending);
        let state_suits = |state: &State| {
            state.population == self.population(n)
                && state.idle <= generations
                && state.distribution.suits(n, generations)
                && (pending == 0 || pending == state.population)
        };
        self.round <= generations
            && u64::from(self.restarts) <= generations
            && self.zs.len() == asked * n
            && self.state.iter().all(state_suits)
    }
}
