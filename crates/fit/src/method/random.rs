//! Independent random parameter lists.

use super::{Method, MethodSettings, Start, only_batch};
use crate::problem::{Genome, Score};
use crate::space::SearchSpace;
use crate::space::Stream;
use serde::{Deserialize, Serialize};

/// Settings of [`Random`].
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RandomSettings {
    /// Individuals in a generation: decides only how often progress is reported.
    pub population: usize,
}

impl Default for RandomSettings {
    fn default() -> Self {
        Self { population: 50 }
    }
}

/// Independent random lists, after the start's lists: the baseline for every other method.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Random {
    settings: RandomSettings,
    seed: u64,
    start: Start,
    round: u64,
}

impl Random {
    /// Draws seeded with `seed`.
    #[must_use]
    pub const fn new(settings: RandomSettings, seed: u64, start: Start) -> Self {
        Self { settings, seed, start, round: 0 }
    }
}

impl MethodSettings for RandomSettings {
    type Method = Random;

    fn begin(&self, seed: u64, start: Start) -> Random {
        Random::new(self.clone(), seed, start)
    }

    fn has_begun(&self, method: &Random, seed: u64, start: &Start) -> bool {
        (&method.settings, method.seed, &method.start) == (self, seed, start)
    }

    fn matches_height(&self) -> bool {
        false
    }

    fn keeps_to_plausible(&self) -> bool {
        false
    }
}

impl Method for Random {
    fn name(&self) -> &'static str {
        "random"
    }

    fn ask(&mut self, space: &SearchSpace, members: &mut Vec<Genome>) {
        let draws = |member| Stream::at(self.seed, 0, self.round, member);
        if self.round == 0 {
            let lists = self.start.lists().iter();
            members.extend(lists.map(|list| space.individual(list, SearchSpace::random_seed(&mut draws(0)))));
        }
        for member in 0..self.settings.population.max(1) {
            members.push(space.random(&mut draws(member as u32)));
        }
        self.round += 1;
    }

    fn tell(&mut self, _: &SearchSpace, _: &[Genome], _: &[Score]) {}

    fn suits(&self, _: &SearchSpace, generations: u64, pending: &[usize]) -> bool {
        only_batch(pending).is_some() && self.round <= generations + 1
    }
}
