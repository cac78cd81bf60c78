//! Individuals of a population: their shape and their order.

use crate::problem::{Genome, Score};
use crate::space::{Place, SearchSpace};

/// Whether `genome` has as many numbers as individuals of `space` have.
pub(crate) fn is_individual(genome: &Genome, space: &SearchSpace) -> bool {
    let nuisances = space.genes().iter().filter(|gene| matches!(gene.place, Place::Nuisance { .. })).count();
    genome.values.len() == space.params().len() && genome.nuisances.len() == nuisances
}

/// How many individuals a method of staleness 0 waits for; `None` if more batches are `pending` than it
/// ever asks for.
pub(crate) fn only_batch(pending: &[usize]) -> Option<usize> {
    match pending {
        [] => Some(0),
        [one] => Some(*one),
        _ => None,
    }
}

/// The numbers of `scores` from best to worst, ties by number.
pub(crate) fn ranking(scores: &[Score]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..scores.len()).collect();
    order.sort_by(|&a, &b| scores[a].cost.total_cmp(&scores[b].cost));
    order
}
