//! Options as JSON, and what is wrong with one.

use serde::de::DeserializeOwned;
use serde_json::{Map, Value};
use std::borrow::Cow;

/// An option with a value that cannot be. Options are named as the fields of [`crate::FitOptions`] and
/// [`crate::Export`], between backticks.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{option}` {problem}")]
#[non_exhaustive]
pub struct OptionError {
    /// The name of the field.
    pub option: Cow<'static, str>,
    /// What is wrong, and what would be right.
    pub problem: String,
}

impl OptionError {
    pub(crate) fn new(option: impl Into<Cow<'static, str>>, problem: impl Into<String>) -> Self {
        Self { option: option.into(), problem: problem.into() }
    }
}

/// Reads options from a JSON object, as their own `Deserialize` does, and says which of them is wrong: the first key
/// that is not an option, or whose value cannot be read.
pub(crate) fn from_json<T: DeserializeOwned>(text: &str) -> Result<T, OptionError> {
    let whole = |problem: String| OptionError::new("options", problem);
    let given: Map<String, Value> =
        serde_json::from_str(text).map_err(|error| whole(format!("are not a JSON object: {error}")))?;
    for (key, value) in &given {
        let alone = Value::Object(Map::from_iter([(key.clone(), value.clone())]));
        if let Err(error) = serde_json::from_value::<T>(alone) {
            let problem = format!("is {value}: {}", in_words(&error.to_string()));
            return Err(OptionError::new(key.clone(), problem));
        }
    }
    serde_json::from_value(Value::Object(given)).map_err(|error| whole(error.to_string()))
}

/// What serde expects, for people.
fn in_words(error: &str) -> String {
    let words = [
        ("expected a nonzero u32", "expected a whole number of 1 or more"),
        ("expected u64", "expected a whole number of 0 or more"),
        ("expected u32", "expected a whole number of 0 or more"),
        ("expected u8", "expected a whole number of 0 or more"),
        ("expected f64", "expected a number"),
        ("expected a string", "expected a text"),
        ("expected a boolean", "expected true or false"),
    ];
    words.iter().fold(error.to_owned(), |error, (from, to)| error.replace(from, to))
}
