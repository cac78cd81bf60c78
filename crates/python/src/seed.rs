//! Seeds, as users give them.

use crate::error::PleachError;
use pyo3::prelude::*;
use pyo3::types::PyBool;

/// The seed of a tree or of a search: a whole number from 0 to 2⁶⁴ − 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seed(pub(crate) u64);

impl<'py> FromPyObject<'_, 'py> for Seed {
    type Error = PyErr;

    fn extract(given: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        let is_switch = given.is_instance_of::<PyBool>();
        let number = if is_switch { None } else { given.extract::<u64>().ok() };
        number.map(Self).ok_or_else(|| {
            let shown = given.repr().map_or_else(|_| "?".to_owned(), |shown| shown.to_string());
            let shown: String = shown.chars().take(60).collect();
            PleachError::new_err(format!("a seed is {shown}, expected a whole number from 0 to {}", u64::MAX))
        })
    }
}
