//! Arguments of `fit` that are more than a number.

use anyhow::{Context, bail};
use pleach_fit::{FitSettings, Optimizer, Setting, TreeSeed};
use serde_json::Value;
use std::fmt;
use std::num::NonZeroU32;
use std::time::Duration;

/// What the arguments ask for.
pub(super) enum Settings {
    /// A fit.
    Fit(Box<FitSettings>),
    /// The list of settings of an optimiser.
    Help,
}

/// Which tone of a picture is the tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Tone {
    /// Whichever does not fill the border
    Auto,
    /// The darker one
    Dark,
    /// The lighter one
    Light,
}

/// Scale and place of a tree in its picture, where they are known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct KnownFrame {
    pub(super) meters_per_pixel: f64,
    /// In pixels of the file from its left edge.
    pub(super) axis_column: f64,
    /// In pixels of the file from its top edge.
    pub(super) ground_row: f64,
}

impl fmt::Display for KnownFrame {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{},{},{}", self.meters_per_pixel, self.axis_column, self.ground_row)
    }
}

/// `METRES,COLUMN,ROW`.
pub(super) fn frame(text: &str) -> Result<KnownFrame, String> {
    let numbers: Option<Vec<f64>> =
        text.split(',').map(|part| part.trim().parse().ok().filter(|n: &f64| n.is_finite())).collect();
    match numbers.as_deref() {
        Some(&[meters_per_pixel, axis_column, ground_row]) if meters_per_pixel > 0.0 => {
            Ok(KnownFrame { meters_per_pixel, axis_column, ground_row })
        }
        _ => Err(
            "expected metres per pixel above 0, the column of the trunk's foot and the row of the ground, \
                  such as 0.05,128,250"
                .to_owned(),
        ),
    }
}

pub(super) fn positive(text: &str) -> Result<f64, String> {
    text.parse::<f64>()
        .ok()
        .filter(|v| *v > 0.0 && *v <= 1000.0)
        .ok_or_else(|| "expected a number of metres above 0 and up to 1000".to_owned())
}

/// Most trees that an individual is judged by: more than the spread of seeds needs.
const MAX_SEEDS: u32 = 64;

pub(super) fn seeds(text: &str) -> Result<NonZeroU32, String> {
    text.parse::<NonZeroU32>()
        .ok()
        .filter(|count| count.get() <= MAX_SEEDS)
        .ok_or_else(|| format!("expected a number of trees from 1 to {MAX_SEEDS}"))
}

pub(super) fn share(text: &str) -> Result<f64, String> {
    text.parse::<f64>()
        .ok()
        .filter(|v| (0.0..=1.0).contains(v))
        .ok_or_else(|| "expected a number from 0 to 1".to_owned())
}

/// `90s`, `10m`, `2h`, `500ms`, or plain seconds.
pub(super) fn duration(text: &str) -> Result<Duration, String> {
    let units = [("ms", 1e-3), ("s", 1.0), ("m", 60.0), ("h", 3600.0)];
    let (number, unit) =
        units.iter().find_map(|(name, unit)| Some((text.strip_suffix(name)?, *unit))).unwrap_or((text, 1.0));
    number
        .parse::<f64>()
        .ok()
        .map(|n| n * unit)
        .filter(|s| *s > 0.0 && *s <= 1e7)
        .map(Duration::from_secs_f64)
        .ok_or_else(|| "expected a time such as 90s, 10m or 2h".to_owned())
}

pub(super) fn tree_seed(text: &str) -> Result<TreeSeed, String> {
    if text == "any" {
        return Ok(TreeSeed::Any);
    }
    crate::input::seed(text).map(TreeSeed::Fixed).map_err(|e| format!("{e}, or `any`"))
}

/// The optimiser called `name` with `KEY=VALUE` settings applied.
pub(super) fn optimizer(name: &str, settings: &[String]) -> anyhow::Result<Optimizer> {
    let optimizer: Optimizer = name.parse()?;
    if settings.is_empty() {
        return Ok(optimizer);
    }
    let mut value = serde_json::to_value(&optimizer)?;
    let fields = fields(&mut value)?;
    for setting in settings {
        let (key, text) =
            setting.split_once('=').with_context(|| format!("`--set {setting}` is not KEY=VALUE"))?;
        let known: Vec<String> = fields.keys().cloned().collect();
        let Some(field) = fields.get_mut(key) else {
            bail!("`{name}` has no setting `{key}`, known are {}", known.join(", "));
        };
        let declared = Setting::find(name, key).context("every setting is declared")?;
        *field = declared
            .read(text)
            .with_context(|| format!("`--set {setting}`: expected {} for `{key}`", declared.kind))?;
    }
    serde_json::from_value(value)
        .with_context(|| format!("the settings of `{name}` do not fit together: {}", settings.join(" ")))
}

/// The settings of the optimiser called `name` with their defaults.
pub(super) fn describe(name: &str) -> anyhow::Result<String> {
    let mut value = serde_json::to_value(name.parse::<Optimizer>()?)?;
    let range = |key: &str| Setting::find(name, key).map_or_else(String::new, |s| s.kind.to_string());
    let lines: Vec<String> = fields(&mut value)?
        .iter()
        .map(|(key, value)| format!("  {key}={}  ({})", value.to_string().trim_matches('"'), range(key)))
        .collect();
    Ok(format!("settings of `{name}` and their defaults:\n{}", lines.join("\n")))
}

/// The one struct inside the serialised enum.
fn fields(value: &mut Value) -> anyhow::Result<&mut serde_json::Map<String, Value>> {
    value
        .as_object_mut()
        .and_then(|outer| outer.values_mut().next())
        .and_then(Value::as_object_mut)
        .context("this optimiser has no settings")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_are_taken_within_their_ranges_and_refused_in_words() {
        let set = |name: &str, setting: &str| optimizer(name, &[setting.to_owned()]);
        let Ok(Optimizer::Evolution(settings)) = set("evolution", "children=40") else {
            panic!("children=40")
        };
        assert_eq!(settings.children, 40);
        assert!(set("hewitt", "merge=Mean").is_ok());
        for (name, setting, expected) in [
            ("evolution", "step=-1", "expected a number from 0.000001 to 1 for `step`"),
            ("evolution", "children=1e9", "expected a whole number from 1 to 100000 for `children`"),
            ("evolution", "match_height=1", "expected true or false for `match_height`"),
            ("hewitt", "merge=best", "expected Both or Uniform or Mean for `merge`"),
            ("evolution", "population=60", "`evolution` has no setting `population`"),
            ("evolution", "children", "is not KEY=VALUE"),
        ] {
            let error = set(name, setting).unwrap_err().to_string();
            assert!(error.contains(expected), "{setting}: {error}");
        }
    }

    #[test]
    fn all_settings_are_described_with_their_ranges() {
        let text = describe("hewitt").unwrap();
        assert!(text.contains("  merge=Both  (Both or Uniform or Mean)"), "{text}");
        assert!(text.contains("  population=20  (a whole number from 2 to 100000)"), "{text}");
    }
}
