//! Optimisers by name, with settings as text.

use pleach_fit::{Optimizer, Setting, SettingKind, UnknownOptimizer};
use serde_json::{Map, Value};

/// The optimiser called `name` with some of its settings replaced, each a key and a value as text.
///
/// ```
/// let cma = pleach::optimizer_with("cma", [("population", "20")])?;
/// assert_eq!(cma.name(), "cma");
/// # Ok::<(), pleach::SettingError>(())
/// ```
///
/// # Errors
/// A name that no optimiser has, a key that no setting has, a value that is not in its range, and settings that do not
/// fit together.
pub fn optimizer_with(
    name: &str,
    settings: impl IntoIterator<Item = (impl AsRef<str>, impl AsRef<str>)>,
) -> Result<Optimizer, SettingError> {
    let optimizer: Optimizer = name.parse()?;
    let mut fields = settings_of(&optimizer);
    let mut given = Vec::new();
    for (key, text) in settings {
        let (key, text) = (key.as_ref(), text.as_ref());
        let unknown = || SettingError::Unknown {
            optimizer: optimizer.name(),
            key: key.to_owned(),
            known: fields.keys().cloned().collect(),
        };
        let declared = Setting::find(optimizer.name(), key).ok_or_else(unknown)?;
        let value = declared.read(text).ok_or_else(|| SettingError::Value {
            key: key.to_owned(),
            given: text.to_owned(),
            expected: declared.kind,
        })?;
        let _ = fields.insert(key.to_owned(), value);
        given.push(format!("{key}={text}"));
    }
    if given.is_empty() {
        return Ok(optimizer);
    }
    let all = Value::Object(Map::from_iter([(optimizer.name().to_owned(), Value::Object(fields))]));
    serde_json::from_value(all)
        .map_err(|_| SettingError::Together { optimizer: optimizer.name(), given: given.join(" ") })
}

/// All settings of an optimiser and their values; see [`Setting::find`] for what each may be.
#[must_use]
pub fn settings_of(optimizer: &Optimizer) -> Map<String, Value> {
    // An optimiser is written as an object of one object.
    match serde_json::to_value(optimizer).map(|mut value| value[optimizer.name()].take()) {
        Ok(Value::Object(fields)) => fields,
        _ => Map::new(),
    }
}

/// Why there is no such optimiser.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SettingError {
    /// A name that no optimiser has.
    #[error(transparent)]
    Optimizer(#[from] UnknownOptimizer),
    /// A key that no setting has.
    #[error("`{optimizer}` has no setting `{key}`, known are {}", known.join(", "))]
    Unknown {
        /// The optimiser.
        optimizer: &'static str,
        /// What was given.
        key: String,
        /// The settings that it has.
        known: Vec<String>,
    },
    /// A value that is not in the setting's range.
    #[error("`{key}={given}`: expected {expected} for `{key}`")]
    Value {
        /// The setting.
        key: String,
        /// What was given.
        given: String,
        /// What it may be.
        expected: SettingKind,
    },
    /// Values that are allowed one by one.
    #[error("the settings of `{optimizer}` do not fit together: {given}")]
    Together {
        /// The optimiser.
        optimizer: &'static str,
        /// What was given.
        given: String,
    },
}
