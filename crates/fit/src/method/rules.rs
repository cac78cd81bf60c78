//! A search over structures and their numbers: genetic programming, in islands.
//!
//! The family decides how a structure is changed ([`pleach_tree::Variation`]); this is the search around it.
//! Individuals are a structure and its parameter list. Islands of some structures each keep their best (an elitist
//! population, as the default optimiser's); a child is a variation of one parent, or of two of the same island,
//! seldom of another. An island that no longer improves becomes a copy of the best one or starts again from random
//! structures, alternately, so that a short search ends with more trials around its best structure and a long one
//! tries others.

use super::{Method, MethodSettings, Start, is_individual, only_batch};
use crate::problem::Objective;
use crate::problem::{Genome, Score, Scored};
use crate::space::Stream;
use crate::space::{SearchSpace, TreeSeed};
use pleach_tree::math;
use pleach_tree::{Key, Variation};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Settings of [`Rules`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RulesSettings {
    /// Populations that evolve separately.
    pub islands: usize,
    /// Individuals of an island that survive a generation.
    pub parents: usize,
    /// Children of an island in a generation.
    pub children: usize,
    /// Random structures at the beginning of an island.
    pub first: usize,
    /// Generations without a gain of two thousandths after which an island ends.
    pub patience: u64,
    /// Cost of one word or sign of a structure, so that short ones win where others are no better.
    pub price: f64,
}

impl RulesSettings {
    /// The default objective of a search over rules. Chosen by experiment: with [`Objective::Balance`] grammars look
    /// like their goals and lie worse on them than an ellipse.
    pub const OBJECTIVE: Objective = Objective::Overlap;
}

impl Default for RulesSettings {
    fn default() -> Self {
        Self { islands: 5, parents: 10, children: 10, first: 120, patience: 50, price: 1.5e-4 }
    }
}

/// One population, best first.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Island {
    population: Vec<Scored>,
    /// The cost that has to be beaten for an island not to stagnate, and generations since it was.
    mark: f64,
    stagnation: u64,
    /// How often the island has ended.
    ends: u64,
}

/// The populations.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rules {
    settings: RulesSettings,
    seed: u64,
    start: Start,
    round: u64,
    islands: Vec<Island>,
}

/// Purposes of the draws.
const FIRST: u32 = 0;
const CHILD: u32 = 1;
/// Part of the cost that counts as progress.
const GAIN: f64 = 2e-3;
/// How much better individuals are preferred as parents: an exponent; 1 draws all of them equally often.
const GREED: f64 = 1.6;
/// Chance that a child has two parents, and that the second is of another island.
const CROSS: f64 = 0.25;
const ABROAD: f64 = 0.15;
/// Chance that a declared number is changed and not the structure, and its step as a part of the range.
const GENE: f64 = 0.4;
const STEP: f64 = 0.12;

impl MethodSettings for RulesSettings {
    type Method = Rules;

    fn begin(&self, seed: u64, start: Start) -> Rules {
        let islands = vec![Island::default(); self.islands.max(1)];
        Rules { settings: self.clone(), seed, start, round: 0, islands }
    }

    fn has_begun(&self, method: &Rules, seed: u64, start: &Start) -> bool {
        (&method.settings, method.seed, &method.start) == (self, seed, start)
    }
}

impl Rules {
    /// The individuals that an island begins with.
    fn first(&self, island: usize, member: usize, space: &SearchSpace, variation: &dyn Variation) -> Genome {
        let mut draws =
            Stream::at(self.seed, FIRST, self.round, (island * self.settings.first + member) as u32);
        let lists = self.start.lists();
        let values = if lists.is_empty() { space.base() } else { &lists[member % lists.len()] };
        let mut genome = space.individual(values, SearchSpace::random_seed(&mut draws));
        let directions = space.directions();
        if directions > 1 {
            space.turn(&mut genome, member % directions, &mut draws);
        }
        let structure = if lists.is_empty() {
            variation.fresh(Key::root(draws.bits()))
        } else {
            // The start itself, and variations of it by one to three changes.
            let changes = if member < lists.len() { 0 } else { 1 + draws.below(3) };
            (0..changes).fold(variation.own(), |text, _| variation.vary(&text, Key::root(draws.bits())))
        };
        genome.structure = Some(structure);
        genome
    }

