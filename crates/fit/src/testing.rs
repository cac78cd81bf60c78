//! Small parameter spaces and costs for this crate's own tests.

use crate::evaluate::Evaluate;
use crate::genome::{Genome, Score, Size};
use pleach_tree::param::{Kind, Layout, Param, ParamSpace, Unit};
use std::borrow::Cow;

fn param(name: &'static str, kind: Kind, low: f64, high: f64) -> Param {
    Param {
        name: name.into(),
        layout: Layout::Scalar,
        kind,
        search: Cow::Owned(vec![(low, high)]),
        unit: Unit::Ratio,
        default: Cow::Owned(vec![low]),
        group: "test",
        doc: "for tests".into(),
        source: "none",
    }
}

/// A real number that is searched in `low..=high` and allowed ten times as far.
pub(crate) fn real(name: &'static str, low: f64, high: f64) -> Param {
    let reach = 10.0 * low.abs().max(high.abs());
    param(name, Kind::Real { min: -reach, max: reach }, low, high)
}

/// A whole number in `low..=high`.
pub(crate) fn integer(name: &'static str, low: i64, high: i64) -> Param {
    param(name, Kind::Integer { min: low, max: high }, low as f64, high as f64)
}

/// One of five names, from 0.
pub(crate) fn choice(name: &'static str) -> Param {
    param(name, Kind::Choice { first: 0, names: &["a", "b", "c", "d", "e"] }, 0.0, 4.0)
}

/// A switch with a magnitude up to `max`.
pub(crate) fn flagged(name: &'static str, max: f64) -> Param {
    param(name, Kind::Flagged { max, negative: "the other way" }, -max, max)
}

pub(crate) fn params(list: Vec<Param>) -> ParamSpace {
    ParamSpace::new(list)
}

/// `dimensions` real numbers in `low..=high`.
pub(crate) fn cube(dimensions: usize, low: f64, high: f64) -> ParamSpace {
    const NAMES: [&str; 20] =
        ["a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l", "m", "n", "o", "p", "q", "r", "s", "t"];
    params(NAMES[..dimensions].iter().map(|&name| real(name, low, high)).collect())
}

/// A plain function of the values as an objective.
pub(crate) struct Function(pub(crate) fn(&[f64]) -> f64);

impl Evaluate for Function {
    fn scores(&self, genomes: &[Genome], _: Size) -> Vec<Score> {
        genomes.iter().map(|genome| Score::of_cost((self.0)(&genome.values))).collect()
    }
}
