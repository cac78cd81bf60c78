//! A picture of the tree at the two sizes that a fit needs.

use super::error::PrepareError;
use super::hints::MaskHints;
use super::source::{FitSource, PictureSource};
use pleach_reading::Colors;
use pleach_silhouette::goal::{Crop, GoalError, GoalWarning};
use pleach_silhouette::mask::{Mask, MaskOptions, Photo};
use pleach_silhouette::{Bitmap, Goal, GoalOptions};

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
    /// Reads a picture as `options` say, and reduces it to `size` pixels.
    pub(super) fn read(picture: &PictureSource, options: GoalOptions, size: u32) -> Result<Self, GoalError> {
        let full = picture.goal(&GoalOptions { crop: Crop::ToTree, max_side: None, ..options })?;
        let working = full.reduced(size)?;
        let warnings = full.warnings.clone();
        Ok(Self { full, working, mask: None, colors: colors_of_cut_out(picture), warnings })
    }

    /// The same of the goal of `source`, a photograph, whose mask is made of its colours and of what `hints` show.
    pub(super) fn of_photograph(
        source: &FitSource,
        hints: &MaskHints,
        options: GoalOptions,
        size: u32,
    ) -> Result<Self, PrepareError> {
        let picture = source.goal.read()?;
        let PictureSource::Encoded(encoded) = &*picture else {
            // Ink needs no mask.
            return Ok(Self::read(&picture, options, size)?);
        };
        let photo = Photo::from_encoded(encoded)?;
        let mask = Mask::from_photo(&photo, &hints.over(MaskOptions::default(), &photo, source)?)
            .map_err(|source| PrepareError::Mask { path: encoded.name().to_owned(), source })?;
        let colors = Colors::read(&photo, &mask.bitmap).ok();
        drop(photo);
        let pair = Self::read(&PictureSource::Ink(mask.bitmap.clone()), options, size)?;
        Ok(Self { warnings: mask.warnings.clone(), mask: Some(mask), colors, ..pair })
    }
}

/// Opacity from which a pixel of a cut-out is tree, as in [`Mask::from_photo`].
const OPAQUE: u8 = 128;

/// The colours of a picture whose alpha channel says what is tree.
fn colors_of_cut_out(picture: &PictureSource) -> Option<Colors> {
    if matches!(picture, PictureSource::Ink(_)) {
        return None;
    }
    let photo = picture.photo().ok()?;
    let width = photo.width() as usize;
    let pixels = photo.pixels();
    let tree = Bitmap::from_fn(photo.width(), photo.height(), |x, y| {
        pixels[y as usize * width + x as usize][3] >= OPAQUE
    });
    // Without transparent pixels nothing is cut out.
    if tree.ink() == tree.area() { None } else { Colors::read(&photo, &tree).ok() }
}
