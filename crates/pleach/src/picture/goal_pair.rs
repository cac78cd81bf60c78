//! A picture of the tree at the two sizes that a fit needs.

use super::error::PrepareError;
use super::hints::MaskHints;
use super::source::{FitSource, PictureSource};
use pleach_reading::Colors;
use pleach_silhouette::goal::{Crop, GoalError, GoalWarning};
use pleach_silhouette::mask::{Mask, MaskOptions};
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
    /// The tree's colours, where the picture has some: a photograph, or a cut-out.
    pub colors: Option<Colors>,
    /// What about the picture, or its mask, is not as a fit expects.
    pub warnings: Vec<GoalWarning>,
}

impl GoalPair {
    /// Reads a picture as `options` say, and reduces it to `size` pixels. Its colours are not looked at.
    pub(super) fn read(picture: &PictureSource, options: GoalOptions, size: u32) -> Result<Self, GoalError> {
        let full = picture.goal(&GoalOptions { crop: Crop::ToTree, max_side: None, ..options })?;
        let working = full.reduced(size)?;
        let warnings = full.warnings.clone();
        Ok(Self { full, working, mask: None, colors: None, warnings })
    }

    /// The same of the goal of `source`, a photograph, whose mask is made of its colours and of what `hints` show.
    pub(super) fn of_photograph(
        source: &FitSource,
        hints: &MaskHints,
        options: GoalOptions,
        size: u32,
    ) -> Result<Self, PrepareError> {
        if matches!(source.goal, PictureSource::Ink(_)) {
            // Ink needs no mask.
            return Ok(Self::read(&source.goal, options, size)?);
        }
        let (mask, colors) = masked(source, hints)?;
        let pair = Self::read(&PictureSource::Ink(mask.bitmap.clone()), options, size)?;
        Ok(Self { warnings: mask.warnings.clone(), mask: Some(mask), colors, ..pair })
    }
}

/// The mask of the goal of `source`, a photograph, and the colours of its tree.
pub(super) fn masked(source: &FitSource, hints: &MaskHints) -> Result<(Mask, Option<Colors>), PrepareError> {
    let photo = source.goal.photo()?;
    let mask = Mask::from_photo(&photo, &hints.over(MaskOptions::default(), &photo, source)?)
        .map_err(|error| PrepareError::Mask { path: source.goal.name().to_owned(), source: error })?;
    let colors = Colors::read(&photo, &mask.bitmap).ok();
    Ok((mask, colors))
}
