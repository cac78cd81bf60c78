//! The genetic algorithm of Hewitt 2017, §3.3.2.
//!
//! The text, and this implementation:
//!
//! | the text | here |
//! | --- | --- |
//! | starts with a randomised parameter list | [`crate::SearchSpace::random`], again until one grows; or the list it is given |
//! | a population by copying this and permuting a randomly selected parameter | [`HewittSettings::population`] copies, each with one free slot changed |
//! | by a random amount proportional to its current value | `value + value · step · U(−1, 1)` |
//! | a small chance of flipping the sign | [`HewittSettings::flip_chance`]; where the sign means something |
//! | ranked by fitness | by cost, ties in order of birth |
//! | the two fittest are merged to form the basis of the next generation | [`Merge`] |
//! | always taking the current best, even if worse than the last generation | the base is never kept |
//!
//! The text gives no numbers and does not say how lists merge. The best individual ever seen is reported by
//! [`crate::Search`] and not used here.

use super::{Method, MethodSettings, Start, is_individual, only_batch, ranking};
use crate::problem::{Genome, Score};
use crate::space::Stream;
use crate::space::{SearchSpace, TreeSeed};
use pleach_tree::Kind;
use serde::{Deserialize, Serialize};

/// How the two fittest lists are merged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Merge {
    /// The changes of both; where both changed the same slot, that of the fitter. Both lists are the base with one
    /// change each, so this is the only merge that keeps both changes.
    #[default]
    Both,
    /// Each slot from either list with the same chance (uniform crossover).
    Uniform,
    /// The mean of each slot, rounded where it must be; the fitter's where the signs differ or where
    /// the slot is a choice.
    Mean,
}

/// Settings of [`Hewitt`]: everything that the text does not say.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HewittSettings {
    /// Individuals in a generation, at least 2.
    pub population: usize,
    /// Largest change of a value as a share of the value, above 0.
    pub step: f64,
    /// Chance that the changed slot also changes its sign, if its sign is a switch.
    pub flip_chance: f64,
    /// The value whose share is taken where the current one is nearer to zero, as a share of the
    /// slot's search range: without it a zero could never change.
    pub zero_share: f64,
    /// How the two fittest become the next base.
    pub merge: Merge,
    /// Select only among parameters that can change the tree of the base.
    pub only_read: bool,
}

impl Default for HewittSettings {
    fn default() -> Self {
        Self {
            population: 20,
            step: 0.5,
            flip_chance: 0.05,
            zero_share: 0.1,
            merge: Merge::default(),
            only_read: true,
        }
    }
}

/// The state of the algorithm: its base, and nothing else.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hewitt {
    settings: HewittSettings,
    seed: u64,
    start: Start,
    round: u64,
    base: Option<Genome>,
}

impl Hewitt {
    /// Starts from the first list of `start`, or from a random one.
    #[must_use]
    pub const fn new(settings: HewittSettings, seed: u64, start: Start) -> Self {
        Self { settings, seed, start, round: 0, base: None }
    }

    /// The list that the next generation is made from; `None` before one has grown.
    #[must_use]
    pub const fn base(&self) -> Option<&Genome> {
        self.base.as_ref()
    }

    /// A copy of `base` with one randomly selected parameter permuted.
    fn permuted(&self, space: &SearchSpace, base: &Genome, read: &[usize], draws: &mut Stream) -> Genome {
        let mut child = base.clone();
        let seeds = usize::from(space.tree_seed() == TreeSeed::Any);
        if read.len() + seeds == 0 {
            return child;
        }
        let chosen = draws.below(read.len() + seeds);
        let Some(&gene) = read.get(chosen) else {
            child.tree_seed = SearchSpace::random_seed(draws);
            return child;
        };
        let gene = &space.genes()[gene];
        let old = gene.get(base);
        let least = self.settings.zero_share * (gene.high - gene.low);
        let amount = old.abs().max(least) * self.settings.step * draws.signed();
        let mut value = old + amount;
        if gene.kind.is_whole() && value.round() == old {
            // Rounding would take the change back: the smallest change there is.
            value = old + amount.signum();
        }
        if gene.kind.is_flagged() && draws.chance(self.settings.flip_chance) {
            value = -value;
        }
        // The text has no search ranges: any allowed value may be reached.
        let value = match &gene.kind {
            Kind::Choice { .. } => gene.clamp(value),
            _ if gene.is_periodic() => gene.clamp(value),
            kind => kind.repair(value),
        };
        gene.set(&mut child, value);
        child
    }

