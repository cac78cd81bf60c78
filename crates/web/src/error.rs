//! Errors as JavaScript throws them.

use js_sys::{Error, Reflect};
use std::fmt::Display;
use wasm_bindgen::{JsError, JsValue};

/// What went wrong, in the words of the library.
#[allow(clippy::needless_pass_by_value, reason = "for `map_err`")]
pub(crate) fn thrown(error: impl Display) -> JsError {
    JsError::new(&error.to_string())
}

/// What keeps a grammar from growing, with the line that it is about.
pub(crate) fn thrown_at(error: impl Display, line: Option<usize>) -> JsValue {
    let thrown = Error::new(&error.to_string());
    if let Some(line) = line {
        // Setting a property of a new object cannot fail.
        let _ = Reflect::set(&thrown, &JsValue::from_str("line"), &JsValue::from_f64(line as f64));
    }
    thrown.into()
}
