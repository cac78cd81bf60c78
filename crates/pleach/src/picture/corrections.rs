//! What a person says is otherwise in a picture than it was read.

use super::goal_reading::GoalReading;
use crate::option_error::OptionError;
use pleach_reading::{Colors, Foot, Reading};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

/// What a person says is otherwise in a picture than it was read: the keys of `reading.json`, or some of them, with
/// other values.
///
/// - A value that differs from what was read is sure: its confidence becomes 1.
/// - A value that is the same has the confidence that stands beside it, or 1 if none does: who repeats a value
///   confirms it. So a `reading.json` as it was written changes nothing.
/// - A confidence without its value replaces the one that was read.
/// - `trunks` is short for `feet` where only their number is known, from 1 to 64.
/// - `trunk_width` is short for `feet` where only the thickness of the main trunk, the thickest, is known.
/// - `mask_confidence` and `warnings`, which are not about the tree, are passed over.
///
/// ```
/// use pleach::{FitOptions, Corrections, View, read_picture};
///
/// let goal = pleach::silhouette(&pleach::species("acer")?.grow(7)?, View::FRONT, 256);
/// let reading = Corrections::from_json(r#"{ "trunks": 1, "lean_deg": -8 }"#)?;
/// let found = read_picture(goal, &FitOptions { reading, ..FitOptions::default() })?.found.measures;
/// assert_eq!((found.lean_deg, found.lean_deg_confidence), (Some(-8.0), 1.0));
/// assert_eq!((found.feet.len(), found.feet_confidence), (1, 1.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Corrections(Map<String, Value>);

/// The option that these are the value of.
const OPTION: &str = "reading";
/// Keys of `reading.json` that are not about the tree.
const NOT_OF_THE_TREE: [&str; 2] = ["mask_confidence", "warnings"];
const TRUNKS: &str = "trunks";
const TRUNK_WIDTH: &str = "trunk_width";
const COLORS: &str = "colors";
const SUFFIX: &str = "_confidence";
/// The most trunks, and the most points of a trunk or an outline.
const MAX_TRUNKS: u64 = 64;
const MAX_POINTS: usize = 4096;
/// Numbers read back from text are the same within this.
const SAME: f64 = 1e-9;

/// The range of the measures called `key`; lengths are in heights of the tree.
fn range(key: &str) -> (f64, f64) {
    match key {
        "lean_deg" | "stroke_deg" | "fork_arms_deg" => (-90.0, 90.0),
        "asymmetry" | "grain_upright" | "grain_rising" => (-1.0, 1.0),
        "bare_height" | "first_fork" | "crown_widest" | "gap_share" | "gap_by_height" | "gap_sizes"
        | "stroke_upright" | "hanging_ends" | "foliage_share" => (0.0, 1.0),
        TRUNK_WIDTH => (0.001, 2.0),
        "crown_width" | "twig_fineness" | "leaf_spread" => (0.0, 20.0),
        "leaf_size_px" | "clumps" => (0.0, 1e6),
        _ if key.ends_with(SUFFIX) => (0.0, 1.0),
        _ => (-20.0, 20.0),
    }
}

