//! The nuisance parameters of a problem: the unknowns of its views.

use super::gene::{Gene, Place};
use crate::problem::GoalView;
use crate::problem::Nuisance;
use pleach_tree::Kind;
use pleach_tree::param::Scale;

/// The genes of all unknown numbers, and their default values.
pub(super) fn genes(goals: &[GoalView]) -> (Vec<Gene>, Vec<f64>) {
    let numbers = goals.iter().flat_map(|goal| goal.unknown.numbers(&goal.view));
    let gene = |(number, (nuisance, low, high, usual))| {
        let place = Place::Nuisance { number, nuisance };
        // An azimuth has no neutral value; an error of the frame may be absent.
        let neutral = (nuisance != Nuisance::Azimuth).then_some(0.0);
        let kind = Kind::real(low, high);
        (Gene { place, kind, scale: Scale::Linear, neutral, low, high }, usual)
    };
    numbers.enumerate().map(gene).unzip()
}
