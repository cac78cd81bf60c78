//! A picture of the tree at the two sizes that a fit needs.

use super::error::PrepareError;
use super::source::PictureSource;
use pleach_silhouette::goal::{Crop, GoalError, GoalWarning};
use pleach_silhouette::mask::{Mask, MaskOptions, Photo};
use pleach_silhouette::{Goal, GoalOptions};

/// A picture of the tree at its own size, which scores are of, and reduced, which the search compares with.
///
/// Both show the tree with the margins that a search sees: see [`Crop::ToTree`].
#[derive(Clone, Debug)]
pub struct GoalPair {
    /// At its own size.
    pub full: Goal,
    /// At most as large as [`super::FitOptions::size`] says.
    pub working: Goal,
    /// The mask that was made of a photograph.
    pub mask: Option<Mask>,
    /// What about the picture, or its mask, is not as a fit expects.
    pub warnings: Vec<GoalWarning>,
}

impl GoalPair {
    /// Reads a picture as `options` say, and reduces it to `size` pixels.
    pub(super) fn read(picture: &PictureSource, options: GoalOptions, size: u32) -> Result<Self, GoalError> {
        let full = picture.goal(&GoalOptions { crop: Crop::ToTree, max_side: None, ..options })?;
        let working = full.reduced(size)?;
        let warnings = full.warnings.clone();
        Ok(Self { full, working, mask: None, warnings })
    }

    /// The same of a photograph, whose mask is made of its colours.
    pub(super) fn of_photograph(
        picture: &PictureSource,
        options: GoalOptions,
        size: u32,
    ) -> Result<Self, PrepareError> {
        let picture = picture.read()?;
        let PictureSource::Encoded(encoded) = &*picture else {
            // Ink needs no mask.
            return Ok(Self::read(&picture, options, size)?);
        };
        let photo = Photo::from_encoded(encoded)?;
        let mask = Mask::from_photo(&photo, &MaskOptions::default())
            .map_err(|source| PrepareError::Mask { path: encoded.name().to_owned(), source })?;
        drop(photo);
        let pair = Self::read(&PictureSource::Ink(mask.bitmap.clone()), options, size)?;
        Ok(Self { warnings: mask.warnings.clone(), mask: Some(mask), ..pair })
    }
}
