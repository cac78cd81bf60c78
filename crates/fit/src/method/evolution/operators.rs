//! How children differ from their parents.

use crate::problem::{Genome, Scored};
use crate::space::Stream;
use crate::space::{Gene, Place, SearchSpace, TreeSeed};
use pleach_tree::math;
use serde::{Deserialize, Serialize};

/// A way to vary a parent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Operator {
    /// One number by its step.
    StepOne,
    /// Two to seven numbers by their steps.
    StepFew,
    /// Numbers of another parent, a tenth or half of all, and one step.
    Cross,
    /// Some numbers along the difference of two others, and one step (differential evolution).
    Difference,
    /// Every number a little.
    Jitter,
    /// One number anywhere in its range, sometimes with a step of another.
    Resample,
    /// One or two numbers to zero.
    Zero,
    /// Another tree seed with the same parameters, if the seed is free; otherwise as [`Operator::StepOne`].
    Seed,
    /// The same tree from elsewhere: some nuisances by their steps. There are few of them beside the numbers of a
    /// tree, so that other operators seldom move them. Not tried without nuisances.
    Place,
}

impl Operator {
    /// All operators, in the order of their numbers.
    pub(super) const ALL: [Self; 9] = [
        Self::StepOne,
        Self::StepFew,
        Self::Cross,
        Self::Difference,
        Self::Jitter,
        Self::Resample,
        Self::Zero,
        Self::Seed,
        Self::Place,
    ];
}

/// Where a child comes from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Offspring {
    pub(super) by: Operator,
    pub(super) parent_cost: f64,
    /// Genes that were changed by their steps.
    pub(super) genes: Vec<usize>,
}

/// Makes children of a population.
#[derive(Clone, Copy)]
pub(super) struct Variation<'a> {
    pub(super) space: &'a SearchSpace,
    pub(super) population: &'a [Scored],
    pub(super) steps: &'a [f64],
    pub(super) weight: &'a [f64],
    pub(super) operator_credit: &'a [f64],
    pub(super) selection_pressure: f64,
}

/// Chance that a step of a switch is a change of sign and not of magnitude.
const FLIP: f64 = 0.1;
/// A step is normal with a few long jumps: weights of a normal and of a Cauchy number, in steps of the gene.
const NEAR: f64 = 0.7;
const FAR: f64 = 0.05;
const FARTHEST: f64 = 20.0;

