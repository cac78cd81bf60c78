//! What is in a picture of a tree, before anything is fitted to it.

use super::error::PrepareError;
use super::goal_pair::GoalPair;
use super::options::FitOptions;
use super::source::FitSource;
use super::words::MaskFrom;
use pleach_reading::{Colors, Reader, Reading, annotate};
use pleach_silhouette::goal::GoalWarning;
use pleach_silhouette::mask::Mask;
use pleach_silhouette::picture::Picture;
use pleach_silhouette::{Bitmap, GoalOptions};
use serde::Serialize;
use std::borrow::Cow;

/// What is in a picture of a tree: see [`read_picture`].
#[derive(Clone, Debug, Serialize)]
pub struct PictureReading {
    /// The measures.
    #[serde(flatten)]
    pub reading: Reading,
    /// The colours of the tree, and the season; `None` of a picture without colours.
    pub colors: Option<Colors>,
    /// How likely the mask of a photograph is a good one, in 0..=1; `None` if the picture needed none.
    pub mask_confidence: Option<f64>,
    /// What about the picture, or its mask, is not as a fit expects.
    pub warnings: Vec<GoalWarning>,
    /// The tree as ink.
    #[serde(skip)]
    pub silhouette: Bitmap,
    /// The mask that was made of a photograph.
    #[serde(skip)]
    pub mask: Option<Mask>,
}

impl PictureReading {
    /// The measures drawn over the tree.
    #[must_use]
    pub fn annotated(&self) -> Picture {
        annotate(&self.silhouette, &self.reading)
    }
}

/// Reads what is in a picture of a tree: how many trunks, leaning how far, bare to what height, the outline of the
/// crown. What looks like a photograph is masked first, unless `options` say what is tree.
///
/// Of `options` those about the goal's picture are used: [`FitOptions::mask`], [`FitOptions::hints`],
/// [`FitOptions::tree`] and [`FitOptions::wood`].
///
/// ```
/// use pleach::{FitOptions, View, read_picture};
///
/// let goal = pleach::silhouette(&pleach::species("acer")?.grow(7)?, View::FRONT, 256);
/// let found = read_picture(goal, &FitOptions::default())?;
/// assert_eq!(found.reading.feet.len(), 1);
/// print!("{}", found.reading);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// The picture cannot be read, has no tree, or an option is wrong.
pub fn read_picture(
    source: impl Into<FitSource>,
    options: &FitOptions,
) -> Result<PictureReading, PrepareError> {
    let source = source.into();
    options.check()?;
    let by_tone = options.goal(&source);
    let says_nothing = options.mask.is_none() && options.hints.is_empty();
    let is_photo = says_nothing
        && by_tone.as_ref().map_or(true, |pair| pair.warnings.contains(&GoalWarning::Photograph));
    let pair = if is_photo {
        let masked = FitOptions { mask: Some(MaskFrom::Auto), ..options.clone() }.goal(&source);
        masked.or(by_tone)?
    } else {
        by_tone?
    };
    let silhouette = match &pair.mask {
        Some(mask) => mask.bitmap.clone(),
        // Without the margins that a fit compares.
        None => source.goal.goal(&options.goal_options())?.bitmap,
    };
    let mut reading = options.measure(&source, &silhouette)?;
    let GoalPair { mask, colors, warnings, .. } = pair;
    trust_colors(&mut reading, colors.as_ref());
    let mask_confidence = mask.as_ref().map(|mask| mask.confidence);
    Ok(PictureReading { reading, colors, mask_confidence, warnings, silhouette, mask })
}

/// Takes from colours whether there are leaves, where they say it more surely than the silhouette.
pub(super) fn trust_colors(reading: &mut Reading, colors: Option<&Colors>) {
    if let Some(colors) = colors
        && let Some(leaves) = colors.leaves
        && colors.leaves_confidence > reading.leaves_confidence
    {
        (reading.leaves, reading.leaves_confidence) = (leaves, colors.leaves_confidence);
    }
}

impl FitOptions {
    /// The tree of the goal, which was read as `pair`: a mask of wood is of the picture as it came.
    pub(super) fn silhouette<'a>(
        &self,
        source: &FitSource,
        pair: &'a GoalPair,
    ) -> Result<Cow<'a, Bitmap>, PrepareError> {
        Ok(match (&pair.mask, &self.wood) {
            (Some(mask), _) => Cow::Borrowed(&mask.bitmap),
            (None, Some(_)) => Cow::Owned(source.goal.goal(&self.goal_options())?.bitmap),
            (None, None) => Cow::Borrowed(&pair.full.bitmap),
        })
    }

    /// What is in the goal of `source`, whose tree is `silhouette`.
    pub(super) fn measure(&self, source: &FitSource, silhouette: &Bitmap) -> Result<Reading, PrepareError> {
        let (mut reader, mut reading) = (Reader::new(), Reading::default());
        match self.wood.as_deref() {
            Some(wood) => {
                let wood = source.picture(wood).goal(&GoalOptions::default())?;
                reader.read_with_wood(silhouette, &wood.bitmap, &mut reading)?;
            }
            None => reader.read(silhouette, &mut reading),
        }
        Ok(reading)
    }
}
