//! What can be wrong with pictures that are read together.

use thiserror::Error;

/// Why a picture could not be read.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum ReadingError {
    /// The mask of wood is not of the size of the silhouette.
    #[error(
        "the mask of wood is {} × {} pixels, but the silhouette is {} × {}: the two must be of one size",
        wood.0, wood.1, silhouette.0, silhouette.1
    )]
    WoodSize {
        /// Width and height of the mask.
        wood: (u32, u32),
        /// Width and height of the silhouette.
        silhouette: (u32, u32),
    },
    /// The mask of the tree is not of the size of the photograph.
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
