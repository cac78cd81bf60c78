//! The settings of optimisers, declared: what each may be.
//!
//! The types of settings, such as [`crate::CmaSettings`], say what a setting does; this says which values make sense, so that
//! a program that reads one from a command line can refuse the others in plain words.

use SettingKind::{Count, Flag, Number, Word};
use std::fmt;

/// One setting of an optimiser.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// The optimiser, as on the command line.
    pub optimizer: &'static str,
    /// Its name.
    pub name: &'static str,
    /// What it may be.
    pub kind: SettingKind,
}

/// What a setting may be.
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

/// More individuals than this at once, or generations without success, serve nobody.
const MANY: u64 = 100_000;

/// The names of [`crate::Merge`].
const MERGES: [&str; 3] = ["Both", "Uniform", "Mean"];

const fn setting(optimizer: &'static str, name: &'static str, kind: SettingKind) -> Setting {
    Setting { optimizer, name, kind }
}

/// All settings of all optimisers.
pub const SETTINGS: [Setting; 34] = [
    setting("evolution", "first", Count(1, MANY)),
    setting("evolution", "parents", Count(2, MANY)),
    setting("evolution", "children", Count(1, MANY)),
    setting("evolution", "brood", Count(1, MANY)),
    setting("evolution", "lag", Count(0, MANY)),
    setting("evolution", "step", Number(1e-6, 1.0)),
    setting("evolution", "sparsity", Number(0.0, 1.0)),
    setting("evolution", "greed", Number(0.1, 100.0)),
    setting("evolution", "patience", Count(1, MANY)),
    setting("evolution", "lanes", Count(1, MANY)),
    setting("evolution", "match_height", Flag),
    setting("evolution", "prior", Number(0.0, 100.0)),
    setting("cma", "population", Count(0, MANY)),
    setting("cma", "first", Count(1, MANY)),
    setting("cma", "sparsity", Number(0.0, 1.0)),
    setting("cma", "step", Number(1e-6, 1.0)),
    setting("cma", "near_step", Number(1e-6, 1.0)),
    setting("cma", "reseed", Number(0.0, 1.0)),
    setting("cma", "patience", Number(0.01, 1000.0)),
    setting("de", "population", Count(4, MANY)),
    setting("de", "first", Count(1, MANY)),
    setting("de", "sparsity", Number(0.0, 1.0)),
    setting("de", "history", Count(1, MANY)),
    setting("de", "best", Number(0.0, 1.0)),
    setting("de", "archive", Number(0.0, 100.0)),
    setting("de", "reseed", Number(0.0, 1.0)),
    setting("de", "patience", Count(1, MANY)),
    setting("hewitt", "population", Count(2, MANY)),
    setting("hewitt", "step", Number(1e-6, 100.0)),
    setting("hewitt", "flip_chance", Number(0.0, 1.0)),
    setting("hewitt", "zero_share", Number(0.0, 1.0)),
    setting("hewitt", "merge", Word(&MERGES)),
    setting("hewitt", "only_read", Flag),
    setting("random", "population", Count(1, MANY)),
];

impl Setting {
    /// The setting called `name` of the optimiser called `optimizer`.
    #[must_use]
    pub fn find(optimizer: &str, name: &str) -> Option<&'static Self> {
        SETTINGS.iter().find(|setting| (setting.optimizer, setting.name) == (optimizer, name))
    }

    /// What `text` means, as the settings' JSON has it; none if it is not one of the values.
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
    use crate::optimizer::Optimizer;
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
