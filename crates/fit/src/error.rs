//! Why there is no fit.

use crate::checkpoint::CheckpointError;
use crate::problem::ProblemError;
use crate::space::SpaceError;

/// Why an observer does not want a fit to go on.
pub type ObserverError = Box<dyn std::error::Error + Send + Sync>;

/// Why a fit could not begin or go on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// Goals that cannot be compared with.
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
    /// The executor failed: a mistake in this crate.
    #[error("the search failed: {0}")]
    Search(#[source] Box<dyn std::error::Error + Send + Sync>),
}
