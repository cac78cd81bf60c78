//! Where a fit begins.

use crate::guess::FirstGuess;
use crate::problem::FitProblem;
use crate::settings::FitSettings;

/// What is known of a fit when its search begins.
#[derive(Clone, Debug)]
pub struct Begun {
    /// What is fitted: after a first guess, from the species that the goal looks like.
    pub problem: FitProblem,
    /// How: after a first guess, from its lists.
    pub settings: FitSettings,
    /// The first guess, if there was one.
    pub guess: Option<FirstGuess>,
}
