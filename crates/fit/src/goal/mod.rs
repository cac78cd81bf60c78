//! A whole fit: a first guess, the search, and the assessment of its result.

mod deadline;
mod fit_goal;
mod settings;
mod stages;
mod stepwise;

pub use deadline::Deadline;
pub use fit_goal::{fit_goal, fit_goal_with};
pub use settings::{Fitted, GoalSettings, Guessing};
pub use stepwise::{Asked, Stepwise};
