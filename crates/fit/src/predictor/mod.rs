//! The numbers of a tree from its picture, by regression: learnt once from many trees, asked in a millisecond.

mod basis;
mod examples;
mod numbers;
mod packed;
mod predictors;

pub use predictors::{PredictorError, Predictors};
