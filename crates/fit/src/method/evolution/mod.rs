//! The default optimiser: an elitist population with sparse steps, in lanes that begin anew.
//!
//! A silhouette depends on some sixty numbers, most of them little, a few of them like a needle: a
//! hundredth of the range of `rotate` turns every branch of an acer to another side. So
//!
//! - most children change one number or a few. Each number has its own step, which grows with success
//!   and shrinks without (the one-fifth rule, Rechenberg 1973, number by number), and is chosen the
//!   more often the more it has helped;
//! - other children cross two parents, go along the difference of two others (Storn and Price 1997),
//!   move everything a little, draw a number anew from its whole range, or set one to zero. How often
//!   each move is tried follows from what it has brought ([`moves`]);
//! - reals, whole numbers, switches and choices are changed each in its own way, and numbers that the
//!   tree does not depend on ([`pleach_tree::Generator::is_active`]) are left alone;
//! - the population begins with the best of a batch of random lists, in which numbers that may be
//!   zero often are: variations, bends and splits are absent from most trees;
//! - a population that has not improved for a while ends its *lane*. Its best goes to the hall of
//!   champions, and the next lane begins with new random lists; after a few lanes the champions
//!   themselves meet in one.
//!
//! Nothing depends on the budget: longer is never worse, and a run may be resumed with more.

mod lane;
mod moves;

pub use moves::Move;

use super::first::first;
use super::{Method, Start};
use crate::genome::{Genome, Score, Scored};
use crate::space::{PRIOR, SearchSpace};
use crate::stream::Stream;
use lane::Lane;
use serde::{Deserialize, Serialize};

/// Settings of [`Evolution`]. The defaults were chosen by fits of the fifteen species.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EvolutionSettings {
    /// Random lists at the beginning of a lane.
    pub first: usize,
    /// Individuals that survive a generation, at least 2.
    pub parents: usize,
    /// Children in a generation, at least 1.
    pub children: usize,
    /// First step of every number, as a part of its search range.
    pub step: f64,
    /// Largest chance that a number of a random list which may be zero is set to zero.
    pub sparsity: f64,
    /// Parents are drawn from the best part of the population: a power, 1 draws all alike.
    pub greed: f64,
    /// Evaluations without a gain of a thousandth, over the number of parents, after which a lane ends.
    pub patience: usize,
    /// Lanes from random lists between two lanes in which champions meet.
    pub lanes: usize,
    /// Whether trees are resized to the goal's height before they are compared, if all sizes are free.
    pub match_height: bool,
    /// How strongly numbers are drawn to where the search starts: the cost of having all of them a whole
    /// search range away. 0 for not at all.
    pub prior: f64,
}

impl Default for EvolutionSettings {
    fn default() -> Self {
        Self {
            first: 200,
            parents: 30,
            children: 20,
            step: 0.15,
            sparsity: 0.8,
            greed: 2.0,
            patience: 50,
            lanes: 3,
            match_height: true,
            prior: PRIOR,
        }
    }
}

/// The population, and what has been learnt about moves and numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Evolution {
    settings: EvolutionSettings,
    seed: u64,
    start: Start,
    round: u64,
    lanes_begun: u64,
    lane: Lane,
    /// The best of each lane since the champions last met, theirs included.
    champions: Vec<Scored>,
}

/// Purposes of the draws.
const FIRST: u32 = 0;
const CHILD: u32 = 1;

impl Evolution {
    /// Starts from the lists of `start` and variations of them, or from random lists.
    #[must_use]
    pub fn new(settings: EvolutionSettings, seed: u64, start: Start) -> Self {
        Self { settings, seed, start, round: 0, lanes_begun: 0, lane: Lane::default(), champions: Vec::new() }
    }

    /// The individuals that a lane begins with.
    fn begin(&self, space: &SearchSpace, members: &mut Vec<Genome>) {
        let lists = if self.lanes_begun == 0 { self.start.lists() } else { &[] };
        let draws = |member| Stream::at(self.seed, FIRST, self.round, member);
        first(space, lists, self.settings.first.max(2), self.settings.sparsity, draws, members);
    }

    /// Ends the lane and prepares the next.
    fn change_lanes(&mut self) {
        self.champions.extend(self.lane.best().cloned());
        self.lane = Lane::default();
        self.lanes_begun += 1;
        if self.champions.len() > self.settings.lanes.max(1) {
            self.lane.settle(std::mem::take(&mut self.champions), usize::MAX);
        }
    }
}

impl Method for Evolution {
    fn name(&self) -> &'static str {
        "evolution"
    }

    fn ask(&mut self, space: &SearchSpace, members: &mut Vec<Genome>) {
        if self.lane.is_empty() {
            self.begin(space, members);
            return;
        }
        self.lane.prepare(space, &self.settings);
        for member in 0..self.settings.children.max(1) {
            let mut draws = Stream::at(self.seed, CHILD, self.round, member as u32);
            members.push(self.lane.breed(space, &self.settings, &mut draws));
        }
    }

    fn tell(&mut self, _: &SearchSpace, members: &[Genome], scores: &[Score]) {
        self.round += 1;
        let newborn = members.iter().zip(scores).filter(|(_, score)| score.cost < f64::INFINITY);
        let newborn = newborn.map(|(genome, score)| Scored { genome: genome.clone(), score: *score });
        if self.lane.is_empty() {
            self.lane.settle(newborn.collect(), self.settings.parents);
            return;
        }
        self.lane.learn(scores);
        self.lane.settle(newborn.collect(), self.settings.parents);
        let patience = (self.settings.patience * self.settings.parents) as u64;
        if self.lane.idle() * members.len() as u64 > patience {
            self.change_lanes();
        }
    }
}
