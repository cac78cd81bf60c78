//! The default optimiser: an elitist population with sparse steps, in islands that restart.
//!
//! A silhouette depends on some sixty numbers, most of them little, a few of them like a needle: a
//! hundredth of the range of `rotate` turns every branch of an acer to another side. So
//!
//! - most children change one number or a few. Each number has its own step, which grows with success
//!   and shrinks without (the one-fifth rule, Rechenberg 1973, number by number), and is chosen the
//!   more often the more it has helped;
//! - other children cross two parents, go along the difference of two others (Storn and Price 1997),
//!   move everything a little, draw a number again from its whole range, or set one to zero. How often
//!   each operator is tried follows from what it has brought (`operators.rs`);
//! - reals, whole numbers, switches and choices are changed each in its own way, and numbers that the
//!   tree does not depend on ([`pleach_tree::Generator::is_active`]) are left alone;
//! - the population begins with the best of a batch of random lists, in which numbers that may be
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
use crate::genome::{Genome, Score, Scored};
use crate::space::SearchSpace;
use crate::stream::Stream;
use island::Island;
use serde::{Deserialize, Serialize};

/// The population, and what has been learned about operators and numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Evolution {
    settings: EvolutionSettings,
    seed: u64,
    start: Start,
    /// Broods that have been told.
    round: u64,
    islands_begun: u64,
    island: Island,
    /// Broods of children of the island that have been told.
    broods: u64,
    /// Whether what was told last ended a generation.
    ended: bool,
    /// The best of each island since the elites last met, theirs included.
    elites: Vec<Scored>,
}

/// Purposes of the draws.
const FIRST: u32 = 0;
const CHILD: u32 = 1;

/// The lag grows by one after so many broods of an island: at its beginning every tree teaches much, and a
/// child that is bred a moment later is the better for it.
const BROODS_A_LAG: u64 = 40;

impl Evolution {
    /// Starts from the lists of `start` and variations of them, or from random lists.
    #[must_use]
    pub fn new(settings: EvolutionSettings, seed: u64, start: Start) -> Self {
        Self {
            settings,
            seed,
            start,
            round: 0,
            islands_begun: 0,
            island: Island::default(),
            broods: 0,
            ended: false,
            elites: Vec::new(),
        }
    }

    /// The individuals that an island begins with.
    fn begin(&self, space: &SearchSpace, members: &mut Vec<Genome>) {
        let lists = if self.islands_begun == 0 { self.start.lists() } else { &[] };
        let draws = |member| Stream::at(self.seed, FIRST, self.round, member);
        first(space, lists, self.settings.first.max(2), self.settings.sparsity, draws, members);
    }

    /// Whether the island has not improved for long.
    fn has_stagnated(&self) -> bool {
        let patience = (self.settings.patience * self.settings.parents) as u64;
        self.island.stagnation() > patience
    }

    /// Broods of a generation.
    fn broods_a_generation(&self) -> u64 {
        self.settings.children.max(1).div_ceil(self.settings.brood.max(1)) as u64
    }

    /// Children of brood `number` of an island: the last of a generation may be smaller than the others.
    fn brood_size(&self, number: u64) -> usize {
        let before = (number % self.broods_a_generation()) as usize * self.settings.brood.max(1);
        self.settings.brood.max(1).min(self.settings.children.max(1) - before)
    }

    /// Ends the island and prepares the next.
    fn change_lanes(&mut self) {
        self.elites.extend(self.island.best().cloned());
        self.island = Island::default();
        self.broods = 0;
        self.ended = true;
        self.islands_begun += 1;
        if self.elites.len() > self.settings.lanes.max(1) {
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

    fn lag(&self) -> usize {
        // Islands begin and end with nothing out.
        if self.island.is_empty() || self.has_stagnated() {
            return 0;
        }
        let grown = 1 + usize::try_from(self.broods / BROODS_A_LAG).unwrap_or(usize::MAX);
        grown.min(self.settings.lag)
    }

    fn ask(&mut self, space: &SearchSpace, members: &mut Vec<Genome>) {
        if self.island.is_empty() {
            self.begin(space, members);
            return;
        }
        // Both are counted when they are told; what is out will be by then.
        let out = self.island.out() as u64;
        let (round, size) = (self.round + out, self.brood_size(self.broods + out));
        let draws = |member| Stream::at(self.seed, CHILD, round, member);
        self.island.breed(space, &self.settings, size, draws, members);
    }

    fn tell(&mut self, _: &SearchSpace, members: &[Genome], scores: &[Score]) {
        self.round += 1;
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
        self.broods += 1;
        self.ended = self.broods.is_multiple_of(self.broods_a_generation());
        if self.island.out() == 0 && self.has_stagnated() {
            self.change_lanes();
        }
    }

    fn ends_generation(&self) -> bool {
        self.ended
    }

    fn suits(&self, space: &SearchSpace, generations: u64, pending: &[usize]) -> bool {
        let broods = (generations + 1).saturating_mul(self.broods_a_generation());
        let children = (generations + 1).saturating_mul(self.settings.children.max(1) as u64);
        self.round <= broods
            && self.broods <= broods
            && self.islands_begun <= generations
            && self.elites.len() <= self.settings.lanes.max(1)
            && self.elites.iter().all(|elite| is_individual(&elite.genome, space))
            && self.island.suits(space, &self.settings, children, pending)
    }
}
