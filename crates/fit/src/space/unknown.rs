//! The numbers of a problem that are not the tree's: what is not known of its views.

use super::gene::{Gene, Place};
use crate::problem::GoalView;
use pleach_tree::Kind;

/// The genes of all unknown numbers, and their default values.
pub(super) fn genes(goals: &[GoalView]) -> (Vec<Gene>, Vec<f64>) {
    let numbers = goals.iter().flat_map(|goal| goal.unknown.numbers(&goal.view));
    let gene = |(number, (nuisance, low, high, usual))| {
        let place = Place::Nuisance { number, nuisance };
        (Gene { place, kind: Kind::Real { min: low, max: high }, low, high }, usual)
    };
    numbers.enumerate().map(gene).unzip()
}
