//! (experiment) Elitist evolution with sparse steps.

use super::{Method, Start, ranking};
use crate::genome::{Genome, Score, Scored};
use crate::space::{SearchSpace, TreeSeed};
use crate::stream::Stream;
use serde::{Deserialize, Serialize};

/// Settings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EvolutionSettings {
    /// Random lists in the first generation.
    pub first: usize,
    /// Survivors.
    pub parents: usize,
    /// Children per generation.
    pub children: usize,
    /// first step in units of range
    pub step: f64,
    /// greed in parent choice
    pub greed: f64,
}

impl Default for EvolutionSettings {
    fn default() -> Self {
        Self { first: 200, parents: 10, children: 20, step: 0.15, greed: 2.0 }
    }
}

const OPS: usize = 5;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Birth {
    parent: usize,
    op: usize,
    genes: Vec<usize>,
}

/// Evolution.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Evolution {
    settings: EvolutionSettings,
    seed: u64,
    start: Start,
    round: u64,
    elite: Vec<Scored>,
    steps: Vec<f64>,
    credit: Vec<f64>,
    gene_credit: Vec<f64>,
    births: Vec<Birth>,
}

impl Evolution {
    /// New.
    #[must_use]
    pub fn new(settings: EvolutionSettings, seed: u64, start: Start) -> Self {
        Self {
            settings,
            seed,
            start,
            round: 0,
            elite: Vec::new(),
            steps: Vec::new(),
            credit: vec![1.0; OPS],
            gene_credit: Vec::new(),
            births: Vec::new(),
        }
    }

    fn mutate(&self, space: &SearchSpace, g: usize, values: &mut [f64], draws: &mut Stream) {
        let gene = &space.genes()[g];
        let old = values[gene.slot];
        if gene.is_choice() {
            let mut v = gene.random(draws);
            if v == old {
                v = gene.random(draws);
            }
            values[gene.slot] = v;
            return;
        }
        if gene.can_flip() && draws.chance(0.1) {
            values[gene.slot] = gene.clamp(-old);
            return;
        }
        let delta = self.steps[g] * (0.7 * draws.normal() + 0.05 * draws.cauchy().clamp(-20.0, 20.0));
        let mut v = gene.from_unit(gene.to_unit(old) + delta);
        if gene.kind.is_whole() && v == old {
            v = gene.clamp(old + delta.signum());
        }
        values[gene.slot] = v;
    }

    fn child(&self, space: &SearchSpace, draws: &mut Stream) -> (Genome, Birth) {
        let n = self.elite.len();
        let parent = (n as f64 * draws.unit().powf(self.settings.greed)) as usize;
        let mut genome = self.elite[parent].genome.clone();
        let mut read = Vec::new();
        space.read_genes(&genome.values, &mut read);
        if read.is_empty() {
            read.extend(0..space.genes().len());
        }
        let total: f64 = self.credit.iter().sum();
        let mut at = draws.unit() * total;
        let mut op = 0;
        while op + 1 < OPS && at >= self.credit[op] {
            at -= self.credit[op];
            op += 1;
        }
        let pick = |draws: &mut Stream| {
            let total: f64 = read.iter().map(|&g| self.gene_credit[g]).sum();
            let mut at = draws.unit() * total;
            for &g in &read {
                at -= self.gene_credit[g];
                if at < 0.0 {
                    return g;
                }
            }
            read[read.len() - 1]
        };
        let mut genes = Vec::new();
        match op {
            0 => {
                let g = pick(draws);
                self.mutate(space, g, &mut genome.values, draws);
                genes.push(g);
            }
            1 => {
                let k = 2 + (draws.unit().powi(3) * 6.0) as usize;
                for _ in 0..k {
                    let g = pick(draws);
                    self.mutate(space, g, &mut genome.values, draws);
                    genes.push(g);
                }
            }
            2 => {
                // crossover with another elite, sparse or half
                let other = &self.elite[draws.below(n)].genome;
                let share = if draws.chance(0.5) { 0.1 } else { 0.5 };
                for &g in &read {
                    if draws.chance(share) {
                        let slot = space.genes()[g].slot;
                        genome.values[slot] = other.values[slot];
                    }
                }
                let g = pick(draws);
                self.mutate(space, g, &mut genome.values, draws);
            }
            3 => {
                // differential step on a sparse subset
                let (a, b) = (&self.elite[draws.below(n)].genome, &self.elite[draws.below(n)].genome);
                let share = draws.unit().powi(2);
                let f = 0.2 + 0.8 * draws.unit();
                for &g in &read {
                    if draws.chance(share) {
                        let gene = &space.genes()[g];
                        let d = gene.to_unit(a.values[gene.slot]) - gene.to_unit(b.values[gene.slot]);
                        genome.values[gene.slot] = if gene.is_choice() {
                            a.values[gene.slot]
                        } else {
                            gene.from_unit(gene.to_unit(genome.values[gene.slot]) + f * d)
                        };
                    }
                }
                let g = pick(draws);
                self.mutate(space, g, &mut genome.values, draws);
            }
            _ => {
                // all genes a little
                let scale = 1.0 / (read.len() as f64).sqrt();
                for &g in &read {
                    let gene = &space.genes()[g];
                    if gene.is_choice() {
                        continue;
                    }
                    let u = gene.to_unit(genome.values[gene.slot]);
                    genome.values[gene.slot] = gene.from_unit(u + scale * self.steps[g] * draws.normal());
                }
            }
        }
        if space.tree_seed() == TreeSeed::Any && draws.chance(0.2) {
            genome.tree_seed = SearchSpace::random_seed(draws);
        }
        (genome, Birth { parent, op, genes })
    }
}

