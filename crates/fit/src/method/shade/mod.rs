//! Differential evolution with learned factors: SHADE (Tanabe and Fukunaga 2013).
//!
//! Every individual is the target of one trial per generation. The trial takes part of its numbers, each with the
//! chance CR and one for certain, from
//!
//! ```text
//! x + F (b − x) + F (r − s)
//! ```
//!
//! where x is the target, b one of the best, r another individual, and s another or one of the archive, which keeps
//! targets that were beaten; all in the units of [`crate::Gene::to_unit`]. It takes the target's place if it is no
//! worse. F and CR are drawn around values that were successful (§III of the paper, [`memory`]). Beyond the range a
//! number goes half the way to its end.
//!
//! The paper has real numbers only; for trees:
//!
//! - whole numbers are rounded; a choice is that of b or of r, with equal chances;
//! - where the tree seed is free, the trial keeps the target's, save in a share of [`ShadeSettings::reseed`] of
//!   trials: half of those take that of b, half a new one;
//! - the population is the best of many random lists, or the start's lists with variations of them: a fifth of the
//!   numbers moved by some tenth of their range;
//! - individuals count as they were drawn: resized to the goal's height or with variations of size set to zero
//!   ([`crate::Search`]), so that differences are those of trees that were drawn;
//! - a population in which nothing has been replaced by anything better for
//!   [`ShadeSettings::patience`] generations restarts from random lists.

mod memory;

use super::first::{first, given};
use super::{Method, MethodSettings, Start, is_individual, only_batch, ranking};
use crate::problem::{Genome, Score, Scored};
use crate::space::Stream;
use crate::space::{SearchSpace, TreeSeed};
use memory::{History, Success};
use serde::{Deserialize, Serialize};

/// Settings of [`Shade`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ShadeSettings {
    /// Individuals, at least 4; the paper's 100 are too many for a thousand evaluations.
    pub population: usize,
    /// Random lists at a beginning, of which the best are the population.
    pub first: usize,
    /// Largest probability that a number of a random list that may be zero is set to zero.
    pub sparsity: f64,
    /// Pairs of factors and rates that are remembered: H of the paper.
    pub history: usize,
    /// Largest part of the population that counts as the best; each trial draws its own.
    pub best: f64,
    /// Beaten targets that are kept, in populations.
    pub archive: f64,
    /// Share of trials with another tree seed than the target's, if the seed is free.
    pub reseed: f64,
    /// Generations without a success after which a population restarts.
    pub patience: u64,
}

impl Default for ShadeSettings {
    fn default() -> Self {
        Self {
            population: 20,
            first: 100,
            sparsity: 0.8,
            history: 10,
            best: 0.2,
            archive: 1.0,
            reseed: 0.1,
            patience: 50,
        }
    }
}

/// The population, the archive and the history.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Shade {
    settings: ShadeSettings,
    seed: u64,
    start: Start,
    round: u64,
    population: Vec<Scored>,
    archive: Vec<Genome>,
    history: History,
    /// Factor and rate of each trial that is being evaluated; empty while lists are.
    trials: Vec<Trial>,
    idle: u64,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Trial {
    factor: f64,
    rate: f64,
}

/// Purposes of the draws.
const FIRST: u32 = 0;
const TRIAL: u32 = 1;
const ARCHIVE: u32 = 2;
const VARIED: u32 = 3;

/// The least population of which a target, r and s can be drawn.
const MIN: usize = 4;
/// Variations of the start's lists: share of numbers that are moved, and how far, in units.
const VARIED_SHARE: f64 = 0.2;
const VARIED_STEP: f64 = 0.1;

impl Shade {
    /// Starts from the lists of `start` and variations of them, or from random lists.
    #[must_use]
    pub fn new(settings: ShadeSettings, seed: u64, start: Start) -> Self {
        let history = History::new(settings.history);
        Self {
            settings,
            seed,
            start,
            round: 0,
            population: Vec::new(),
            archive: Vec::new(),
            history,
            trials: Vec::new(),
            idle: 0,
        }
    }

    fn begin(&self, space: &SearchSpace, members: &mut Vec<Genome>) {
        let draws = |member| Stream::at(self.seed, FIRST, self.round, member);
        let lists = self.start.lists();
        if self.round > 0 || lists.is_empty() {
            let count = self.settings.first.max(MIN);
            return first(space, &[], count, self.settings.sparsity, draws, members);
        }
        given(space, lists, draws, members);
        let given = members.len();
        for member in given..self.settings.population.max(MIN) {
            let mut draws = Stream::at(self.seed, VARIED, self.round, member as u32);
            let mut genome = members[member % given].clone();
            for gene in space.genes() {
                if draws.chance(VARIED_SHARE) {
                    let step = VARIED_STEP * draws.normal();
                    let value = match gene.is_choice() {
                        true => gene.random(&mut draws),
                        false => gene.from_unit(gene.to_unit(gene.get(&genome)) + step),
                    };
                    gene.set(&mut genome, value);
                }
            }
            members.push(genome);
        }
    }

