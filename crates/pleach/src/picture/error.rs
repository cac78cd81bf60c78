//! What is wrong with the options or the pictures of a fit.

use crate::option_error::OptionError;
use pleach_fit::SpaceError;
use pleach_generators::RegistryError;
use pleach_reading::ReadingError;
use pleach_silhouette::goal::GoalError;
use pleach_silhouette::mask::MaskError;
use std::path::PathBuf;

/// Why a fit cannot begin.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PrepareError {
    /// An option with a value that cannot be.
    #[error(transparent)]
    Option(#[from] OptionError),
    /// The species to start from is not available.
    #[error(transparent)]
    Species(#[from] RegistryError),
    /// Nothing is free to be searched, or a pattern names no parameter.
    #[error(transparent)]
    Space(#[from] SpaceError),
    /// A picture is not a goal.
    #[error(transparent)]
    Goal(#[from] GoalError),
    /// A mask of wood is not of the goal's size.
    #[error(transparent)]
    Wood(#[from] ReadingError),
    /// No tree was found in a photograph.
    #[error("cannot make a mask of {}", path.display())]
    Mask {
        /// The picture.
        path: PathBuf,
        /// Why not.
        source: MaskError,
    },
}