impl Corrections {
    /// Corrections from the JSON of a `reading.json`, or a part of it.
    ///
    /// # Errors
    /// Text that is not a JSON object, or what [`FitOptions::check`](super::FitOptions::check) finds wrong with it.
    pub fn from_json(text: &str) -> Result<Self, OptionError> {
        let wrong = |error| OptionError::new(OPTION, format!("is not a JSON object of measures: {error}"));
        let given: Self = serde_json::from_str(text).map_err(wrong)?;
        given.check()?;
        Ok(given)
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The same, and the measure `key` is surely `value`. What cannot be is found by
    /// [`FitOptions::check`](super::FitOptions::check).
    #[must_use]
    pub fn confirmed(mut self, key: &str, value: impl Into<Value>) -> Self {
        let _ = self.0.insert(key.to_owned(), value.into());
        // What a file says of it is of another value.
        let of = match key {
            TRUNKS => "feet",
            TRUNK_WIDTH => "width",
            _ => key,
        };
        let _ = self.0.remove(&format!("{of}{SUFFIX}"));
        self
    }

    /// Whether they say if there are leaves.
    pub(super) fn says_leaves(&self) -> bool {
        self.0.contains_key("leaves")
    }

    /// Tells whether the names are those of measures and the values can be.
    pub(super) fn check(&self) -> Result<(), OptionError> {
        self.0.iter().try_for_each(|(key, value)| check_numbers(key, value))?;
        let mut blank = GoalReading::new(Reading::default(), None, None, Vec::new());
        self.changes(&blank)?.apply(&mut blank)
    }

    /// What changes in a picture that was read as `found`.
    pub(super) fn changes(&self, found: &GoalReading) -> Result<Changes, OptionError> {
        let mut given = self.0.clone();
        given.retain(|key, _| !NOT_OF_THE_TREE.contains(&key.as_str()));
        if let Some(count) = given.remove(TRUNKS) {
            let count = count.as_u64().filter(|count| (1..=MAX_TRUNKS).contains(count)).ok_or_else(|| {
                let problem = format!("has {count} trunks, expected a whole number from 1 to {MAX_TRUNKS}");
                OptionError::new(OPTION, problem)
            })?;
            let _ = given.insert("feet".to_owned(), json!(feet(&found.measures.feet, count as usize)));
            let _ = given.entry("feet_confidence").or_insert_with(|| json!(1.0));
        }
        let trunk_width = given.remove(TRUNK_WIDTH);
        let colors = match given.remove(COLORS) {
            None | Some(Value::Null) => Map::new(),
            Some(Value::Object(colors)) => changed(colors, &found.colors.clone().unwrap_or_default()),
            Some(other) => {
                return Err(OptionError::new(OPTION, format!("has the colors {other}, expected an object")));
            }
        };
        let mut measures = changed(given, &found.measures);
        if let Some(width) = trunk_width {
            let width = width.as_f64().ok_or_else(|| {
                OptionError::new(OPTION, format!("has {width} for `{TRUNK_WIDTH}`, expected a number"))
            })?;
            // How many trunks there are is as sure as before.
            let feet = measures.remove("feet").unwrap_or_else(|| json!(found.measures.feet));
            let _ = measures.insert("feet".to_owned(), with_main_width(feet, width));
            let _ = measures.insert("width_confidence".to_owned(), json!(1.0));
        }
        Ok(Changes { measures, colors })
    }
}

/// Values that replace what was read, with their confidences.
#[derive(Clone, Debug, Default)]
pub(super) struct Changes {
    measures: Map<String, Value>,
    colors: Map<String, Value>,
}

impl Changes {
    /// Whether no measure changes.
    pub(super) fn keep_measures(&self) -> bool {
        self.measures.is_empty()
    }

    /// Changes `found`.
    ///
    /// # Errors
    /// A key that is not a measure, or a value that is not of its kind.
    pub(super) fn apply(&self, found: &mut GoalReading) -> Result<(), OptionError> {
        self.apply_to_measures(&mut found.measures)?;
        if !self.colors.is_empty() {
            let read = found.colors.take().unwrap_or_default();
            let colors: Colors = merged(&self.colors, &read)?;
            found.colors = Some(Colors { wood: read.wood, foliage: read.foliage, ..colors });
        }
        Ok(())
    }

