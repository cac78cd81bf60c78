//! The free numbers of a species: what they are called, and within what they lie.

use crate::arrays::numbers;
use crate::error::of_fit;
use crate::species::Species;
use pleach::{Freedom, Gene, Genome, SearchSpace, TreeSeed};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::Arc;

/// Names, kinds, bounds, values and scales of the genes of `space`; `values` has one for every slot.
pub(crate) fn described<'py>(
    py: Python<'py>,
    space: &SearchSpace,
    values: &[f64],
) -> PyResult<Bound<'py, PyDict>> {
    let genes = space.genes();
    let params = space.params();
    let names = genes.iter().filter_map(Gene::slot).map(|slot| params.slot_name(slot));
    let own = Genome::new(values.to_vec(), 0);
    let column = |of: &dyn Fn(&Gene) -> f64| numbers(py, genes.iter().map(of).collect());
    let dict = PyDict::new(py);
    dict.set_item("names", names.collect::<Vec<_>>())?;
    dict.set_item("kinds", genes.iter().map(|gene| gene.kind.word()).collect::<Vec<_>>())?;
    dict.set_item("is_log", genes.iter().map(Gene::is_log).collect::<Vec<_>>())?;
    dict.set_item("lower", column(&|gene| gene.low))?;
    dict.set_item("upper", column(&|gene| gene.high))?;
    dict.set_item("start", column(&|gene| gene.get(&own)))?;
    Ok(dict)
}

/// The free numbers of a species without a goal: see `pleach.Numbers`.
#[pyfunction]
pub(crate) fn numbers_of<'py>(
    py: Python<'py>,
    species: &Species,
    free: Vec<String>,
    fix: Vec<String>,
    wide: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let kind = species.inner.kind();
    let values = kind.params.values();
    let (generator, freedom) = (Arc::clone(&kind.generator), Freedom { free, fix });
    // The seed is no number of the species.
    let mut space = SearchSpace::new(generator, values, &freedom, TreeSeed::Fixed(0)).map_err(of_fit)?;
    if !wide {
        space = space.plausible(values);
    }
    described(py, &space, values)
}
