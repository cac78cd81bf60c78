//! A fit whose search is about to begin.

use crate::guess::FirstGuess;
use crate::problem::FitProblem;
use crate::run::FitSettings;

/// A fit whose search is about to begin.
#[derive(Clone, Debug)]
pub struct PreparedSearch {
    /// What is fitted: after a first guess, with the guessed species as the start.
    pub problem: FitProblem,
    /// The settings of the search: after a first guess, with its lists as the start.
    pub settings: FitSettings,
    /// The first guess, if one was made.
    pub guess: Option<FirstGuess>,
}