    /// A trial for the target of number `target`; `order` are the numbers from best to worst.
    fn trial(
        &self,
        space: &SearchSpace,
        order: &[usize],
        target: usize,
        draws: &mut Stream,
    ) -> (Genome, Trial) {
        let (factor, rate) = self.history.draw(draws);
        let n = order.len();
        // At least the two best, so that not all follow one.
        let least = 2.0 / n as f64;
        let share = least + (self.settings.best - least).max(0.0) * draws.unit();
        let best = &self.population[order[draws.below(((share * n as f64) as usize).clamp(1, n))]].genome;
        let r = other(n, draws, |i| i == target);
        let s = other(n + self.archive.len(), draws, |i| i == target || i == r);
        let to = &self.population[r].genome;
        let from = if s < n { &self.population[s].genome } else { &self.archive[s - n] };

        let mut child = self.population[target].genome.clone();
        let genes = space.genes();
        let certain = if genes.is_empty() { 0 } else { draws.below(genes.len()) };
        for (number, gene) in genes.iter().enumerate() {
            if number != certain && !draws.chance(rate) {
                continue;
            }
            let value = if gene.is_choice() {
                gene.get(if draws.chance(0.5) { best } else { to })
            } else {
                let unit = |genome: &Genome| gene.to_unit(gene.get(genome));
                let old = unit(&child);
                let new = old + factor * (unit(best) - old) + factor * (unit(to) - unit(from));
                gene.from_unit(if gene.is_periodic() {
                    new
                } else if new < 0.0 {
                    0.5 * old
                } else if new > 1.0 {
                    f64::midpoint(1.0, old)
                } else {
                    new
                })
            };
            gene.set(&mut child, value);
        }
        if space.tree_seed() == TreeSeed::Any && (genes.is_empty() || draws.chance(self.settings.reseed)) {
            child.tree_seed =
                if draws.chance(0.5) { best.tree_seed } else { SearchSpace::random_seed(draws) };
        }
        (child, Trial { factor, rate })
    }

    /// Puts trials that are no worse in their targets' places.
    fn select(&mut self, members: &[Genome], scores: &[Score]) {
        let mut successes = Vec::new();
        let mut draws = Stream::at(self.seed, ARCHIVE, self.round, 0);
        let room = (self.settings.archive * self.population.len() as f64) as usize;
        for (target, (genome, score)) in members.iter().zip(scores).enumerate() {
            let old = &mut self.population[target];
            let gain = old.score.cost - score.cost;
            if gain.is_nan() || gain < 0.0 {
                continue;
            }
            let beaten = std::mem::replace(old, Scored { genome: genome.clone(), score: *score });
            if gain > 0.0 {
                let Trial { factor, rate } = self.trials[target];
                successes.push(Success { factor, rate, gain });
                if self.archive.len() < room {
                    self.archive.push(beaten.genome);
                } else if room > 0 {
                    let place = draws.below(room);
                    self.archive[place] = beaten.genome;
                }
            }
        }
        self.history.learn(&successes);
        self.idle = if successes.is_empty() { self.idle + 1 } else { 0 };
        if self.idle >= self.settings.patience.max(1) {
            self.population.clear();
            self.archive.clear();
            self.history = History::new(self.settings.history);
            self.idle = 0;
        }
    }
}

/// A number below `count` for which `taken` does not hold; some must be left.
fn other(count: usize, draws: &mut Stream, taken: impl Fn(usize) -> bool) -> usize {
    loop {
        let number = draws.below(count);
        if !taken(number) {
            return number;
        }
    }
}

impl MethodSettings for ShadeSettings {
    type Method = Shade;

    fn begin(&self, seed: u64, start: Start) -> Shade {
        Shade::new(self.clone(), seed, start)
    }

    fn has_begun(&self, method: &Shade, seed: u64, start: &Start) -> bool {
        (&method.settings, method.seed, &method.start) == (self, seed, start)
    }
}

impl Method for Shade {
    fn name(&self) -> &'static str {
        "de"
    }

    fn ask(&mut self, space: &SearchSpace, members: &mut Vec<Genome>) {
        self.trials.clear();
        if self.population.len() < MIN {
            return self.begin(space, members);
        }
        let scores: Vec<Score> = self.population.iter().map(|scored| scored.score).collect();
        let order = ranking(&scores);
        for target in 0..self.population.len() {
            let mut draws = Stream::at(self.seed, TRIAL, self.round, target as u32);
            let (genome, trial) = self.trial(space, &order, target, &mut draws);
            members.push(genome);
            self.trials.push(trial);
        }
    }

    fn tell(&mut self, _: &SearchSpace, members: &[Genome], scores: &[Score]) {
        if self.trials.is_empty() {
            let grown = members.iter().zip(scores).filter(|(_, score)| score.cost < f64::INFINITY);
            let grown = grown.map(|(genome, score)| Scored { genome: genome.clone(), score: *score });
            self.population.extend(grown);
            self.population.sort_by(|a, b| a.score.cost.total_cmp(&b.score.cost));
            self.population.truncate(self.settings.population.max(MIN));
        } else {
            self.select(members, scores);
        }
        self.round += 1;
    }

    fn suits(&self, space: &SearchSpace, generations: u64, pending: &[usize]) -> bool {
        let Some(pending) = only_batch(pending) else { return false };
        let population = self.population.iter().map(|scored| &scored.genome);
        let most = self.settings.population.max(MIN);
        let room = (self.settings.archive * self.population.len() as f64) as usize;
        let is_asked = if self.trials.is_empty() { self.population.len() < MIN } else { true };
        self.round <= generations
            && self.idle < self.settings.patience.max(1)
            && self.population.len() <= most
            && self.archive.len() <= room
            && population.chain(&self.archive).all(|genome| is_individual(genome, space))
            && self.history.suits(self.settings.history)
            // Trials with scores stay until the next are asked for.
            && (self.trials.is_empty() || pending == 0 || pending == self.trials.len())
            && (self.trials.is_empty() || pending == 0 || pending == self.population.len())
            && (pending == 0 || is_asked)
    }
}
