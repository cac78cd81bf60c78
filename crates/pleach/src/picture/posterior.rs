//! What a picture says about the numbers of its tree, as data.

use super::drawn::FitDrawing;
use pleach_fit::{Interval, Posterior};
use pleach_tree::Species;
use pleach_tree::param::SlotError;
use serde::Serialize;

/// Intervals of the numbers of the goal's tree, and trees that it may be of.
///
/// Over trees of the prior, which is around the species that the fit started from, an interval holds the truth nine
/// times in ten.
#[derive(Clone, Debug, Serialize)]
pub struct PosteriorReport {
    /// The species that the prior is around.
    pub species: String,
    /// Trees of the prior that it was learnt from.
    pub trees: usize,
    /// Trees that did not grow, or of which nothing is seen.
    pub failures: usize,
    /// The share of those trees whose pictures are at least as strange as the goal is, in 0..=1.
    pub familiarity: f64,
    /// Whether the goal is like a picture of a tree of the prior; where it is not, intervals cannot be trusted.
    pub is_familiar: bool,
    /// Every number that varies in the prior, in the order of the slots.
    pub numbers: Vec<NumberReport>,
    /// Trees that the goal may be of, each with its seed.
    #[serde(skip)]
    pub samples: Vec<Species>,
}

/// What is known of one number.
#[derive(Clone, Debug, Serialize)]
pub struct NumberReport {
    /// The slot, such as `length[1]`.
    pub slot: String,
    /// Before the picture was seen.
    pub prior: Interval,
    /// Since.
    pub posterior: Interval,
    /// By how much the variance is smaller since, in 0..=1.
    pub shrunk: f64,
}

impl PosteriorReport {
    /// # Errors
    /// A value that the generator does not allow: not of a posterior of the same fit.
    pub(super) fn new(posterior: &Posterior, drawing: &FitDrawing<'_>) -> Result<Self, SlotError> {
        let space = drawing.problem.start.params.space();
        let numbers = posterior
            .numbers
            .iter()
            .map(|number| NumberReport {
                slot: space.slot_name(number.slot),
                prior: number.prior,
                posterior: number.posterior,
                shrunk: number.shrunk,
            })
            .collect();
        Ok(Self {
            species: drawing.problem.start.name.clone(),
            trees: posterior.trees,
            failures: posterior.failures,
            familiarity: posterior.familiarity,
            is_familiar: posterior.familiarity >= Posterior::STRANGE,
            numbers,
            samples: posterior
                .samples
                .iter()
                .map(|genome| drawing.species(genome))
                .collect::<Result<_, _>>()?,
        })
    }
}
