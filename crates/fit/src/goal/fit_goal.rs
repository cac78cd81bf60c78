//! A whole fit in one call.

use super::settings::{Fitted, GoalSettings};
use super::stages::{begin, conclude};
use crate::control::Control;
use crate::error::FitError;
use crate::guess::GuessLibrary;
use crate::problem::FitProblem;
use crate::run::fit;

/// Fits a goal: guesses the species that it looks like, searches from there, and assesses the result.
///
/// Observers are notified of every step. Raising the flag of `control` ends the fit soon: the result of the search
/// until then is returned without an assessment. The same problem and settings give the same result, as
/// [`fit`] does. A resumed fit makes its first guess again and then goes on with the search.
///
/// ```
/// use pleach_fit::{Budget, Candidate, Control, FitProblem, FitSettings, GoalSettings, GoalView, fit_goal};
/// use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
/// use pleach_tree::Parts;
///
/// let known = ["palm", "lombardy_poplar"].map(|name| pleach_generators::preset(name).unwrap());
/// // A goal: the picture of a tree. Those of photographs come from `pleach_silhouette::goal::Goal`.
/// let tree = known[1].grow(7)?;
/// let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 64, 64);
/// let mut picture = Bitmap::default();
/// Rasterizer::new().draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut picture);
///
/// let problem = FitProblem::new(known[0].clone(), GoalView::new(picture, View::FRONT, frame));
/// let search = FitSettings { budget: Budget::evaluations(100), ..FitSettings::default() };
/// let settings = GoalSettings { search, ..GoalSettings::new(known.map(Candidate::from).into()) };
/// let started = std::time::Instant::now();
/// let (clock, stop) = (|| started.elapsed(), std::sync::atomic::AtomicBool::new(false));
/// let fitted = fit_goal(&problem, &settings, Control::new(&clock, &stop))?;
///
/// assert_eq!(fitted.guess.as_ref().unwrap().names[0].0, "lombardy_poplar");
/// println!("{}", fitted.species()?.to_toml(&[]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// See [`FitError`]: among others [`FitError::Interrupted`] before anything was found.
pub fn fit_goal(
    problem: &FitProblem,
    settings: &GoalSettings,
    control: Control<'_>,
) -> Result<Fitted, FitError> {
    fit_goal_with(problem, settings, &mut GuessLibrary::new().for_one_goal(), control)
}

/// [`fit_goal`] with a library of the candidates' trees that is kept from goal to goal.
///
/// # Errors
/// As [`fit_goal`].
pub fn fit_goal_with(
    problem: &FitProblem,
    settings: &GoalSettings,
    library: &mut GuessLibrary,
    mut control: Control<'_>,
) -> Result<Fitted, FitError> {
    let prepared = begin(problem, settings, library, &mut control)?;
    let outcome = fit(&prepared.problem, &prepared.settings, control.reborrow())?;
    conclude(prepared, outcome, settings, library, control)
}
