//! The default optimiser: an elitist population with sparse steps, in islands that restart.
//!
//! A silhouette depends on some sixty numbers, most of them little, a few of them like a needle: a
//! hundredth of the range of `rotate` turns every branch of an acer to another side. So
//!
//! - most children change one number or a few. Each number has its own step, which grows with success
//!   and shrinks without (the one-fifth rule, Rechenberg 1973, number by number), and is chosen the
//!   more often the more it has helped;
//! - other children cross two parents, go along the difference of two others (Storn and Price 1997),
//!   move everything a little, draw a number again from its whole range, or set one to zero. Each operator is
//!   chosen the more often the more it has gained (`operators.rs`);
//! - reals, whole numbers, switches and choices are changed each in its own way, and numbers that the
//!   tree does not depend on ([`pleach_tree::Generator::is_active`]) are left alone;
//! - the population begins with the best of many random lists, in which numbers that may be
//!   zero often are: variations, bends and splits are absent from most trees;
//! - a population that has not improved for a while ends its *island*. Its best joins an archive of
//!   elites, and the next island begins with new random lists; after a few islands the elites
//!   themselves meet in one.
//!
//! Nothing depends on the budget: longer is never worse, and a run may be resumed with more.

mod island;
mod operators;
mod settings;

pub use settings::EvolutionSettings;

use super::first::first;
use super::{Method, MethodSettings, Start, is_individual};
use crate::problem::{Genome, Score, Scored};
use crate::space::{SearchSpace, Stream};
use island::Island;
use serde::{Deserialize, Serialize};

/// The population, and what has been learned about operators and numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Evolution {
    settings: EvolutionSettings,
    seed: u64,
    start: Start,
    /// Batches that have been told.
    batches: u64,
    islands_begun: u64,
    island: Island,
    /// Batches of children of the island that have been told.
    island_batches: u64,
    /// Whether the batch that was told last ended a generation.
    ended: bool,
    /// The best of each island since the elites last met, theirs included.
    elites: Vec<Scored>,
}

/// Purposes of the draws.
const FIRST: u32 = 0;
const CHILD: u32 = 1;

/// Staleness grows by one per this many batches of an island: at its beginning every score teaches much, and
/// a child that is made a moment later is better for it.
const BATCHES_PER_STALENESS: u64 = 40;

impl Evolution {
    /// Starts from the lists of `start` and variations of them, or from random lists.
    #[must_use]
    pub fn new(settings: EvolutionSettings, seed: u64, start: Start) -> Self {
        Self {
            settings,
            seed,
            start,
            batches: 0,
            islands_begun: 0,
            island: Island::default(),
            island_batches: 0,
            ended: false,
            elites: Vec::new(),
        }
    }

    /// The individuals that an island begins with.
    fn begin(&self, space: &SearchSpace, members: &mut Vec<Genome>) {
        let lists = if self.islands_begun == 0 { self.start.lists() } else { &[] };
        let draws = |member| Stream::at(self.seed, FIRST, self.batches, member);
        first(space, lists, self.settings.first.max(2), self.settings.sparsity, draws, members);
    }

    /// Whether the island has not improved for long.
    fn has_stagnated(&self) -> bool {
        let patience = (self.settings.patience * self.settings.parents) as u64;
        self.island.stagnation() > patience
    }

    fn batches_per_generation(&self) -> u64 {
        self.settings.children.max(1).div_ceil(self.settings.batch.max(1)) as u64
    }

    /// Size of batch `number` of an island: the last of a generation may be smaller than the others.
    fn batch_size(&self, number: u64) -> usize {
        let before = (number % self.batches_per_generation()) as usize * self.settings.batch.max(1);
        self.settings.batch.max(1).min(self.settings.children.max(1) - before)
    }

    /// Ends the island and prepares the next.
    fn start_next_island(&mut self) {
        self.elites.extend(self.island.best().cloned());
        self.island = Island::default();
        self.island_batches = 0;
        self.ended = true;
        self.islands_begun += 1;
        if self.elites.len() > self.settings.islands.max(1) {
            self.island.settle(std::mem::take(&mut self.elites), usize::MAX);
        }
    }
}

impl MethodSettings for EvolutionSettings {
    type Method = Evolution;

    fn begin(&self, seed: u64, start: Start) -> Evolution {
        Evolution::new(self.clone(), seed, start)
    }

    fn has_begun(&self, method: &Evolution, seed: u64, start: &Start) -> bool {
        (&method.settings, method.seed, &method.start) == (self, seed, start)
    }

    fn matches_height(&self) -> bool {
        self.match_height
    }

    fn prior(&self) -> f64 {
        self.prior
    }
}

impl Method for Evolution {
    fn name(&self) -> &'static str {
        "evolution"
    }

    fn max_staleness(&self) -> usize {
        // Islands begin and end with no batch in flight.
        if self.island.is_empty() || self.has_stagnated() {
            return 0;
        }
        let grown = 1 + usize::try_from(self.island_batches / BATCHES_PER_STALENESS).unwrap_or(usize::MAX);
        grown.min(self.settings.staleness)
    }

    fn ask(&mut self, space: &SearchSpace, members: &mut Vec<Genome>) {
        if self.island.is_empty() {
            self.begin(space, members);
            return;
        }
        // Batches are counted when they are told; those in flight come before this one.
        let in_flight = self.island.in_flight() as u64;
        let (batch, size) = (self.batches + in_flight, self.batch_size(self.island_batches + in_flight));
        let draws = |member| Stream::at(self.seed, CHILD, batch, member);
        self.island.make_children(space, &self.settings, size, draws, members);
    }

    fn tell(&mut self, _: &SearchSpace, members: &[Genome], scores: &[Score]) {
        self.batches += 1;
        let newborn = members.iter().zip(scores).filter(|(_, score)| score.cost < f64::INFINITY);
        let newborn = newborn.map(|(genome, score)| Scored { genome: genome.clone(), score: *score });
        if self.island.is_empty() {
            self.island.settle(newborn.collect(), self.settings.parents);
            self.ended = true;
            return;
        }
        self.island.learn(scores);
        self.island.age(scores.len());
        self.island.settle(newborn.collect(), self.settings.parents);
        self.island_batches += 1;
        self.ended = self.island_batches.is_multiple_of(self.batches_per_generation());
        if self.island.in_flight() == 0 && self.has_stagnated() {
            self.start_next_island();
        }
    }

    fn ends_generation(&self) -> bool {
        self.ended
    }

    fn suits(&self, space: &SearchSpace, generations: u64, pending: &[usize]) -> bool {
        let max_batches = (generations + 1).saturating_mul(self.batches_per_generation());
        let children = (generations + 1).saturating_mul(self.settings.children.max(1) as u64);
        self.batches <= max_batches
            && self.island_batches <= max_batches
            && self.islands_begun <= generations
            && self.elites.len() <= self.settings.islands.max(1)
            && self.elites.iter().all(|elite| is_individual(&elite.genome, space))
            && self.island.suits(space, &self.settings, children, pending)
    }
}