    /// Changes the measures of another reading of the same picture.
    pub(super) fn apply_to_measures(&self, measures: &mut Reading) -> Result<(), OptionError> {
        *measures = merged(&self.measures, measures)?;
        Ok(())
    }
}

/// `given`, with the confidences of what differs from `read` or repeats it.
fn changed<T: Serialize>(given: Map<String, Value>, read: &T) -> Map<String, Value> {
    let read = object(read);
    let mut changes = given.clone();
    for (key, value) in given.iter().filter(|(key, _)| !key.ends_with(SUFFIX)) {
        let is_other = read.get(key).is_some_and(|read| !is_same(read, value));
        let mut sure = |key: &str| {
            let key = format!("{key}{SUFFIX}");
            if read.contains_key(&key) && (is_other || !given.contains_key(&key)) {
                let _ = changes.insert(key, json!(1.0));
            }
        };
        sure(key);
        // Thickness stands with the feet; 0 is unknown.
        let has_widths = |foot: &Value| foot["width"].as_f64().is_some_and(|width| width > 0.0);
        if key == "feet" && value.as_array().is_some_and(|feet| feet.iter().all(has_widths)) {
            let widths = |feet: &Value| -> Value {
                feet.as_array().into_iter().flatten().map(|foot| foot["width"].clone()).collect()
            };
            if read.get(key).is_none_or(|read| !is_same(&widths(read), &widths(value))) {
                sure("width");
            }
        }
    }
    // What is as it was read, to the last bit that text keeps, is no change.
    changes.retain(|key, value| read.get(key).is_none_or(|read| !is_same(read, value)));
    changes
}

/// `read` with `changes` in its place.
fn merged<T: Serialize + DeserializeOwned>(changes: &Map<String, Value>, read: &T) -> Result<T, OptionError> {
    let mut all = object(read);
    // One by one, so that the wrong one can be named.
    for (key, value) in changes {
        let before = all.insert(key.clone(), value.clone());
        if let Err(error) = serde_json::from_value::<T>(Value::Object(all.clone())) {
            let problem = match before {
                None => format!("has `{key}`, which is not a measure: see `pleach read --json`"),
                Some(_) => format!("has {value} for `{key}`: {error}"),
            };
            return Err(OptionError::new(OPTION, problem));
        }
    }
    serde_json::from_value(Value::Object(all))
        .map_err(|error| OptionError::new(OPTION, format!("is wrong: {error}")))
}

fn object<T: Serialize>(read: &T) -> Map<String, Value> {
    match serde_json::to_value(read) {
        Ok(Value::Object(all)) => all,
        _ => Map::new(),
    }
}

fn is_same(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => {
            a.as_f64().zip(b.as_f64()).is_some_and(|(a, b)| (a - b).abs() <= SAME * a.abs().max(1.0))
        }
        (Value::Array(a), Value::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| is_same(a, b))
        }
        (Value::Object(a), Value::Object(b)) => {
            a.len() == b.len() && a.iter().all(|(key, a)| b.get(key).is_some_and(|b| is_same(a, b)))
        }
        _ => a == b,
    }
}

/// Tells whether the numbers of `value` are within the range of `key`, and not too many.
fn check_numbers(key: &str, value: &Value) -> Result<(), OptionError> {
    match value {
        Value::Number(number) => {
            let (least, most) = range(key);
            if key == TRUNKS || number.as_f64().is_some_and(|number| (least..=most).contains(&number)) {
                return Ok(());
            }
            let problem = format!("has {number} for `{key}`, expected from {least} to {most}");
            Err(OptionError::new(OPTION, problem))
        }
        Value::Array(all) => {
            let most = if key == "feet" { MAX_TRUNKS as usize } else { MAX_POINTS };
            if all.len() > most {
                let problem = format!("has {} values for `{key}`, expected up to {most}", all.len());
                return Err(OptionError::new(OPTION, problem));
            }
            all.iter().try_for_each(|value| check_numbers(key, value))
        }
        Value::Object(all) => all.iter().try_for_each(|(key, value)| check_numbers(key, value)),
        Value::Null | Value::Bool(_) | Value::String(_) => Ok(()),
    }
}

/// `count` feet: the thickest of those that were `read`, and where there are too few, more of them beside the last, of
/// unknown thickness.
fn feet(read: &[Foot], count: usize) -> Vec<Foot> {
    let mut feet = read.to_vec();
    feet.sort_by(|a, b| b.width.total_cmp(&a.width));
    feet.truncate(count);
    feet.sort_by(|a, b| a.x.total_cmp(&b.x));
    let from = feet.last().map_or(0.0, |foot| foot.x);
    let more = count - feet.len();
    feet.extend((1..=more).map(|i| Foot { x: from + APART * i as f64, width: 0.0 }));
    feet
}

