//! Values that are JSON on the way.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::Value;

/// `value` as dicts, lists, strings and numbers.
pub(crate) fn to_python<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    py.import("json")?.call_method1("loads", (value.to_string(),))
}

/// The dict as JSON; an empty object for none.
pub(crate) fn from_dict(dict: Option<&Bound<'_, PyDict>>) -> PyResult<String> {
    let Some(dict) = dict else { return Ok("{}".to_owned()) };
    dict.py().import("json")?.call_method1("dumps", (dict,))?.extract()
}
