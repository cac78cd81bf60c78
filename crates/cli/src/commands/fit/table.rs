//! The table of many fits: a row for each goal, from the summaries in the run folders.

use crate::text;
use pleach::ScoreCard;
use serde_json::Value;
use std::path::Path;

/// Columns of the summary after those of the score card, and where in `summary.json` they come from; after them
/// come the two that depend on the clock.
const COLUMNS: [(&str, &str); 22] = [
    ("fresh_likeness_mean", "/fresh_seeds/likeness/mean"),
    ("fresh_likeness_sd", "/fresh_seeds/likeness/sd"),
    ("fresh_iou_mean", "/fresh_seeds/iou/mean"),
    ("fresh_iou_sd", "/fresh_seeds/iou/sd"),
    ("from", "/from"),
    ("first_guess", "/looks_like/0/species"),
    ("first_guess_confidence", "/looks_like/0/confidence"),
    ("species", "/species"),
    ("generator", "/generator"),
    ("tree_seed", "/tree_seed"),
    ("robust", "/robust"),
    ("optimizer", "/optimizer"),
    ("objective", "/objective"),
    ("seed", "/seed"),
    ("cost", "/cost"),
    ("evaluations", "/evaluations"),
    ("stopped_by", "/stopped_by"),
    ("warnings", "/warnings"),
    ("height_m", "/tree_m/height"),
    ("crown_width_m", "/tree_m/crown_width"),
    ("crown_base_m", "/tree_m/crown_base"),
    ("stem_diameter_m", "/tree_m/stem_diameter"),
];
const WALL_COLUMNS: [(&str, &str); 2] =
    [("wall_s", "/seconds"), ("wall_evaluations_per_s", "/evaluations_per_second")];

/// Columns that every row has, whatever came of its goal.
pub(in crate::commands) const GOAL: &str = "goal";
pub(in crate::commands) const STATE: &str = "state";
pub(in crate::commands) const REASON: &str = "reason";
/// What the column `state` says of a goal whose fit failed.
pub(in crate::commands) const FAILED: &str = "failed";
const FINISHED: &str = "finished";

fn columns() -> impl Iterator<Item = (&'static str, &'static str)> {
    let scores = ScoreCard::COLUMNS.into_iter().map(|column| (column.name, column.pointer));
    scores.chain(COLUMNS).chain(WALL_COLUMNS)
}

/// The first row.
pub(in crate::commands) fn header() -> Vec<String> {
    [GOAL, STATE, REASON].into_iter().chain(columns().map(|column| column.0)).map(str::to_owned).collect()
}

/// The row of `goal`, of which there is a `summary.json`, or a reason why its fit failed.
pub(in crate::commands) fn row(goal: &Path, result: Result<&Value, &str>) -> Vec<String> {
    let (state, reason, summary) = match result {
        Ok(summary) => (FINISHED, "", summary),
        Err(reason) => (FAILED, reason, &Value::Null),
    };
    let cells = columns().map(|(_, at)| cell(summary.pointer(at)));
    let goal = goal.to_string_lossy();
    let texts = [&goal, state, reason].map(|cell| text::cell(cell).into_owned());
    texts.into_iter().chain(cells).collect()
}

/// A value as a cell; nothing where there is none. A number that was read back from a file may differ
/// in its last bit, which six decimals do not show.
fn cell(value: Option<&Value>) -> String {
    match value {
        None | Some(Value::Null) => String::new(),
        Some(Value::String(text)) => text::cell(text).into_owned(),
        // Warnings, by their kinds.
        Some(Value::Array(items)) => {
            items.iter().map(|item| cell(item.get("kind"))).collect::<Vec<_>>().join(" ")
        }
        Some(Value::Number(number)) if number.is_f64() => {
            format!("{:.6}", number.as_f64().unwrap_or(f64::NAN))
        }
        Some(other) => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_plain() {
        assert_eq!(cell(Some(&0.25.into())), "0.250000");
        assert_eq!(cell(Some(&3.into())), "3");
        assert_eq!(cell(Some(&"oak".into())), "oak");
        assert_eq!(cell(Some(&"=1+1".into())), "'=1+1");
        assert_eq!(cell(Some(&(-3).into())), "-3", "a number is not a formula");
        assert_eq!(row(Path::new("-a\n.png"), Err("+"))[..3], ["'-a\\u{a}.png", "failed", "'+"]);
        assert_eq!(cell(Some(&Value::Null)) + &cell(None), "");
    }
}
