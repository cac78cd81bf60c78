//! The result of a search.

use super::budget::StopReason;
use super::history::Row;
use crate::problem::Scored;
use std::time::Duration;

/// The result of a search.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The best individual ever seen; `None` if the fit ended before its first evaluation.
    pub best: Option<Scored>,
    /// Former bests, oldest first, each by a fiftieth better than the one before it; at most seven.
    pub finalists: Vec<Scored>,
    /// Individuals evaluated, in all parts of a resumed run.
    pub evaluations: u64,
    /// Finished generations.
    pub generations: u64,
    /// Time by the caller's clock, in all parts of a resumed run.
    pub elapsed: Duration,
    /// The part of it that had passed when the search began: a first guess, where the clock was started before
    /// it.
    pub before_search: Duration,
    /// Why it ended.
    pub stop: StopReason,
    /// One row for every finished generation.
    pub history: Vec<Row>,
}
