//! Errors as JavaScript throws them.

use std::fmt::Display;
use wasm_bindgen::JsError;

/// What went wrong, in the words of the library.
#[allow(clippy::needless_pass_by_value, reason = "for `map_err`")]
pub(crate) fn thrown(error: impl Display) -> JsError {
    JsError::new(&error.to_string())
}
