//! What a fit was asked for: pictures and options, so that a later run can tell whether it asks for the
//! same.

use super::args::GoalArgs;
use super::goal::MaskSource;
use super::outlined::VolumeFrom;
use super::{Fit, views};
use anyhow::Context;
use pleach_fit::{FitSettings, TreeSeed};
use pleach_silhouette::goal::Encoded;
use serde::Serialize;
use serde_json::Value;
use sha2::{Digest as _, Sha256};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The files and options that decide what comes of a fit.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub(super) struct Request {
    /// The goal's path, as it was given.
    pub(super) goal: String,
    /// SHA-256 of the goal's file, in hexadecimal digits.
    pub(super) goal_sha256: String,
    /// The same of every other file that is read: masks, further pictures, the species of the start.
    pub(super) inputs_sha256: BTreeMap<String, String>,
    /// Options and their values as text; those that were not given with their defaults.
    pub(super) options: BTreeMap<&'static str, String>,
}

impl Request {
    /// The request of `fit` for one goal, whose file is `source`, with the options `goal_args`.
    pub(super) fn new(
        fit: &Fit,
        goal: &Path,
        source: &Encoded,
        goal_args: &GoalArgs,
        settings: &FitSettings,
    ) -> anyhow::Result<Self> {
        let mut others: Vec<PathBuf> = goal_args.view.iter().filter_map(views::Direction::file).collect();
        others.extend(goal_args.holdout_view.iter().map(views::KnownPicture::file));
        if let Some(MaskSource::File(mask)) = &goal_args.mask {
            others.push(mask.clone());
        }
        let from = PathBuf::from(fit.search.from.to_string());
        if from.is_file() {
            others.push(from);
        }
        if let Some(VolumeFrom::File(file)) = &fit.search.volume_from {
            others.push(file.clone());
        }
        let name = |path: &Path| path.display().to_string();
        let inputs = others.iter().map(|path| Ok((name(path), file_sha256(path)?)));
        Ok(Self {
            goal: name(goal),
            goal_sha256: digits(Sha256::digest(source.bytes())),
            inputs_sha256: inputs.collect::<anyhow::Result<_>>()?,
            options: options(fit, goal_args, settings)?,
        })
    }

    /// Where the finished fit of `summary` differs from this one: for people, a phrase each. The goal
    /// may have moved, its content may not have changed.
    pub(super) fn differences(&self, summary: &Value) -> Vec<String> {
        let mut list = Vec::new();
        if summary["goal_sha256"].as_str() != Some(&self.goal_sha256) {
            list.push(match summary["goal"].as_str() {
                Some(goal) if goal == self.goal => format!("{goal} has changed since"),
                Some(goal) => format!("its goal was {goal} and is {}", self.goal),
                None => "it does not say what its goal was".to_owned(),
            });
        }
        let then = &summary["options"];
        let differing =
            self.options.iter().filter(|(name, value)| then[**name].as_str() != Some(value.as_str()));
        list.extend(differing.map(|(name, value)| {
            let then = then[*name].as_str().unwrap_or("something that it does not say");
            format!("--{name} was {then} and is {value}")
        }));
        let changed = self.inputs_sha256.iter().filter(|(path, hash)| {
            summary["inputs_sha256"][path.as_str()].as_str().is_some_and(|then| then != hash.as_str())
        });
        list.extend(changed.map(|(path, _)| format!("{path} has changed since")));
        list
    }
}

/// SHA-256 of a file's content, in hexadecimal digits.
pub(in crate::commands) fn file_sha256(path: &Path) -> anyhow::Result<String> {
    let cannot = || format!("cannot read {}", path.display());
    let mut file = std::fs::File::open(path).with_context(cannot)?;
    let mut hasher = Sha256::new();
    std::io::copy(&mut file, &mut hasher).with_context(cannot)?;
    Ok(digits(hasher.finalize()))
}

fn digits(hash: impl AsRef<[u8]>) -> String {
    hash.as_ref().iter().map(|byte| format!("{byte:02x}")).collect()
}

