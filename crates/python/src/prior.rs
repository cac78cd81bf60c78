//! Trees around a species.

use crate::error::{PleachError, of_fit};
use crate::pool;
use crate::seed::Seed;
use crate::species::Species;
use pleach::{Freedom, Gene, NoSample, Prior};
use pyo3::prelude::*;
use rayon::prelude::*;

/// More are a mistake: all of them are held in memory.
const MAX_TREES: u32 = 1_000_000;

fn prior(species: &Species, spread: f64, free: Vec<String>, fix: Vec<String>) -> PyResult<Prior> {
    if !(0.0..=Prior::MAX_SPREAD).contains(&spread) {
        let most = Prior::MAX_SPREAD;
        return Err(PleachError::new_err(format!(
            "`spread` is {spread}, expected a number from 0 to {most}"
        )));
    }
    Prior::new(&species.inner.kind(), &Freedom { free, fix }, spread).map_err(of_fit)
}

/// The names of the numbers that vary.
#[pyfunction]
pub(crate) fn prior_slots(
    species: &Species,
    spread: f64,
    free: Vec<String>,
    fix: Vec<String>,
) -> PyResult<Vec<String>> {
    let space = species.inner.params.space();
    let prior = prior(species, spread, free, fix)?;
    Ok(prior.genes().filter_map(Gene::slot).map(|slot| space.slot_name(slot)).collect())
}

/// Trees of the prior, each with its seed; of those that do not grow what is wrong.
#[pyfunction]
#[pyo3(signature = (species, spread, free, fix, count, seed, threads))]
#[expect(clippy::too_many_arguments, reason = "called once, by `Prior.sample`")]
pub(crate) fn prior_sample(
    py: Python<'_>,
    species: &Species,
    spread: f64,
    free: Vec<String>,
    fix: Vec<String>,
    count: u32,
    seed: Seed,
    threads: Option<usize>,
) -> PyResult<Vec<Species>> {
    if count > MAX_TREES {
        return Err(PleachError::new_err(format!("{count} trees, expected at most {MAX_TREES} in one call")));
    }
    let prior = prior(species, spread, free, fix)?;
    let Seed(seed) = seed;
    let sample = |number| prior.try_sample(seed, number).map(|(species, _)| species.into());
    let drawn: Result<Vec<Species>, NoSample> =
        pool::on(py, threads, || (0..count).into_par_iter().map(sample).collect())?;
    drawn.map_err(|problem| PleachError::new_err(problem.to_string()))
}
