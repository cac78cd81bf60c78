//! From a picture to a tree: a whole fit, described once.
//!
//! 1. [`FitOptions`] say what is asked for. They are plain values, read from and written to JSON, and
//!    [`FitOptions::check`] says what is wrong with them.
//! 2. [`FitOptions::prepare`] reads the pictures of a [`FitSource`] and resolves the options against them: what is
//!    fitted, where the search starts, and how its time is shared out. The result is a [`Prepared`] fit.
//! 3. [`Prepared::fit`] runs it, or a [`crate::Stepwise`] does, batch by batch.
//! 4. [`Prepared::report`] draws and scores what was found: a [`FitReport`].
//!
//! [`fit_picture`] is all of it in one call. The program `pleach fit`, the Python package and the page in the browser
//! are made of these four steps, so that the same options give the same report in each.

mod corrections;
mod direction;
mod drawn;
mod effort;
mod error;
mod goal_pair;
mod goal_reading;
mod hints;
mod json;
mod next;
mod optimizer;
mod options;
mod parameters;
mod posterior;
mod prepared;
mod reading;
mod readings;
mod report;
mod report_parts;
mod sides;
mod source;
mod start;
mod volume;
mod words;

pub use corrections::Corrections;
pub use direction::{Direction, FurtherView};
pub use drawn::{FitDrawing, FittedTree};
pub use effort::{Effort, parse_duration};
pub use error::PrepareError;
pub use goal_pair::GoalPair;
pub use goal_reading::GoalReading;
pub use hints::MaskHints;
pub use next::NextStep;
pub use optimizer::{SettingError, optimizer_with, settings_of};
pub use options::{FitOptions, Spent};
pub use posterior::{NumberReport, PosteriorReport};
pub use prepared::{FurtherPicture, Prepared};
pub use reading::{PictureReading, read_picture};
pub use readings::Readings;
pub use report::{FitReport, ReportError, TIME_KEYS};
pub use report_parts::{
    IdentifiabilityCounts, IndividualReport, IntervalsReport, LooksLike, ParameterReport, RulesReport,
    SearchReport, ViewReport, best_of_each_family,
};
pub use sides::{SideTree, SidesReport};
pub use source::{FitSource, PictureSource};
pub use start::FitStart;
pub use words::{AppearanceFrom, KnownFrame, Leaves, MaskFrom, StartFrom, Tone, VolumeFrom};

use crate::plan::library;
use pleach_fit::{Control, FitError};

/// Finds the parameters of the tree in a picture: reads the picture, makes a first guess, searches, judges the result
/// and searches the goal's own tree, as the program `pleach fit` does.
///
/// The clock of `control` starts before the picture is read, so that [`FitOptions::timeout`] bounds all of it.
///
/// ```no_run
/// use pleach::{Control, FitOptions, fit_picture};
/// use std::sync::atomic::AtomicBool;
/// use std::time::{Duration, Instant};
///
/// let options = FitOptions { height: 18.0, timeout: Some(Duration::from_secs(20)), ..FitOptions::default() };
/// let (started, stop) = (Instant::now(), AtomicBool::new(false));
/// let report = fit_picture("oak.png", &options, Control::new(&|| started.elapsed(), &stop))?;
/// println!("IoU {:.3}: {}", report.scores.iou, report.best().species.to_toml(&[]));
/// # Ok::<(), pleach::PictureError>(())
/// ```
///
/// # Errors
/// A [`PictureError`]: options that cannot be, a picture that is not a goal, or a fit that found nothing, because
/// nothing grew or because it was interrupted too early.
pub fn fit_picture(
    source: impl Into<FitSource>,
    options: &FitOptions,
    control: Control<'_>,
) -> Result<FitReport, PictureError> {
    let prepared = options.prepare(&source.into())?;
    let fitted = prepared.fit(&mut library().for_one_goal(), control)?;
    Ok(prepared.report(fitted)?)
}

/// Why [`fit_picture`] found nothing.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PictureError {
    /// The options or the pictures are wrong.
    #[error(transparent)]
    Prepare(#[from] PrepareError),
    /// The fit failed.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// What was found cannot be drawn or scored.
    #[error(transparent)]
    Report(#[from] ReportError),
}
