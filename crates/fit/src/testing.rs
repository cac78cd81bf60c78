//! Small parameter spaces and costs for this crate's own tests.

use crate::evaluator::Evaluate;
use crate::problem::{Genome, Score, Size};
use pleach_tree::param::{Kind, Param, ParamSpace};
use std::sync::Arc;

/// A real number that is searched in `low..=high` and allowed ten times as far.
pub(crate) fn real(name: &'static str, low: f64, high: f64) -> Param {
    let reach = 10.0 * low.abs().max(high.abs());
    Param::scalar(name, Kind::real(-reach, reach), low).search([(low, high)]).neutral(0.0)
}

/// A whole number in `low..=high`.
pub(crate) fn integer(name: &'static str, low: i64, high: i64) -> Param {
    Param::scalar(name, Kind::integer(low, high), low as f64)
}

/// One of five names, from 0.
pub(crate) fn choice(name: &'static str) -> Param {
    Param::scalar(name, Kind::choice(0, ["a", "b", "c", "d", "e"]), 0.0)
}

/// A switch with a magnitude up to `max`.
pub(crate) fn flagged(name: &'static str, max: f64) -> Param {
    Param::scalar(name, Kind::flagged(max, "the other way"), -max).neutral(0.0)
}

pub(crate) fn params(list: Vec<Param>) -> Arc<ParamSpace> {
    Arc::new(ParamSpace::new(list).unwrap())
}

/// `dimensions` real numbers in `low..=high`.
pub(crate) fn cube(dimensions: usize, low: f64, high: f64) -> Arc<ParamSpace> {
    const NAMES: [&str; 20] =
        ["a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l", "m", "n", "o", "p", "q", "r", "s", "t"];
    params(NAMES[..dimensions].iter().map(|&name| real(name, low, high)).collect())
}

/// A plain function of the values as an objective.
pub(crate) struct Function(pub(crate) fn(&[f64]) -> f64);

impl Evaluate for Function {
    fn scores(&self, genomes: &[Genome], _: Size) -> Vec<Score> {
        genomes.iter().map(|genome| Score::from_cost((self.0)(&genome.values))).collect()
    }
}