    fn child(
        &self,
        island: usize,
        space: &SearchSpace,
        variation: &dyn Variation,
        draws: &mut Stream,
    ) -> Genome {
        let population = &self.islands[island].population;
        let parent = &population[(population.len() as f64 * math::pow(draws.unit(), GREED)) as usize].genome;
        let mut child = parent.clone();
        let structure = parent.structure.clone().unwrap_or_default();
        if draws.chance(CROSS) {
            let others = if draws.chance(ABROAD) {
                &self.islands[draws.below(self.islands.len())].population
            } else {
                population
            };
            let other = &others.get(draws.below(others.len().max(1))).unwrap_or(&population[0]).genome;
            let theirs = other.structure.as_deref().unwrap_or_default();
            child.structure = Some(variation.cross(&structure, theirs, Key::root(draws.bits())));
        } else {
            child.structure = Some(structure);
        }
        // Sizes follow the goal's height.
        let sizes: Vec<_> = space.params().sizes().collect();
        let is_size = |gene: &&crate::Gene| gene.slot().is_some_and(|slot| sizes.contains(&slot));
        let genes: Vec<_> = space.genes().iter().filter(|gene| !is_size(gene)).collect();
        let steps = if genes.is_empty() || !draws.chance(GENE) { 0 } else { 1 + draws.below(3) };
        for _ in 0..steps {
            let gene = genes[draws.below(genes.len())];
            let value = if gene.is_choice() || gene.is_azimuth() && draws.chance(0.2) {
                gene.random(draws)
            } else {
                gene.from_unit(gene.to_unit(gene.get(&child)) + STEP * draws.normal())
            };
            gene.set(&mut child, value);
        }
        if space.tree_seed() == TreeSeed::Any && draws.chance(0.1) {
            child.tree_seed = SearchSpace::random_seed(draws);
        }
        for _ in 0..3 {
            if child != *parent {
                break;
            }
            let text = child.structure.as_deref().unwrap_or_default();
            child.structure = Some(variation.vary(text, Key::root(draws.bits())));
        }
        child
    }

    /// How many individuals each island has asked for in this generation.
    fn asked(&self) -> impl Iterator<Item = usize> {
        let RulesSettings { first, children, .. } = self.settings;
        self.islands.iter().map(
            move |island| {
                if island.population.is_empty() { first.max(2) } else { children.max(1) }
            },
        )
    }

    /// Ends islands that no longer improve.
    fn end_islands(&mut self) {
        let cost = |island: &Island| island.population.first().map_or(f64::INFINITY, |best| best.score.cost);
        let costs = self.islands.iter().map(cost);
        let Some((best, _)) = costs.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)) else { return };
        let population = self.islands[best].population.clone();
        for (number, island) in self.islands.iter_mut().enumerate() {
            if number == best || island.stagnation < self.settings.patience {
                continue;
            }
            let population = if island.ends % 2 == 0 { population.clone() } else { Vec::new() };
            *island = Island { population, mark: f64::INFINITY, stagnation: 0, ends: island.ends + 1 };
        }
    }
}

impl Island {
    fn settle(&mut self, newborn: impl Iterator<Item = Scored>, most: usize) {
        if self.population.is_empty() {
            self.mark = f64::INFINITY;
        }
        self.population.extend(newborn.filter(|one| one.score.cost < f64::INFINITY));
        self.population.sort_by(|a, b| a.score.cost.total_cmp(&b.score.cost));
        self.population.dedup_by(|a, b| a.score.cost == b.score.cost);
        self.population.truncate(most.max(2));
        let best = self.population.first().map_or(f64::INFINITY, |best| best.score.cost);
        if best < self.mark * (1.0 - GAIN) || self.mark == f64::INFINITY {
            self.mark = best;
            self.stagnation = 0;
        } else {
            self.stagnation += 1;
        }
    }
}

impl Method for Rules {
    fn name(&self) -> &'static str {
        "rules"
    }

    fn ask(&mut self, space: &SearchSpace, members: &mut Vec<Genome>) {
        let places: Vec<(usize, usize)> = self
            .asked()
            .enumerate()
            .flat_map(|(island, count)| (0..count).map(move |m| (island, m)))
            .collect();
        let make = |&(island, member): &(usize, usize)| {
            // `fit` refuses families without variation.
            let Some(variation) = space.variation() else { return space.individual(space.base(), 0) };
            if self.islands[island].population.is_empty() {
                return self.first(island, member, space, variation);
            }
            let number = (island * self.settings.children.max(1) + member) as u32;
            self.child(island, space, variation, &mut Stream::at(self.seed, CHILD, self.round, number))
        };
        members.par_extend(places.par_iter().map(make));
    }

    fn tell(&mut self, _: &SearchSpace, members: &[Genome], scores: &[Score]) {
        self.round += 1;
        let counts: Vec<usize> = self.asked().collect();
        let mut newborn = members
            .iter()
            .zip(scores)
            .map(|(genome, score)| Scored { genome: genome.clone(), score: *score });
        for (island, count) in self.islands.iter_mut().zip(counts) {
            island.settle(newborn.by_ref().take(count), self.settings.parents);
        }
        self.end_islands();
    }

    fn suits(&self, space: &SearchSpace, generations: u64, pending: &[usize]) -> bool {
        let Some(pending) = only_batch(pending) else { return false };
        let population = || self.islands.iter().flat_map(|island| &island.population);
        self.round <= generations
            && self.islands.len() == self.settings.islands.max(1)
            && self.islands.iter().all(|island| island.population.len() <= self.settings.parents.max(2))
            && self.islands.iter().all(|island| island.stagnation.max(island.ends) <= generations)
            && population().all(|one| is_individual(&one.genome, space) && space.has_structure(&one.genome))
            && (pending == 0 || pending == self.asked().sum::<usize>())
    }
}
