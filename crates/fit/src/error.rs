//! Errors of a fit.

use crate::problem::ProblemError;
use crate::run::CheckpointError;
use crate::space::SpaceError;

/// The reason of an observer to refuse a fit.
pub type ObserverError = Box<dyn std::error::Error + Send + Sync>;

/// The reason why a fit could not begin or go on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// Goals that trees cannot be compared with.
    #[error(transparent)]
    Problem(#[from] ProblemError),
    /// Patterns or start values that do not belong to the generator.
    #[error(transparent)]
    Space(#[from] SpaceError),
    /// The first checkpoint could not be written, or the one to resume from not be read.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// `Start::Lists` without a list.
    #[error("the list of starts is empty")]
    NoStart,
    /// The structure is to be searched, and the generator offers no way to change it.
    #[error("species of the generator `{family}` have no rules that could change, or too many")]
    NoVariation {
        /// The family.
        family: &'static str,
    },
    /// The caller's stop flag was raised during a first guess or while a result was judged.
    #[error("interrupted")]
    Interrupted,
    /// The search has ended, and nothing that it tried has grown.
    #[error("no parameter list that grows a tree was found in {evaluations} evaluations")]
    NothingGrew {
        /// How many lists were tried.
        evaluations: u64,
    },
    /// An observer refused to let the search begin.
    #[error(transparent)]
    Observer(ObserverError),
    /// Growing, drawing or comparing a tree panicked: a mistake in this crate, in the generator or in the evidence.
    #[error("scoring a tree panicked: {message}")]
    ScoringPanicked {
        /// The panic's message; empty if it is not a text.
        message: String,
    },
}