/// `feet` of which the thickest, or the only one of unknown thickness, is so wide; one foot where there are none. Others are
/// not wider than it is.
fn with_main_width(feet: Value, width: f64) -> Value {
    // What is no list of feet is told when it is read.
    let Value::Array(mut feet) = feet else { return feet };
    if feet.is_empty() {
        feet.push(json!(Foot::default()));
    }
    let of = |foot: &Value| foot["width"].as_f64().unwrap_or(0.0);
    let widest = feet.iter().map(of).fold(0.0, f64::max);
    let main = feet.iter().position(|foot| of(foot) >= widest).unwrap_or(0);
    for (at, foot) in feet.iter_mut().enumerate() {
        let own = if at == main { width } else { of(foot).min(width) };
        if let Some(foot) = foot.as_object_mut() {
            let _ = foot.insert("width".to_owned(), json!(own));
        }
    }
    Value::Array(feet)
}

/// How far feet stand apart that are only counted, in heights of the tree.
const APART: f64 = 0.1;

#[cfg(test)]
mod tests {
    use super::*;

    fn read() -> GoalReading {
        let feet = vec![Foot { x: -0.02, width: 0.03 }, Foot { x: 0.1, width: 0.07 }];
        let measures = Reading {
            feet,
            feet_confidence: 0.45,
            width_confidence: 0.6,
            lean_deg: Some(3.0),
            lean_deg_confidence: 0.7,
            ..Reading::default()
        };
        GoalReading::new(measures, Some(Colors::default()), None, Vec::new())
    }

    fn corrected(text: &str) -> GoalReading {
        let mut found = read();
        let changes = Corrections::from_json(text).unwrap().changes(&found).unwrap();
        changes.apply(&mut found).unwrap();
        found
    }

    #[test]
    fn a_reading_as_it_was_written_changes_nothing() {
        let text = serde_json::to_string_pretty(&read()).unwrap();
        assert_eq!(serde_json::to_value(corrected(&text)).unwrap(), serde_json::to_value(read()).unwrap());
        let changes = Corrections::from_json(&text).unwrap().changes(&read()).unwrap();
        assert!(changes.keep_measures(), "{changes:?}");
        assert!(Corrections::default().is_empty() && !Corrections::from_json(&text).unwrap().is_empty());
    }

