//! What a fit was asked to do, so that a later run can tell whether it asks for the same.

use super::Fit;
use pleach_fit::{FitSettings, TreeSeed};
use serde_json::Value;
use std::collections::BTreeMap;

/// Options and their values as text. Only those that decide what comes of a fit.
pub(super) type Asked = BTreeMap<&'static str, String>;

/// The options of `fit`, those that were not given with their defaults.
pub(super) fn asked(fit: &Fit, settings: &FitSettings) -> anyhow::Result<Asked> {
    let (goal, search, budget) = (&fit.goal_options, &fit.search, &settings.budget);
    let optional = |value: Option<String>| value.unwrap_or_else(|| "nothing".to_owned());
    let list = |patterns: &[String]| optional((!patterns.is_empty()).then(|| patterns.join(" ")));
    Ok(BTreeMap::from([
        ("height", goal.height.to_string()),
        ("size", goal.size.to_string()),
        ("mask", optional(goal.mask.as_ref().map(ToString::to_string))),
        ("tree", format!("{:?}", goal.tree).to_lowercase()),
        ("ground-row", optional(goal.ground_row.map(|row| row.to_string()))),
        ("axis-column", optional(goal.axis_column.map(|column| column.to_string()))),
        ("view", list(&goal.view.iter().map(ToString::to_string).collect::<Vec<_>>())),
        ("free-frame", goal.free_frame.to_string()),
        ("leaves", format!("{:?}", goal.leaves()).to_lowercase()),
        ("from", search.from.to_string()),
        ("free", list(&search.free)),
        ("fix", list(&search.fix)),
        ("optimizer", settings.optimizer.name().to_owned()),
        ("set", serde_json::to_value(&settings.optimizer)?[settings.optimizer.name()].to_string()),
        ("objective", settings.objective.to_string()),
        ("seed", settings.seed.to_string()),
        (
            "tree-seed",
            match settings.tree_seed {
                TreeSeed::Fixed(seed) => seed.to_string(),
                TreeSeed::Any => "any".to_owned(),
            },
        ),
        ("robust", settings.robust.to_string()),
        ("timeout", optional(budget.timeout.map(|time| format!("{}s", time.as_secs_f64())))),
        ("evaluations", optional(budget.evaluations.map(|count| count.to_string()))),
        ("generations", optional(budget.generations.map(|count| count.to_string()))),
        ("target-iou", optional(budget.target_iou.map(|iou| iou.to_string()))),
    ]))
}

/// Where the options in the summary of a finished fit differ from `asked`: for people, a phrase each.
pub(super) fn differences(summary: &Value, asked: &Asked) -> Vec<String> {
    let then = &summary["options"];
    let differing = asked.iter().filter(|(name, value)| then[**name].as_str() != Some(value.as_str()));
    differing
        .map(|(name, value)| {
            let then = then[*name].as_str().unwrap_or("something that it does not say");
            format!("--{name} was {then} and is {value}")
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_differs_is_named_with_both_values() {
        let asked = BTreeMap::from([("seed", "2".to_owned()), ("size", "64".to_owned())]);
        let summary = |seed: &str| serde_json::json!({ "options": { "seed": seed, "size": "64" } });
        assert!(differences(&summary("2"), &asked).is_empty());
        assert_eq!(differences(&summary("1"), &asked), ["--seed was 1 and is 2"]);
        let silent = serde_json::json!({ "finished": true });
        assert_eq!(differences(&silent, &asked).len(), 2, "a summary without options is of other ones");
    }
}
