//! How the known species look, drawn beforehand.

use pleach_fit::{
    Candidate, Drawings, FitError, FitProblem, FitSettings, GoalView, GuessLibrary, GuessSettings, Predictors,
};
use pleach_silhouette::{Bitmap, Frame, View};
use std::sync::atomic::AtomicBool;

/// Made by `cargo run --release -p pleach --example draw_known_species`.
static DRAWINGS: &[u8] = include_bytes!("known.bin");

/// Made by `cargo run --release -p pleach --example learn_known_species`.
static PREDICTORS: &[u8] = include_bytes!("predictors.bin");

/// A library of first guesses with these drawings of known species, if any: see [`library`], for hosts that load them.
///
/// It has seen many trees around every species of Weber and Penn's and of the space-colonisation generator: searches also
/// start from the numbers that they tell of the goal's picture.
///
/// # Panics
/// If the predictors that are built in are not of this version, which a test rules out.
#[must_use]
pub fn library_with(drawings: Option<Drawings>) -> GuessLibrary {
    let library = drawings.map_or_else(GuessLibrary::new, GuessLibrary::with_drawings);
    library.with_predictors(Predictors::from_bytes(PREDICTORS).expect("the predictors of this version"))
}

/// [`library_with`] drawings that are built in: it knows how the species of Weber and Penn's and of the space-colonisation generator look:
/// it grows them only for goals that were taken from elsewhere than the front or are not compared at 129 to 256 pixels, and where seeds are not
/// the usual ones.
///
/// # Panics
/// If the drawings or predictors that are built in are not of this version, which a test rules out.
#[must_use]
pub fn library() -> GuessLibrary {
    library_with(Some(Drawings::from_bytes(DRAWINGS).expect("the drawings of this version")))
}

/// Draws `species` as [`library`] knows them.
///
/// # Errors
/// A [`FitError`] if one of them cannot be fitted at all.
///
/// # Panics
/// If no species is given.
pub fn draw(species: impl IntoIterator<Item = pleach_tree::Species>) -> Result<Vec<u8>, FitError> {
    let candidates: Vec<Candidate> = species.into_iter().map(Candidate::from).collect();
    let start = candidates.first().expect("a species").species.clone();
    // Any goal as large as goals are by default; a square of a tree.
    let frame =
        Frame { width: 256, height: 256, meters_per_pixel: 0.04, axis_column: 128.0, ground_row: 250.0 };
    let goal = Bitmap::from_fn(256, 256, |x, y| (120..136).contains(&x) && (6..250).contains(&y));
    let problem = FitProblem::new(start, GoalView::new(goal, View::FRONT, frame));
    let (settings, guess) = (FitSettings::default(), GuessSettings::default());
    GuessLibrary::record(&problem, &settings, &candidates, &guess, &AtomicBool::new(false))
}