impl Variation<'_> {
    pub(super) fn child(&self, draws: &mut Stream) -> (Genome, Offspring) {
        let parent = &self.population[self.parent(draws)];
        let mut child = parent.genome.clone();
        let mut read = Vec::new();
        self.space.active_genes(&child.values, &mut read);
        let places: Vec<usize> =
            read.iter().copied().filter(|&g| matches!(self.gene(g).place, Place::Nuisance { .. })).collect();
        let by = self.choose(!places.is_empty(), draws);
        let mut offspring = Offspring { by, parent_cost: parent.score.cost, genes: Vec::new() };
        if read.is_empty() || (offspring.by == Operator::Seed && self.space.tree_seed() == TreeSeed::Any) {
            offspring.by = Operator::Seed;
            child.tree_seed = SearchSpace::random_seed(draws);
            return (child, offspring);
        }
        match offspring.by {
            Operator::StepOne | Operator::Seed => {
                offspring.by = Operator::StepOne;
                offspring.genes.push(self.step(&read, &mut child, draws));
            }
            Operator::StepFew => {
                for _ in 0..2 + (6.0 * math::powi(draws.unit(), 3)) as usize {
                    offspring.genes.push(self.step(&read, &mut child, draws));
                }
            }
            Operator::Place => {
                let sure = places[draws.below(places.len())];
                for g in places {
                    if g == sure || draws.chance(0.5) {
                        self.move_by_step(g, &mut child, draws);
                        offspring.genes.push(g);
                    }
                }
            }
            Operator::Cross => self.cross(&read, &mut child, draws),
            Operator::Difference => self.follow_difference(&read, &mut child, draws),
            Operator::Jitter => {
                let scale = 1.0 / (read.len() as f64).sqrt();
                for &g in read.iter().filter(|&&g| !self.gene(g).is_choice()) {
                    let gene = self.gene(g);
                    let unit = gene.to_unit(gene.get(&child)) + scale * self.steps[g] * draws.normal();
                    gene.set(&mut child, gene.from_unit(unit));
                }
            }
            Operator::Resample => {
                let gene = self.gene(read[draws.below(read.len())]);
                let value = gene.random(draws);
                gene.set(&mut child, value);
                if draws.chance(0.3) {
                    self.step(&read, &mut child, draws);
                }
            }
            Operator::Zero => {
                for _ in 0..1 + draws.below(2) {
                    let candidate = |&g: &usize| {
                        let gene = self.gene(g);
                        let neutral = gene.neutral().filter(|&neutral| gene.get(&child) != neutral)?;
                        Some((gene, neutral))
                    };
                    let candidates: Vec<(&Gene, f64)> = read.iter().filter_map(candidate).collect();
                    if !candidates.is_empty() {
                        let (gene, neutral) = candidates[draws.below(candidates.len())];
                        gene.set(&mut child, neutral);
                    }
                }
            }
        }
        (child, offspring)
    }

    /// Takes numbers of another parent, and one step.
    fn cross(&self, read: &[usize], child: &mut Genome, draws: &mut Stream) {
        let from = self.other(draws);
        let share = if draws.chance(0.5) { 0.1 } else { 0.5 };
        for gene in read.iter().map(|&g| self.gene(g)) {
            if draws.chance(share) {
                gene.set(child, gene.get(from));
            }
        }
        self.step(read, child, draws);
    }

    /// Moves numbers along the difference of two others, and one step.
    fn follow_difference(&self, read: &[usize], child: &mut Genome, draws: &mut Stream) {
        let (to, from) = (self.other(draws), self.other(draws));
        let share = math::powi(draws.unit(), 2);
        let factor = 0.2 + 0.8 * draws.unit();
        for gene in read.iter().map(|&g| self.gene(g)) {
            if draws.chance(share) {
                along(gene, child, to, from, factor);
            }
        }
        self.step(read, child, draws);
    }

    /// Any of the population.
    fn other(&self, draws: &mut Stream) -> &Genome {
        &self.population[draws.below(self.population.len())].genome
    }

    fn gene(&self, number: usize) -> &Gene {
        &self.space.genes()[number]
    }

    /// A parent: better ones are more probable.
    fn parent(&self, draws: &mut Stream) -> usize {
        (self.population.len() as f64 * math::pow(draws.unit(), self.selection_pressure)) as usize
    }

    /// An operator, with a probability proportional to its credit.
    fn choose(&self, has_places: bool, draws: &mut Stream) -> Operator {
        let tried = |by: &Operator| has_places || *by != Operator::Place;
        let credits = Operator::ALL.iter().zip(self.operator_credit).filter(|(by, _)| tried(by));
        Operator::ALL[weighted(credits.map(|(_, credit)| *credit), draws)]
    }

    /// Changes one gene of those `read` by its step; returns which.
    fn step(&self, read: &[usize], child: &mut Genome, draws: &mut Stream) -> usize {
        let number = read[weighted(read.iter().map(|&g| self.weight[g]), draws)];
        self.move_by_step(number, child, draws);
        number
    }

    /// Changes a gene by its step.
    fn move_by_step(&self, number: usize, child: &mut Genome, draws: &mut Stream) {
        let gene = self.gene(number);
        let old = gene.get(child);
        let value = if gene.is_choice() {
            // Any of the others.
            let next = (old - gene.low + 1.0 + draws.below(gene.count() as usize - 1) as f64) % gene.count();
            gene.low + next
        } else if gene.can_flip() && draws.chance(FLIP) {
            gene.clamp(-old)
        } else {
            let leap = FAR * draws.cauchy().clamp(-FARTHEST, FARTHEST);
            let change = self.steps[number] * (NEAR * draws.normal() + leap);
            let new = gene.from_unit(gene.to_unit(old) + change);
            if gene.kind.is_whole() && new == old { gene.clamp(old + change.signum()) } else { new }
        };
        gene.set(child, value);
    }
}

/// Moves `gene` of `child` by `factor` of the way from `from` to `to`; a choice becomes that of `to`.
fn along(gene: &Gene, child: &mut Genome, to: &Genome, from: &Genome, factor: f64) {
    let value = if gene.is_choice() {
        gene.get(to)
    } else {
        let difference = gene.to_unit(gene.get(to)) - gene.to_unit(gene.get(from));
        gene.from_unit(gene.to_unit(gene.get(child)) + factor * difference)
    };
    gene.set(child, value);
}

/// An index into `weights`, with a probability proportional to its weight.
fn weighted(weights: impl Iterator<Item = f64> + Clone, draws: &mut Stream) -> usize {
    let mut left = draws.unit() * weights.clone().sum::<f64>();
    let mut last = 0;
    for (i, weight) in weights.enumerate() {
        last = i;
        left -= weight;
        if left < 0.0 {
            break;
        }
    }
    last
}
