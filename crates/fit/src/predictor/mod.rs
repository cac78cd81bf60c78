//! The numbers of a tree from its picture, by regression: learnt once from many trees, and then a sum for each number.

mod basis;
mod cloud;
mod examples;
mod numbers;
mod packed;
mod predictors;

pub use predictors::{Answer, LearntParts, PredictorError, Predictors};
