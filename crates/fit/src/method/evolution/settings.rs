//! Settings of the default optimiser.

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
    /// Children in a batch, at least 1.
    pub batch: usize,
    /// Batches without scores when the next one is made, once an island has warmed up: more of them keep more
    /// threads busy, and each is made from less information.
    pub staleness: usize,
    /// First step of every number, as a part of its search range.
    pub step: f64,
    /// Largest probability that a number of a random list that may be zero is set to zero.
    pub sparsity: f64,
    /// How much better individuals are preferred as parents: an exponent; 1 draws all of them equally often.
    pub selection_pressure: f64,
    /// Evaluations per parent without a gain of a thousandth after which an island ends.
    pub patience: usize,
    /// Islands from random lists between two islands in which elites meet.
    pub islands: usize,
    /// Whether trees are resized to the goal's height before they are compared, if all sizes are free.
    pub match_height: bool,
    /// Weight of the prior around the start: the cost of having every number a whole search range away from
    /// it. 0 for no prior.
    pub prior: f64,
}

impl Default for EvolutionSettings {
    fn default() -> Self {
        Self {
            first: 200,
            parents: 30,
            children: 20,
            batch: 5,
            staleness: 7,
            step: 0.15,
            sparsity: 0.8,
            selection_pressure: 2.0,
            patience: 50,
            islands: 3,
            match_height: true,
            prior: PRIOR,
        }
    }
}
