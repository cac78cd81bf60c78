//! Declarations of the settings of optimisers: allowed values.
//!
//! The types of settings, such as [`crate::CmaSettings`], document the settings; these declarations have their
//! allowed values, so that a program can check those from a command line.

use SettingKind::{Count, Flag, Number, Word};
use std::fmt;

/// One setting of an optimiser.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// The optimiser, as on the command line.
    pub optimizer: &'static str,
    /// Its name.
    pub name: &'static str,
    /// Its allowed values.
    pub kind: SettingKind,
}

/// The allowed values of a setting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SettingKind {
    /// A whole number, from the first to the second.
    Count(u64, u64),
    /// A number, from the first to the second.
    Number(f64, f64),
    /// A switch.
    Flag,
    /// One of these words.
    Word(&'static [&'static str]),
}

/// Upper bound of all counts.
const MAX_COUNT: u64 = 100_000;

/// The names of [`crate::Merge`].
const MERGES: [&str; 3] = ["Both", "Uniform", "Mean"];

const fn setting(optimizer: &'static str, name: &'static str, kind: SettingKind) -> Setting {
    Setting { optimizer, name, kind }
}

/// All settings of all optimisers.
pub const SETTINGS: [Setting; 34] = [
    setting("evolution", "first", Count(1, MAX_COUNT)),
    setting("evolution", "parents", Count(2, MAX_COUNT)),
    setting("evolution", "children", Count(1, MAX_COUNT)),
    setting("evolution", "batch", Count(1, MAX_COUNT)),
    setting("evolution", "staleness", Count(0, MAX_COUNT)),
    setting("evolution", "step", Number(1e-6, 1.0)),
    setting("evolution", "sparsity", Number(0.0, 1.0)),
    setting("evolution", "selection_pressure", Number(0.1, 100.0)),
    setting("evolution", "patience", Count(1, MAX_COUNT)),
    setting("evolution", "islands", Count(1, MAX_COUNT)),
    setting("evolution", "match_height", Flag),
    setting("evolution", "prior", Number(0.0, 100.0)),
    setting("cma", "population", Count(0, MAX_COUNT)),
    setting("cma", "first", Count(1, MAX_COUNT)),
    setting("cma", "sparsity", Number(0.0, 1.0)),
    setting("cma", "step", Number(1e-6, 1.0)),
    setting("cma", "near_step", Number(1e-6, 1.0)),
    setting("cma", "reseed", Number(0.0, 1.0)),
    setting("cma", "patience", Number(0.01, 1000.0)),
    setting("de", "population", Count(4, MAX_COUNT)),
    setting("de", "first", Count(1, MAX_COUNT)),
    setting("de", "sparsity", Number(0.0, 1.0)),
    setting("de", "history", Count(1, MAX_COUNT)),
    setting("de", "best", Number(0.0, 1.0)),
    setting("de", "archive", Number(0.0, 100.0)),
    setting("de", "reseed", Number(0.0, 1.0)),
    setting("de", "patience", Count(1, MAX_COUNT)),
    setting("hewitt", "population", Count(2, MAX_COUNT)),
    setting("hewitt", "step", Number(1e-6, 100.0)),
    setting("hewitt", "flip_chance", Number(0.0, 1.0)),
    setting("hewitt", "zero_share", Number(0.0, 1.0)),
    setting("hewitt", "merge", Word(&MERGES)),
    setting("hewitt", "only_read", Flag),
    setting("random", "population", Count(1, MAX_COUNT)),
];

impl Setting {
    /// The setting called `name` of the optimiser called `optimizer`.
    #[must_use]
    pub fn find(optimizer: &str, name: &str) -> Option<&'static Self> {
        SETTINGS.iter().find(|setting| (setting.optimizer, setting.name) == (optimizer, name))
    }

    /// The value of `text` in the settings' JSON; `None` if it is not allowed.
    #[must_use]
    pub fn read(&self, text: &str) -> Option<serde_json::Value> {
        match self.kind {
            Count(least, most) => {
                text.parse::<u64>().ok().filter(|n| (least..=most).contains(n)).map(Into::into)
            }
            Number(least, most) => {
                text.parse::<f64>().ok().filter(|n| (least..=most).contains(n)).map(Into::into)
            }
            Flag => text.parse::<bool>().ok().map(Into::into),
            Word(words) => words.contains(&text).then(|| text.into()),
        }
    }
}

impl fmt::Display for SettingKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Count(least, most) => write!(f, "a whole number from {least} to {most}"),
            Number(least, most) => write!(f, "a number from {least} to {most}"),
            Flag => f.write_str("true or false"),
            Word(words) => f.write_str(&words.join(" or ")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::Optimizer;
    use serde_json::Value;

    /// As the JSON of an optimiser's settings has them.
    fn defaults(name: &str) -> Vec<(String, Value)> {
        let value = serde_json::to_value(name.parse::<Optimizer>().unwrap()).unwrap();
        value[name].as_object().unwrap().clone().into_iter().collect()
    }

    #[test]
    fn every_setting_is_declared_once_and_its_default_is_allowed() {
        let mut declared = 0;
        for optimizer in Optimizer::NAMES {
            for (name, value) in defaults(optimizer) {
                let setting = Setting::find(optimizer, &name).unwrap_or_else(|| panic!("{optimizer} {name}"));
                let text = value.as_str().map_or_else(|| value.to_string(), str::to_owned);
                assert_eq!(setting.read(&text), Some(value), "{optimizer} {name}: {}", setting.kind);
                declared += 1;
            }
        }
        assert_eq!(declared, SETTINGS.len());
    }

    #[test]
    fn what_makes_no_sense_is_refused() {
        let read = |name, text| Setting::find("evolution", name).unwrap().read(text);
        assert_eq!(read("children", "40"), Some(40.into()));
        for (name, text) in [
            ("children", "1e9"),
            ("children", "0"),
            ("children", "-1"),
            ("children", "100001"),
            ("step", "-1"),
            ("step", "nan"),
            ("step", "inf"),
            ("prior", "101"),
            ("match_height", "yes"),
        ] {
            assert_eq!(read(name, text), None, "{name}={text}");
        }
        let merge = Setting::find("hewitt", "merge").unwrap();
        assert_eq!(merge.read("nope"), None);
        for word in MERGES {
            let value = serde_json::json!({ "hewitt": { "merge": merge.read(word) } });
            let mut all = serde_json::to_value("hewitt".parse::<Optimizer>().unwrap()).unwrap();
            all["hewitt"]["merge"] = value["hewitt"]["merge"].clone();
            assert!(serde_json::from_value::<Optimizer>(all).is_ok(), "{word}");
        }
    }
}
