//! What can be wrong with a photograph and a mask that are read together.

use thiserror::Error;

/// Why colours could not be read.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum ColorsError {
    /// The mask is not of the size of the photograph.
    #[error(
        "the mask is {} × {} pixels, but the photograph is {} × {}: the two must be of one size",
        mask.0, mask.1, photo.0, photo.1
    )]
    MaskSize {
        /// Width and height of the mask.
        mask: (u32, u32),
        /// Width and height of the photograph.
        photo: (u32, u32),
    },
}
