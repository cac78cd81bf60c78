//! How children differ from their parents.

use crate::exact;
use crate::genome::{Genome, Scored};
use crate::space::{Gene, SearchSpace, TreeSeed};
use crate::stream::Stream;
use serde::{Deserialize, Serialize};

/// A way to make a child.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Move {
    /// One number by its step.
    One,
    /// Two to seven numbers by their steps.
    Few,
    /// Numbers of another parent, a tenth or half of all, and one step.
    Cross,
    /// Some numbers along the difference of two others, and one step (differential evolution).
    Difference,
    /// Every number a little.
    All,
    /// One number anywhere in its range, sometimes with a step of another.
    Anywhere,
    /// One or two numbers to zero.
    Nothing,
    /// Another tree of the same parameters, if any tree will do; otherwise as [`Move::One`].
    Seed,
}

impl Move {
    /// All moves, in the order of their numbers.
    pub const ALL: [Self; 8] = [
        Self::One,
        Self::Few,
        Self::Cross,
        Self::Difference,
        Self::All,
        Self::Anywhere,
        Self::Nothing,
        Self::Seed,
    ];
}

/// Where a child comes from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Birth {
    pub(super) by: Move,
    #[serde(with = "exact::number")]
    pub(super) parent_cost: f64,
    /// Genes that were changed by their steps.
    pub(super) genes: Vec<usize>,
}

/// Makes children of a population.
#[derive(Clone, Copy)]
pub(super) struct Breeder<'a> {
    pub(super) space: &'a SearchSpace,
    pub(super) population: &'a [Scored],
    pub(super) steps: &'a [f64],
    pub(super) promise: &'a [f64],
    pub(super) credit: &'a [f64],
    pub(super) greed: f64,
}

/// Chance that a step of a switch is a change of sign and not of magnitude.
const FLIP: f64 = 0.1;
/// A step is normal with a few far leaps: parts of the gene's step of a normal and of a Cauchy number.
const NEAR: f64 = 0.7;
const FAR: f64 = 0.05;
const FARTHEST: f64 = 20.0;

impl Breeder<'_> {
    pub(super) fn child(&self, draws: &mut Stream) -> (Genome, Birth) {
        let parent = &self.population[self.parent(draws)];
        let mut child = parent.genome.clone();
        let mut read = Vec::new();
        self.space.active_genes(&child.values, &mut read);
        let mut birth = Birth { by: self.choose(draws), parent_cost: parent.score.cost, genes: Vec::new() };
        if read.is_empty() || (birth.by == Move::Seed && self.space.tree_seed() == TreeSeed::Any) {
            birth.by = Move::Seed;
            child.tree_seed = SearchSpace::random_seed(draws);
            return (child, birth);
        }
        let other = |draws: &mut Stream| &self.population[draws.below(self.population.len())].genome;
        match birth.by {
            Move::One | Move::Seed => {
                birth.by = Move::One;
                birth.genes.push(self.step(&read, &mut child, draws));
            }
            Move::Few => {
                for _ in 0..2 + (6.0 * draws.unit().powi(3)) as usize {
                    birth.genes.push(self.step(&read, &mut child, draws));
                }
            }
            Move::Cross => {
                let from = other(draws);
                let share = if draws.chance(0.5) { 0.1 } else { 0.5 };
                for gene in read.iter().map(|&g| self.gene(g)) {
                    if draws.chance(share) {
                        gene.set(&mut child, gene.of(from));
                    }
                }
                self.step(&read, &mut child, draws);
            }
            Move::Difference => {
                let (to, from) = (other(draws), other(draws));
                let share = draws.unit().powi(2);
                let factor = 0.2 + 0.8 * draws.unit();
                for gene in read.iter().map(|&g| self.gene(g)) {
                    if draws.chance(share) {
                        along(gene, &mut child, to, from, factor);
                    }
                }
                self.step(&read, &mut child, draws);
            }
            Move::All => {
                let scale = 1.0 / (read.len() as f64).sqrt();
                for &g in read.iter().filter(|&&g| !self.gene(g).is_choice()) {
                    let gene = self.gene(g);
                    let unit = gene.to_unit(gene.of(&child)) + scale * self.steps[g] * draws.normal();
                    gene.set(&mut child, gene.from_unit(unit));
                }
            }
            Move::Anywhere => {
                let gene = self.gene(read[draws.below(read.len())]);
                let value = gene.random(draws);
                gene.set(&mut child, value);
                if draws.chance(0.3) {
                    self.step(&read, &mut child, draws);
                }
            }
            Move::Nothing => {
                for _ in 0..1 + draws.below(2) {
                    let candidate = |&g: &usize| {
                        let gene = self.gene(g);
                        let neutral = gene.neutral().filter(|&neutral| gene.of(&child) != neutral)?;
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
        (child, birth)
    }

    fn gene(&self, number: usize) -> &Gene {
        &self.space.genes()[number]
    }

    /// A parent, the better the likelier.
    fn parent(&self, draws: &mut Stream) -> usize {
        (self.population.len() as f64 * draws.unit().powf(self.greed)) as usize
    }

    /// A move, as likely as its credit.
    fn choose(&self, draws: &mut Stream) -> Move {
        Move::ALL[weighted(self.credit.iter().copied(), draws)]
    }

    /// Changes one gene of those `read` by its step; returns which.
    fn step(&self, read: &[usize], child: &mut Genome, draws: &mut Stream) -> usize {
        let number = read[weighted(read.iter().map(|&g| self.promise[g]), draws)];
        let gene = self.gene(number);
        let old = gene.of(child);
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
        number
    }
}

/// Moves `gene` of `child` by `factor` of the way from `from` to `to`; a choice becomes that of `to`.
fn along(gene: &Gene, child: &mut Genome, to: &Genome, from: &Genome, factor: f64) {
    let value = if gene.is_choice() {
        gene.of(to)
    } else {
        let difference = gene.to_unit(gene.of(to)) - gene.to_unit(gene.of(from));
        gene.from_unit(gene.to_unit(gene.of(child)) + factor * difference)
    };
    gene.set(child, value);
}

/// The number of one of `weights`, as likely as its weight.
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
