//! The search for several individuals.

use super::search;
use super::task::{FoundIndividual, IndividualProgress, IndividualSettings, Task};
use crate::control::Clock;
use crate::error::FitError;
use crate::problem::{FitProblem, Genome};
use pleach_tree::Limits;
use std::sync::atomic::AtomicBool;

/// Searches individuals of `problem`'s goals among the trees of the kind that `genome` is, and returns them with
/// the best first. The first search begins with the tree of the genome's own seed; further ones with trees that
/// are drawn again from the trunk up. Empty if stems have no addresses, or the tree does not grow.
///
/// The same problem, genome and number of trees give the same individuals on any number of threads.
///
/// # Errors
/// Problems that [`crate::Evaluator::new`] refuses, and [`FitError::Interrupted`] once `stop` is raised.
pub fn individuals(
    problem: &FitProblem,
    genome: &Genome,
    settings: IndividualSettings,
    clock: &dyn Clock,
    stop: &AtomicBool,
    mut notify: impl FnMut(&IndividualProgress),
) -> Result<Vec<FoundIndividual>, FitError> {
    let count = settings.count.clamp(1, IndividualSettings::MAX_COUNT);
    let from = clock.elapsed();
    let mut all = Vec::new();
    for number in 0..count {
        // The time that one leaves is shared by those after it.
        let left = u32::from(count - number);
        let passed = clock.elapsed().saturating_sub(from);
        let share = IndividualSettings {
            time: settings.time.map(|time| time.saturating_sub(passed) / left),
            trees: settings.trees.map(|trees| trees.div_ceil(u64::from(count))),
            ..settings
        };
        let task = Task { problem, genome, settings: share, limits: Limits::DEFAULT, stop };
        let notify = |progress: &IndividualProgress| {
            notify(&IndividualProgress {
                used: (f64::from(number) + progress.used) / f64::from(count),
                ..*progress
            });
        };
        all.extend(search::search(&task, number, clock, notify)?);
    }
    all.sort_by(|a: &FoundIndividual, b| a.score.cost.total_cmp(&b.score.cost));
    Ok(all)
}
