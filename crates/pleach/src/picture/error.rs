//! What is wrong with the options or the pictures of a fit.

use pleach_fit::SpaceError;
use pleach_generators::RegistryError;
use pleach_silhouette::goal::GoalError;
use pleach_silhouette::mask::MaskError;
use std::borrow::Cow;
use std::path::PathBuf;

/// An option with a value that cannot be. Options are named as the fields of [`super::FitOptions`], between backticks.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{option}` {problem}")]
#[non_exhaustive]
pub struct OptionError {
    /// The name of the field.
    pub option: Cow<'static, str>,
    /// What is wrong, and what would be right.
    pub problem: String,
}

impl OptionError {
    pub(super) fn new(option: impl Into<Cow<'static, str>>, problem: impl Into<String>) -> Self {
        Self { option: option.into(), problem: problem.into() }
    }
}

/// Why a fit cannot begin.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PrepareError {
    /// An option with a value that cannot be.
    #[error(transparent)]
    Option(#[from] OptionError),
    /// The species to start from cannot be had.
    #[error(transparent)]
    Species(#[from] RegistryError),
    /// Nothing is free to be searched, or a pattern names no parameter.
    #[error(transparent)]
    Space(#[from] SpaceError),
    /// A picture is not a goal.
    #[error(transparent)]
    Goal(#[from] GoalError),
    /// No tree was found in a photograph.
    #[error("cannot make a mask of {}", path.display())]
    Mask {
        /// The picture.
        path: PathBuf,
        /// Why not.
        source: MaskError,
    },
}