    fn merged(&self, space: &SearchSpace, base: &Genome, best: &Genome, second: &Genome) -> Genome {
        let mut draws = Stream::at(self.seed, 2, self.round, 0);
        let mut merged = best.clone();
        for gene in space.genes() {
            let [old, a, b] = [base, best, second].map(|genome| gene.get(genome));
            let value = match self.settings.merge {
                Merge::Both if a == old => b,
                Merge::Both => a,
                Merge::Uniform => [a, b][draws.below(2)],
                Merge::Mean if gene.is_choice() || (gene.kind.is_flagged() && a * b < 0.0) => a,
                Merge::Mean => gene.kind.repair(f64::midpoint(a, b)),
            };
            gene.set(&mut merged, value);
        }
        if self.settings.merge == Merge::Both && best.tree_seed == base.tree_seed {
            merged.tree_seed = second.tree_seed;
        }
        merged
    }
}

impl MethodSettings for HewittSettings {
    type Method = Hewitt;

    fn begin(&self, seed: u64, start: Start) -> Hewitt {
        Hewitt::new(self.clone(), seed, start)
    }

    fn has_begun(&self, method: &Hewitt, seed: u64, start: &Start) -> bool {
        (&method.settings, method.seed, &method.start) == (self, seed, start)
    }

    fn matches_height(&self) -> bool {
        false
    }

    fn keeps_to_plausible(&self) -> bool {
        false
    }
}