fn options(
    fit: &Fit,
    goal: &GoalArgs,
    settings: &FitSettings,
) -> anyhow::Result<BTreeMap<&'static str, String>> {
    let (search, budget) = (&fit.search, &settings.budget);
    // As it was given: with what is not for the search.
    let kept = match (fit.timeout(), fit.shares()?) {
        (Some(whole), Some(shares)) => whole.saturating_sub(shares.search),
        _ => Duration::ZERO,
    };
    let timeout = budget.timeout.map(|time| time + kept);
    let optional = |value: Option<String>| value.unwrap_or_else(|| "nothing".to_owned());
    let list = |patterns: &[String]| optional((!patterns.is_empty()).then(|| patterns.join(" ")));
    let mut options = BTreeMap::from([
        ("height", goal.height.to_string()),
        ("size", goal.size.to_string()),
        ("mask", optional(goal.mask.as_ref().map(ToString::to_string))),
        ("tree", format!("{:?}", goal.tree).to_lowercase()),
        ("ground-row", optional(goal.ground_row.map(|row| row.to_string()))),
        ("axis-column", optional(goal.axis_column.map(|column| column.to_string()))),
        ("frame", optional(goal.frame.map(|frame| frame.to_string()))),
        ("view", list(&goal.view.iter().map(ToString::to_string).collect::<Vec<_>>())),
        ("free-frame", goal.free_frame.to_string()),
        ("leaves", format!("{:?}", goal.leaves()).to_lowercase()),
        ("from", search.from.to_string()),
        ("generator", search.generator()?.to_string()),
        ("free", list(&search.free)),
        ("fix", list(&search.fix)),
        ("optimizer", settings.method_name().to_owned()),
        ("set", method_settings(settings)?.to_string()),
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
        ("individuals", fit.individual.individuals.to_string()),
        ("individual", fit.individual.individual.unwrap_or_default().to_string()),
        ("timeout", optional(timeout.map(|time| format!("{}s", time.as_secs_f64())))),
        ("evaluations", optional(budget.evaluations.map(|count| count.to_string()))),
        ("generations", optional(budget.generations.map(|count| count.to_string()))),
        ("target-iou", optional(budget.target_iou.map(|iou| iou.to_string()))),
    ]);
    if let Some(from) = &search.volume_from {
        options.insert("volume-from", from.to_string());
    }
    Ok(options)
}

/// The settings of what searches.
pub(super) fn method_settings(settings: &FitSettings) -> anyhow::Result<Value> {
    Ok(match &settings.rules {
        Some(rules) => serde_json::to_value(rules)?,
        None => serde_json::to_value(&settings.optimizer)?[settings.optimizer.name()].take(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn request(seed: &str) -> Request {
        Request {
            goal: "oak.png".to_owned(),
            goal_sha256: "ab".to_owned(),
            inputs_sha256: BTreeMap::from([("side.png".to_owned(), "01".to_owned())]),
            options: BTreeMap::from([("seed", seed.to_owned()), ("size", "64".to_owned())]),
        }
    }

    #[test]
    fn what_differs_is_named_with_both_values() {
        let summary = serde_json::to_value(request("1")).unwrap();
        assert!(request("1").differences(&summary).is_empty());
        assert_eq!(request("2").differences(&summary), ["--seed was 1 and is 2"]);
        let moved = Request { goal: "a/oak.png".to_owned(), ..request("1") };
        assert!(moved.differences(&summary).is_empty(), "the same picture at another place");
        let other = Request { goal_sha256: "cd".to_owned(), ..moved };
        assert_eq!(other.differences(&summary), ["its goal was oak.png and is a/oak.png"]);
        let changed = Request { goal_sha256: "cd".to_owned(), ..request("1") };
        assert_eq!(changed.differences(&summary), ["oak.png has changed since"]);
        let side = BTreeMap::from([("side.png".to_owned(), "02".to_owned())]);
        let side = Request { inputs_sha256: side, ..request("1") };
        assert_eq!(side.differences(&summary), ["side.png has changed since"]);
        let silent = serde_json::json!({ "finished": true });
        assert_eq!(
            request("1").differences(&silent).len(),
            3,
            "a summary that says nothing is of another fit"
        );
    }
}