    #[test]
    fn what_differs_is_sure_and_what_is_repeated_is_confirmed() {
        let text = serde_json::to_string(&read()).unwrap().replace("\"lean_deg\":3.0", "\"lean_deg\":-12");
        let found = corrected(&text).measures;
        assert_eq!((found.lean_deg, found.lean_deg_confidence), (Some(-12.0), 1.0));
        assert_eq!((found.feet_confidence, found.width_confidence), (0.45, 0.6));
        let found = corrected(r#"{ "lean_deg": 3, "bare_height": 0.2, "feet_confidence": 0.8 }"#).measures;
        assert_eq!((found.lean_deg_confidence, found.feet_confidence), (1.0, 0.8));
        assert_eq!((found.bare_height, found.bare_height_confidence), (Some(0.2), 1.0));
        let found = corrected(r#"{ "first_fork": null, "feet": [{ "x": 0, "width": 0.05 }] }"#).measures;
        assert_eq!((found.first_fork, found.first_fork_confidence), (None, 1.0));
        assert_eq!((found.feet_confidence, found.width_confidence), (1.0, 1.0));
        let colors = corrected(r##"{ "colors": { "leaf": "#c05a20" } }"##).colors.unwrap();
        assert_eq!((colors.leaf.unwrap().to_string().as_str(), colors.leaf_confidence), ("#c05a20", 1.0));
    }

    #[test]
    fn trunks_are_counted_from_the_thickest() {
        let found = corrected(r#"{ "trunks": 1 }"#).measures;
        assert_eq!((found.feet, found.feet_confidence), (vec![Foot { x: 0.1, width: 0.07 }], 1.0));
        let found = corrected(r#"{ "trunks": 3 }"#).measures;
        assert_eq!((found.feet.len(), found.feet[1].width, found.feet[2].width), (3, 0.07, 0.0));
        assert_eq!((found.feet_confidence, found.width_confidence), (1.0, 0.6));
        assert_eq!(corrected(r#"{ "trunks": 2 }"#).measures.feet_confidence, 1.0, "confirmed");
    }

    #[test]
    fn the_main_trunk_is_the_thickest() {
        let found = corrected(r#"{ "trunk_width": 0.05 }"#).measures;
        assert_eq!(found.feet.iter().map(|foot| foot.width).collect::<Vec<_>>(), [0.03, 0.05]);
        assert_eq!((found.feet_confidence, found.width_confidence), (0.45, 1.0));
        // The others are thinner.
        let found = corrected(r#"{ "trunk_width": 0.02 }"#).measures;
        assert_eq!(found.feet.iter().map(|foot| foot.width).collect::<Vec<_>>(), [0.02, 0.02]);
        let found = corrected(r#"{ "trunk_width": 0.1, "trunks": 1 }"#).measures;
        assert_eq!((found.feet, found.feet_confidence), (vec![Foot { x: 0.1, width: 0.1 }], 1.0));
        let said = Corrections::from_json(r#"{ "width_confidence": 0.2 }"#).unwrap();
        let mut found = read();
        let said = said.confirmed("trunk_width", 0.07);
        said.changes(&found).unwrap().apply(&mut found).unwrap();
        assert_eq!(found.measures.width_confidence, 1.0, "confirmed");
        // Of a picture without a foot too.
        let mut found = GoalReading::new(Reading::default(), None, None, Vec::new());
        Corrections::from_json(r#"{ "trunk_width": 0.1 }"#)
            .unwrap()
            .changes(&found)
            .unwrap()
            .apply(&mut found)
            .unwrap();
        assert_eq!(found.measures.trunk_width(), Some(0.1));
    }

    #[test]
    fn what_is_wrong_is_named() {
        let error = |text: &str| Corrections::from_json(text).unwrap_err().to_string();
        for (text, expected) in [
            ("[]", "is not a JSON object of measures"),
            (r#"{ "leaning": 3 }"#, "has `leaning`, which is not a measure"),
            (r#"{ "lean_deg": 100 }"#, "has 100 for `lean_deg`, expected from -90 to 90"),
            (r#"{ "lean_deg": "left" }"#, "has \"left\" for `lean_deg`"),
            (r#"{ "bare_height": -0.1 }"#, "expected from 0 to 1"),
            (r#"{ "feet_confidence": 2 }"#, "expected from 0 to 1"),
            (r#"{ "trunks": 0 }"#, "has 0 trunks, expected a whole number from 1 to 64"),
            (r#"{ "trunks": 1.5 }"#, "has 1.5 trunks"),
            (r#"{ "trunk_width": 0 }"#, "has 0 for `trunk_width`, expected from 0.001 to 2"),
            (r#"{ "trunk_width": "thick" }"#, "has \"thick\" for `trunk_width`"),
            (r#"{ "feet": [{ "x": 1e300, "width": 0.1 }] }"#, "for `x`, expected from -20 to 20"),
            (r#"{ "feet": [{ "width": 0.1 }] }"#, "for `feet`"),
            (r#"{ "colors": { "leaf": "green" } }"#, "has \"green\" for `leaf`"),
            (r#"{ "colors": 3 }"#, "expected an object"),
        ] {
            assert!(
                error(text).starts_with("`reading` ") && error(text).contains(expected),
                "{}",
                error(text)
            );
        }
        let many = format!("{{ \"trunk\": [{}[0,0,0]] }}", "[0,0,0],".repeat(5000));
        assert!(error(&many).contains("5001 values for `trunk`"));
    }
}
