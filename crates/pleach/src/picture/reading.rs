//! What is in a picture of a tree, before anything is fitted to it.

use super::corrections::Changes;
use super::error::PrepareError;
use super::goal_pair::{GoalPair, masked};
use super::goal_reading::GoalReading;
use super::options::FitOptions;
use super::source::FitSource;
use crate::option_error::OptionError;
use pleach_reading::{Reader, Reading, annotate};
use pleach_silhouette::goal::GoalWarning;
use pleach_silhouette::mask::Mask;
use pleach_silhouette::picture::Picture;
use pleach_silhouette::{Bitmap, Goal, GoalOptions};

/// A picture of a tree, and what is in it: see [`read_picture`].
#[derive(Clone, Debug)]
pub struct PictureReading {
    /// What is in it.
    pub found: GoalReading,
    /// The tree as ink, of the size of the picture.
    pub silhouette: Bitmap,
    /// The mask that was made of a photograph.
    pub mask: Option<Mask>,
}

impl PictureReading {
    /// The measures drawn over the tree.
    #[must_use]
    pub fn annotated(&self) -> Picture {
        annotate(&self.silhouette, &self.found.measures)
    }
}

/// Reads what is in a picture of a tree: how many trunks, leaning how far, bare to what height, the outline of the
/// crown. What looks like a photograph is masked first, unless `options` say what is tree.
///
/// Of `options` those about the goal's picture are used: [`FitOptions::mask`], [`FitOptions::hints`],
/// [`FitOptions::tree`], [`FitOptions::wood`] and [`FitOptions::reading`].
///
/// ```
/// use pleach::{FitOptions, View, read_picture};
///
/// let goal = pleach::silhouette(&pleach::species("acer")?.grow(7)?, View::FRONT, 256);
/// let read = read_picture(goal, &FitOptions::default())?;
/// assert_eq!(read.found.measures.feet.len(), 1);
/// print!("{}", read.found.measures);
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
    if options.is_photograph() {
        return of_photograph(&source, options);
    }
    let by_tone = source.goal.goal(&options.goal_options());
    let looks_as_photo =
        by_tone.as_ref().map_or(true, |goal| goal.warnings.contains(&GoalWarning::Photograph));
    if options.mask.is_none()
        && looks_as_photo
        && let Ok(read) = of_photograph(&source, options)
    {
        return Ok(read);
    }
    let Goal { bitmap: silhouette, warnings, .. } = by_tone?;
    let measures = options.measure(&source, &silhouette)?;
    let colors = source.colors();
    let found = options.corrected(GoalReading::new(measures, colors, None, warnings))?.0;
    Ok(PictureReading { found, silhouette, mask: None })
}

fn of_photograph(source: &FitSource, options: &FitOptions) -> Result<PictureReading, PrepareError> {
    let (mask, colors) = masked(source, &options.hints)?;
    let measures = options.measure(source, &mask.bitmap)?;
    let found = GoalReading::new(measures, colors, Some(&mask), mask.warnings.clone());
    let found = options.corrected(found)?.0;
    Ok(PictureReading { found, silhouette: mask.bitmap.clone(), mask: Some(mask) })
}

impl FitOptions {
    /// What is in the goal of `source`, which was read as `pair`; and, where it was corrected, what a first guess takes
    /// to be in the smaller picture that it compares.
    pub(super) fn read(
        &self,
        source: &FitSource,
        pair: &GoalPair,
    ) -> Result<(GoalReading, Option<Reading>), PrepareError> {
        // A mask of wood is of the picture as it came.
        let whole;
        let silhouette = match (&pair.mask, &self.wood) {
            (Some(mask), _) => &mask.bitmap,
            (None, Some(_)) => {
                whole = source.goal.goal(&self.goal_options())?.bitmap;
                &whole
            }
            (None, None) => &pair.full.bitmap,
        };
        let measures = self.measure(source, silhouette)?;
        let found =
            GoalReading::new(measures, pair.colors.clone(), pair.mask.as_ref(), pair.warnings.clone());
        let (found, changes) = self.corrected(found)?;
        if changes.keep_measures() {
            return Ok((found, None));
        }
        let mut working = Reading::from_silhouette(&pair.working.bitmap);
        changes.apply_to_measures(&mut working)?;
        Ok((found, Some(working)))
    }

    /// `found` with [`FitOptions::reading`], and what that changed.
    fn corrected(&self, mut found: GoalReading) -> Result<(GoalReading, Changes), OptionError> {
        let changes = self.reading.changes(&found)?;
        changes.apply(&mut found)?;
        Ok((found, changes))
    }

    /// What is in the goal of `source`, whose tree is `silhouette`.
    fn measure(&self, source: &FitSource, silhouette: &Bitmap) -> Result<Reading, PrepareError> {
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
