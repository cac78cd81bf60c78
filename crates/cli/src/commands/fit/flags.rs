//! The options of a fit as they are called on the command line.

use anyhow::anyhow;
use pleach::{FitOptions, PrepareError};
use serde_json::Value;

/// The flag of an option whose key in JSON is `key`.
pub(in crate::commands) fn flag(key: &str) -> String {
    match key {
        "views" => "--view".to_owned(),
        "holdout_views" => "--holdout-view".to_owned(),
        "hints" => "--box (or --include, --exclude, --strokes)".to_owned(),
        _ => format!("--{}", key.replace('_', "-")),
    }
}

/// The keys of all options, and their values by default.
pub(super) fn defaults() -> serde_json::Map<String, Value> {
    match serde_json::to_value(FitOptions::default()) {
        Ok(Value::Object(options)) => options,
        _ => serde_json::Map::new(),
    }
}

/// `error` with options named as they are typed.
pub(in crate::commands) fn named(error: PrepareError) -> anyhow::Error {
    let PrepareError::Option(error) = error else { return error.into() };
    let text =
        defaults().keys().fold(error.to_string(), |text, key| text.replace(&format!("`{key}`"), &flag(key)));
    anyhow!(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_are_named_as_they_are_typed() {
        let wrong = FitOptions { free_frame: true, ..FitOptions::default() };
        let error = named(wrong.check().unwrap_err().into()).to_string();
        assert!(error.starts_with("--free-frame is about further pictures"), "{error}");
    }

    #[test]
    fn every_option_but_the_name_has_its_flag() {
        use clap::Args as _;
        let command = super::super::args::Fit::augment_args(clap::Command::new("fit"));
        let flags: Vec<String> =
            command.get_arguments().filter_map(|one| Some(format!("--{}", one.get_long()?))).collect();
        for key in defaults().keys().filter(|key| *key != "name") {
            // The first of several.
            let flag = flag(key);
            assert!(flags.iter().any(|known| flag.split(' ').next() == Some(known)), "{key}");
        }
    }
}
