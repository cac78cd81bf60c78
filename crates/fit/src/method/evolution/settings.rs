//! What may be chosen of the default optimiser.

use crate::space::PRIOR;
use serde::{Deserialize, Serialize};

/// Settings of [`Evolution`](super::Evolution). The defaults were chosen by searches of equal time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EvolutionSettings {
    /// Random lists at the beginning of an island.
    pub first: usize,
    /// Individuals that survive a generation, at least 2.
    pub parents: usize,
    /// Children in a generation, at least 1.
    pub children: usize,
    /// Children that are bred at once, from what is known by then.
    pub brood: usize,
    /// Broods that may wait for their scores when the next is bred, once an island has got going: more keep more
    /// threads busy, and know less of each other.
    pub lag: usize,
    /// First step of every number, as a part of its search range.
    pub step: f64,
    /// Largest chance that a number of a random list which may be zero is set to zero.
    pub sparsity: f64,
    /// Parents are drawn from the best part of the population: a power, 1 draws all alike.
    pub greed: f64,
    /// Evaluations without a gain of a thousandth, over the number of parents, after which an island ends.
    pub patience: usize,
    /// Islands from random lists between two islands in which elites meet.
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
            brood: 5,
            lag: 7,
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
