//! Values that are JSON on the way.

use pyo3::prelude::*;
use pyo3::types::PyAnyMethods;
use serde_json::Value;

/// `value` as dicts, lists, strings and numbers.
pub(crate) fn to_python<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    py.import("json")?.call_method1("loads", (value.to_string(),))
}
