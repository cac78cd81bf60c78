//! The search of a fit: a method at work on a problem, within a budget, observed and saved.

mod checkpoint;
mod driver;
mod fingerprint;
mod fit;
mod settings;

pub use checkpoint::{BodyProblem, CheckpointError, is_checkpoint};
pub(crate) use driver::Course;
pub use fit::{evaluator, fit, settled};
pub(crate) use fit::{evaluator_in, search_space};
pub use settings::{FIT_LIMITS, FitSettings};