impl Method for Hewitt {
    fn name(&self) -> &'static str {
        "hewitt"
    }

    fn ask(&mut self, space: &SearchSpace, members: &mut Vec<Genome>) {
        let Some(base) = &self.base else {
            let mut draws = Stream::at(self.seed, 0, self.round, 0);
            members.push(match self.start.lists().first() {
                Some(list) if self.round == 0 => space.individual(list, SearchSpace::random_seed(&mut draws)),
                _ => space.random(&mut draws),
            });
            return;
        };
        let mut read = Vec::new();
        if self.settings.only_read {
            space.active_genes(&base.values, &mut read);
        } else {
            read.extend(0..space.genes().len());
        }
        for member in 0..self.settings.population.max(2) {
            let mut draws = Stream::at(self.seed, 1, self.round, member as u32);
            members.push(self.permuted(space, base, &read, &mut draws));
        }
    }

    fn tell(&mut self, space: &SearchSpace, members: &[Genome], scores: &[Score]) {
        let order = ranking(scores);
        self.base = match &self.base {
            None => (scores[0].cost < f64::INFINITY).then(|| members[0].clone()),
            Some(base) => Some(self.merged(space, base, &members[order[0]], &members[order[1]])),
        };
        self.round += 1;
    }

    fn suits(&self, space: &SearchSpace, generations: u64, pending: &[usize]) -> bool {
        let Some(pending) = only_batch(pending) else { return false };
        let asked = self.base.as_ref().map_or(1, |_| self.settings.population.max(2));
        self.round <= generations
            && self.base.iter().all(|base| is_individual(base, space))
            && (pending == 0 || pending == asked)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::Freedom;
    use crate::testing::{choice, flagged, integer, params, real};

    fn space() -> SearchSpace {
        let list = vec![real("a", 0.0, 4.0), flagged("f", 90.0), integer("n", 0, 9), choice("c")];
        let base = [2.0, 45.0, 5.0, 2.0];
        SearchSpace::from_params(params(list), &base, &Freedom::default(), TreeSeed::Fixed(1)).unwrap()
    }

    fn started(settings: HewittSettings) -> (SearchSpace, Hewitt) {
        let space = space();
        let start = Start::Lists(vec![space.base().to_vec()]);
        let mut hewitt = Hewitt::new(settings, 3, start);
        let mut members = Vec::new();
        hewitt.ask(&space, &mut members);
        assert_eq!(members.len(), 1);
        assert_eq!(members[0].values, space.base());
        hewitt.tell(&space, &members, &[Score::from_cost(0.5)]);
        (space, hewitt)
    }

    #[test]
    fn every_copy_differs_in_at_most_one_slot_by_a_share_of_its_value() {
        let (space, mut hewitt) = started(HewittSettings { population: 400, ..HewittSettings::default() });
        let mut members = Vec::new();
        hewitt.ask(&space, &mut members);
        let mut changed = [0; 4];
        let mut flips = 0;
        for member in &members {
            let slots: Vec<usize> = (0..4).filter(|&s| member.values[s] != space.base()[s]).collect();
            assert_eq!(slots.len(), 1, "{:?}", member.values);
            let (slot, old, new) = (slots[0], space.base()[slots[0]], member.values[slots[0]]);
            changed[slot] += 1;
            flips += usize::from(new < 0.0);
            assert!((new.abs() - old).abs() <= 0.5 * old + 0.5, "{old} to {new}");
        }
        assert!(changed.iter().all(|c| (60..140).contains(c)), "{changed:?}");
        assert!((1..15).contains(&flips), "{flips} of 100 at a chance of one in twenty");
    }

    #[test]
    fn a_zero_can_move() {
        let (space, hewitt) = started(HewittSettings::default());
        let zero = Genome::new(vec![0.0, 0.0, 0.0, 0.0], 1);
        let moved = (0..50).map(|m| hewitt.permuted(&space, &zero, &[0], &mut Stream::at(1, 9, 0, m)));
        let reach = moved.map(|g| g.values[0].abs()).fold(0.0, f64::max);
        assert!((0.1..=0.2).contains(&reach), "half of a tenth of the range: {reach}");
    }

    #[test]
    fn the_two_fittest_merge_even_if_both_are_worse() {
        for (merge, expected) in [(Merge::Both, [3.0, 45.0, 7.0, 2.0]), (Merge::Mean, [2.5, 45.0, 6.0, 2.0])]
        {
            let (space, mut hewitt) = started(HewittSettings { merge, ..HewittSettings::default() });
            let genome = |values: [f64; 4]| Genome::new(values.to_vec(), 1);
            let members = [
                genome([9.0, 45.0, 5.0, 2.0]),
                genome([2.0, 45.0, 7.0, 2.0]),
                genome([3.0, 45.0, 5.0, 2.0]),
                genome([2.0, 45.0, 5.0, 4.0]),
            ];
            let costs = [0.9, 0.7, 0.6, f64::INFINITY].map(Score::from_cost);
            hewitt.tell(&space, &members, &costs);
            assert_eq!(hewitt.base().unwrap().values, expected, "{merge:?}");
        }
    }

    #[test]
    fn a_random_start_is_drawn_until_it_grows() {
        let space = space();
        let mut hewitt = Hewitt::new(HewittSettings::default(), 3, Start::Random);
        let mut tried = Vec::new();
        for cost in [f64::INFINITY, f64::INFINITY, 0.9] {
            let mut members = Vec::new();
            hewitt.ask(&space, &mut members);
            assert_eq!(members.len(), 1);
            hewitt.tell(&space, &members, &[Score::from_cost(cost)]);
            tried.push(members.remove(0));
        }
        assert_ne!(tried[0], tried[1]);
        assert_eq!(hewitt.base(), Some(&tried[2]));
    }
}
