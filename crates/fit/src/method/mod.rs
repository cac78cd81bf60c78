//! Optimisers: what to try next, given what came of the last tries.
//!
//! A [`Method`] only asks and tells. Evaluating is the caller's: through [`crate::Search`], which argmin
//! runs, or by hand in a loop. Every method is a plain value: its whole state is written
//! to checkpoints, and its draws are those of [`crate::Stream`], addressed by generation.
//!
//! | method | idea | source |
//! | --- | --- | --- |
//! | [`Evolution`] | sparse steps in an elitist population, restarted: the default | |
//! | [`Cma`] | a normal distribution that learns which way to go: CMA-ES with margin | Hansen 2016; Hamano and others 2022 |
//! | [`Shade`] | differences of a population, their factors learnt | Tanabe and Fukunaga 2013 |
//! | [`Random`] | lists drawn independently: the floor to compare with | |
//! | [`Rules`] | structures and their numbers: genetic programming | Koza 1993; Jacob 1994 |
//! | [`Hewitt`] | copies of a base with one parameter changed each; the two fittest merge to the next base | Hewitt 2017, §3.3.2 |

mod cma;
mod evolution;
mod first;
mod hewitt;
#[cfg(test)]
mod known_minima;
mod random;
mod rules;
mod shade;

pub use cma::{Cma, CmaSettings};
pub use evolution::{Evolution, EvolutionSettings};
pub use hewitt::{Hewitt, HewittSettings, Merge};
pub use random::{Random, RandomSettings};
pub use rules::{Rules, RulesSettings};
pub use shade::{Shade, ShadeSettings};

use crate::genome::{Genome, Score};
use crate::space::{Place, SearchSpace};
use serde::{Deserialize, Serialize};

/// An optimiser that is asked for individuals and told their scores.
pub trait Method {
    /// A short name, as on the command line.
    fn name(&self) -> &'static str;

    /// How many broods may wait for their scores when another is asked for: 0 for a method that has to be
    /// told of one before it breeds the next.
    ///
    /// With a lag, threads have something to do while others are busy with the slowest tree of a brood, and
    /// the search has the same bits on any number of threads. Asked whenever a brood could be bred.
    fn lag(&self) -> usize {
        0
    }

    /// Appends the individuals of the next brood to `members`; at least one. A brood is what is bred at
    /// once: a generation, or a part of one.
    ///
    /// Called with at most [`Method::lag`] broods that [`Method::tell`] has not been called for.
    fn ask(&mut self, space: &SearchSpace, members: &mut Vec<Genome>);

    /// Takes the scores of the oldest brood that was asked for and not told, in their order.
    fn tell(&mut self, space: &SearchSpace, members: &[Genome], scores: &[Score]);

    /// Whether what was told last ends a generation.
    fn ends_generation(&self) -> bool {
        true
    }

    /// Whether this can be the state of a search in `space` that has finished `generations` and waits for
    /// the scores of broods as many and as large as `pending` says, oldest first.
    ///
    /// What was read from a file may be anything that its form allows. A state that suits neither panics
    /// nor asks for more memory than the settings do; whether it makes sense is not asked.
    fn suits(&self, space: &SearchSpace, generations: u64, pending: &[usize]) -> bool;
}

/// The settings of an optimiser.
pub trait MethodSettings: Clone + Default + PartialEq {
    /// The optimiser.
    type Method: Method;

    /// The optimiser at its beginning.
    fn begin(&self, seed: u64, start: Start) -> Self::Method;

    /// Whether `method` was begun with these settings, this seed and this start.
    fn has_begun(&self, method: &Self::Method, seed: u64, start: &Start) -> bool;

    /// Whether trees are resized to the goal's height before they are compared: see
    /// [`crate::Evaluator::with_height_matching`].
    fn matches_height(&self) -> bool {
        true
    }

    /// Whether only what is [plausible](pleach_tree::Param::plausible) is searched, and not all of the
    /// search ranges.
    fn keeps_to_plausible(&self) -> bool {
        true
    }

    /// How strongly numbers are drawn to the start: see [`SearchSpace::drawn_to`].
    fn prior(&self) -> f64 {
        0.0
    }
}

/// Where a search starts.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Start {
    /// From random parameter lists.
    #[default]
    Random,
    /// From these lists, best guess first, one value per slot. At least one.
    Lists(Vec<Vec<f64>>),
}

impl Start {
    /// The lists to start from, empty for a random start.
    #[must_use]
    pub fn lists(&self) -> &[Vec<f64>] {
        match self {
            Self::Random => &[],
            Self::Lists(lists) => lists,
        }
    }
}

/// Whether `genome` has as many numbers as individuals of `space` have.
pub(crate) fn is_individual(genome: &Genome, space: &SearchSpace) -> bool {
    let nuisances = space.genes().iter().filter(|gene| matches!(gene.place, Place::Nuisance { .. })).count();
    genome.values.len() == space.params().len() && genome.nuisances.len() == nuisances
}

/// How many individuals a method without a lag waits for; none if more broods are `pending` than it
/// ever asks for.
pub(crate) fn alone(pending: &[usize]) -> Option<usize> {
    match pending {
        [] => Some(0),
        [one] => Some(*one),
        _ => None,
    }
}

/// The numbers of `scores` from best to worst, ties by number.
pub(crate) fn ranking(scores: &[Score]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..scores.len()).collect();
    order.sort_by(|&a, &b| scores[a].cost.total_cmp(&scores[b].cost));
    order
}
