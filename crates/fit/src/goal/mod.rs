//! A whole fit: a first guess, the search, and the assessment of its result.

mod deadline;
mod driven;
mod fit_goal;
mod settings;
mod stages;
mod stepwise;
mod stepwise_race;

pub use deadline::Deadline;
pub use driven::Asked;
pub use fit_goal::{fit_goal, fit_goal_with};
pub use settings::{Fitted, GoalSettings, Guessing};
pub use stepwise::Stepwise;
pub use stepwise_race::StepwiseRace;
