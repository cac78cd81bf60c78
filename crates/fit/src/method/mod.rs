//! Optimisers: what to try next, given what came of the last tries.
//!
//! A [`Method`] only asks and tells. Evaluating is the caller's: as an argmin solver through
//! [`crate::Search`], or by hand in a loop. Every method is a plain value: its whole state is written
//! to checkpoints, and its draws are those of [`crate::stream::Stream`], addressed by generation.
//!
//! | method | idea | source |
//! | --- | --- | --- |
//! | [`Evolution`] | sparse steps in an elitist population, restarted: the default | |
//! | [`Cma`] | a normal distribution that learns which way to go: CMA-ES with margin | Hansen 2016; Hamano and others 2022 |
//! | [`Shade`] | differences of a population, their factors learnt | Tanabe and Fukunaga 2013 |
//! | [`Random`] | lists drawn independently: the floor to compare with | |
//! | [`Hewitt`] | copies of a base with one parameter changed each; the two fittest merge to the next base | Hewitt 2017, §3.3.2 |

mod cma;
mod evolution;
mod first;
mod hewitt;
#[cfg(test)]
mod known_minima;
mod random;
mod shade;

pub use cma::{Cma, CmaSettings};
pub use evolution::{Evolution, EvolutionSettings, Move};
pub use hewitt::{Hewitt, HewittSettings, Merge};
pub use random::{Random, RandomSettings};
pub use shade::{Shade, ShadeSettings};

use crate::genome::{Genome, Score};
use crate::space::SearchSpace;
use serde::{Deserialize, Serialize};

/// An optimiser that is asked for individuals and told their scores.
pub trait Method {
    /// A short name, as on the command line.
    fn name(&self) -> &'static str;

    /// Appends the individuals of the next generation to `members`; at least one.
    ///
    /// Called again only after [`Method::tell`].
    fn ask(&mut self, space: &SearchSpace, members: &mut Vec<Genome>);

    /// Takes the scores of the individuals last asked for, in their order.
    fn tell(&mut self, space: &SearchSpace, members: &[Genome], scores: &[Score]);
}

/// Where a search starts.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Start {
    /// From random parameter lists.
    #[default]
    Random,
    /// From these lists, best guess first, one value a slot. At least one.
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

/// The numbers of `scores` from best to worst, ties by number.
pub(crate) fn ranking(scores: &[Score]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..scores.len()).collect();
    order.sort_by(|&a, &b| scores[a].cost.total_cmp(&scores[b].cost));
    order
}