impl Method for Evolution {
    fn name(&self) -> &'static str {
        "evolution"
    }

    fn ask(&mut self, space: &SearchSpace, members: &mut Vec<Genome>) {
        self.births.clear();
        if self.elite.is_empty() {
            for list in self.start.lists() {
                members.push(space.individual(list, 1));
            }
            let n = if members.is_empty() { self.settings.first } else { self.settings.first / 4 };
            for m in 0..n.max(1) {
                members.push(space.random(&mut Stream::at(self.seed, 0, self.round, m as u32)));
            }
            return;
        }
        for m in 0..self.settings.children {
            let mut draws = Stream::at(self.seed, 1, self.round, m as u32);
            let (mut genome, mut birth) = self.child(space, &mut draws);
            for _ in 0..5 {
                if !self.elite.iter().any(|e| e.genome == genome) {
                    break;
                }
                (genome, birth) = self.child(space, &mut draws);
            }
            members.push(genome);
            self.births.push(birth);
        }
    }

    fn tell(&mut self, space: &SearchSpace, members: &[Genome], scores: &[Score]) {
        self.round += 1;
        let s = &self.settings;
        if self.births.is_empty() {
            self.steps = vec![s.step; space.genes().len()];
            self.gene_credit = vec![1.0; space.genes().len()];
            for i in ranking(scores).into_iter().take(s.parents) {
                if scores[i].cost < f64::INFINITY {
                    self.elite.push(Scored { genome: members[i].clone(), score: scores[i] });
                }
            }
            return;
        }
        for (birth, score) in self.births.iter().zip(scores) {
            let parent = self.elite[birth.parent].score.cost;
            let better = score.cost < parent;
            let top = score.cost < self.elite[0].score.cost;
            let reward = if top {
                1.0
            } else if better {
                0.2
            } else {
                0.0
            };
            self.credit[birth.op] = (self.credit[birth.op] * 0.98 + 0.02 * (10.0 * reward)).max(0.08);
            if birth.op <= 1 {
                for &g in &birth.genes {
                    let rate = if birth.op == 0 { 1.0 } else { 0.3 };
                    self.steps[g] *= if better { (0.5_f64 * rate).exp() } else { (-0.12 * rate).exp() };
                    self.steps[g] = self.steps[g].clamp(2e-3, 0.5);
                    self.gene_credit[g] =
                        (self.gene_credit[g] * (1.0 - 0.05 * rate) + 0.05 * rate * (4.0 * reward)).max(0.25);
                }
            }
        }
        let mut pool = std::mem::take(&mut self.elite);
        for (genome, score) in members.iter().zip(scores) {
            if score.cost < f64::INFINITY && !pool.iter().any(|e| e.score.cost == score.cost) {
                pool.push(Scored { genome: genome.clone(), score: *score });
            }
        }
        pool.sort_by(|a, b| a.score.cost.total_cmp(&b.score.cost));
        pool.truncate(s.parents);
        self.elite = pool;
    }
}
