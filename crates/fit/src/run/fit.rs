//! The search of a fit, from problem and settings to an outcome.

use super::driver::drive;
use super::fingerprint::Fingerprint;
use super::settings::FitSettings;
use crate::control::{Control, Outcome};
use crate::error::FitError;
use crate::evaluator::Evaluator;
use crate::method::Start;
use crate::problem::{FitProblem, Genome};
use crate::space::SearchSpace;
use pleach_tree::Slot;

/// Finds parameters that grow `problem`'s goals.
///
/// Evaluates on rayon's current thread pool. The result depends on `problem` and `settings` only, not on the
/// number of threads or on where a run was interrupted and resumed; a timeout decides only where it ends. This is
/// the search alone: see [`crate::fit_goal`] for a whole fit.
///
/// # Errors
/// See [`FitError`]; once the search runs, it ends with an [`Outcome`].
pub fn fit(problem: &FitProblem, settings: &FitSettings, control: Control<'_>) -> Result<Outcome, FitError> {
    let space = search_space(problem, settings)?;
    let evaluator = evaluator_in(&space, problem, settings)?;
    let fingerprint = Fingerprint::from_fit(problem, settings);
    match &settings.rules {
        None => drive(&evaluator, space, settings, &settings.optimizer, fingerprint, control),
        Some(rules) => {
            if space.variation().is_none() {
                let family = problem.start.generator.family();
                return Err(FitError::NoVariation { family });
            }
            // Given lists may grow large trees.
            let (work, leaves) = if settings.start == Start::Random {
                (MAX_WORK, MAX_LEAVES)
            } else {
                (10 * MAX_WORK, usize::MAX)
            };
            let evaluator = evaluator.with_limits(work, leaves);
            drive(&evaluator, space.priced(rules.price), settings, rules, fingerprint, control)
        }
    }
}

/// The evaluator that [`fit`] uses, for searches whose individuals are scored elsewhere.
///
/// # Errors
/// Those of [`fit`] on the same problem and settings.
pub fn evaluator(problem: &FitProblem, settings: &FitSettings) -> Result<Evaluator, FitError> {
    evaluator_in(&search_space(problem, settings)?, problem, settings)
}

pub(crate) fn evaluator_in(
    space: &SearchSpace,
    problem: &FitProblem,
    settings: &FitSettings,
) -> Result<Evaluator, FitError> {
    let evaluator = Evaluator::new(problem, settings.objective, settings.limits)?.with_seeds(settings.robust);
    let matches = settings.rules.is_some() || settings.optimizer.matches_height();
    Ok(if matches && space.sizes_are_free() { evaluator.with_height_matching() } else { evaluator })
}

/// Bound of [`pleach_tree::Limits::work`] for trees of a searched structure: a tenth of a second. Most changes of
/// a grammar that make it grow far do not make it better.
const MAX_WORK: u64 = 1_000_000;
/// Leaves of such a tree where the search begins from nothing: enough for a crown in a picture of 256
/// pixels, and half of the time goes into leaves.
const MAX_LEAVES: usize = 6_000;

/// The space that a fit searches: the free slots, in ranges that hold every start.
pub(crate) fn search_space(problem: &FitProblem, settings: &FitSettings) -> Result<SearchSpace, FitError> {
    let mut space = SearchSpace::from_problem(problem, &settings.freedom, settings.tree_seed)?;
    if settings.start == Start::Lists(Vec::new()) {
        return Err(FitError::NoStart);
    }
    for list in settings.start.lists() {
        space.widen(list)?;
    }
    let settles = settings.optimizer.matches_height() && space.sizes_are_free();
    if settings.optimizer.keeps_to_plausible() {
        let base = problem.start.params.values();
        space = space.plausible(settings.start.lists().first().map_or(base, Vec::as_slice));
    }
    // The same slot means something else in another structure.
    let prior = if settings.rules.is_some() { 0.0 } else { settings.optimizer.prior() };
    Ok(space.settling(settles).with_prior(settings.start.lists(), prior))
}

/// The slots of `genome` that the fit of `problem` has set to zero because one tree cannot show them:
/// see [`SearchSpace::settle`].
///
/// # Errors
/// Those of [`fit`] on the same problem and settings.
pub fn settled(problem: &FitProblem, settings: &FitSettings, genome: &Genome) -> Result<Vec<Slot>, FitError> {
    let mut slots = search_space(problem, settings)?.hidden_jitters(&genome.values);
    slots.retain(|&slot| genome.values[slot.index()] == 0.0);
    Ok(slots)
}
