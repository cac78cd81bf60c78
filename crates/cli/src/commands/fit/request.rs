//! What a fit was asked for: pictures and options, so that a later run can tell whether it asks for the
//! same.

use super::args::{BudgetArgs, GoalArgs, IndividualArgs, SearchArgs};
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
        let differing = self.options.iter().filter_map(|(name, value)| {
            let then = then[*name].as_str();
            // Options that came later were not given before.
            let is_same = then.unwrap_or(NOTHING) == value;
            (!is_same).then(|| (name, then.unwrap_or("something that it does not say"), value))
        });
        list.extend(differing.map(|(name, then, value)| format!("--{name} was {then} and is {value}")));
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

/// The value of an option that was not given and has no default.
const NOTHING: &str = "nothing";

/// Every option that decides what comes of a fit. Each field of the options is named here, so that a new one cannot
/// be forgotten; those that are left out have their value in `settings`, or in the option that stands beside them.
fn options(
    fit: &Fit,
    goal: &GoalArgs,
    settings: &FitSettings,
) -> anyhow::Result<BTreeMap<&'static str, String>> {
    // Of these fields of its own, none decides what comes of a fit.
    let Fit {
        goals: _,
        list: _,
        out: _,
        resume: _,
        go_on: _,
        shard: _,
        checkpoint_every: _,
        overwrite: _,
        verbose: _,
        json: _,
        // A goal of a list has its own.
        goal_options: _,
        search,
        individual: IndividualArgs { individual, individuals },
        // With what a fit that goes on has used before: in `settings`.
        budget: BudgetArgs { timeout: _, evaluations: _, generations: _, target_iou: _ },
    } = fit;
    let GoalArgs {
        height,
        size,
        mask,
        tree,
        ground_row,
        axis_column,
        frame,
        view,
        free_frame,
        holdout_view,
        leaves: _,
        no_leaves: _,
    } = goal;
    let SearchArgs {
        from,
        generator: _,
        volume_from,
        free,
        fix,
        optimizer: _,
        evolve_rules: _,
        settings: _,
        objective: _,
        seed: _,
        tree_seed: _,
        robust: _,
    } = search;
    let budget = &settings.budget;
    // As it was given: with what is not for the search.
    let kept = match (fit.timeout(), fit.shares()?) {
        (Some(whole), Some(shares)) => whole.saturating_sub(shares.search),
        _ => Duration::ZERO,
    };
    let timeout = budget.timeout.map(|time| time + kept);
    let optional = |value: Option<String>| value.unwrap_or_else(|| NOTHING.to_owned());
    let list = |patterns: &[String]| optional((!patterns.is_empty()).then(|| patterns.join(" ")));
    let views = |views: Vec<String>| list(&views);
    Ok(BTreeMap::from([
        ("height", height.to_string()),
        ("size", size.to_string()),
        ("mask", optional(mask.as_ref().map(ToString::to_string))),
        ("tree", format!("{tree:?}").to_lowercase()),
        ("ground-row", optional(ground_row.map(|row| row.to_string()))),
        ("axis-column", optional(axis_column.map(|column| column.to_string()))),
        ("frame", optional(frame.map(|frame| frame.to_string()))),
        ("view", views(view.iter().map(ToString::to_string).collect())),
        ("free-frame", free_frame.to_string()),
        ("holdout-view", views(holdout_view.iter().map(ToString::to_string).collect())),
        ("leaves", format!("{:?}", goal.leaves()).to_lowercase()),
        ("from", from.to_string()),
        ("generator", search.generator()?.to_string()),
        ("volume-from", optional(volume_from.as_ref().map(ToString::to_string))),
        ("free", list(free)),
        ("fix", list(fix)),
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
        ("individuals", individuals.to_string()),
        ("individual", individual.unwrap_or_default().to_string()),
        ("timeout", optional(timeout.map(|time| format!("{}s", time.as_secs_f64())))),
        ("evaluations", optional(budget.evaluations.map(|count| count.to_string()))),
        ("generations", optional(budget.generations.map(|count| count.to_string()))),
        ("target-iou", optional(budget.target_iou.map(|iou| iou.to_string()))),
    ]))
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
        let held_out = BTreeMap::from([("holdout-view", NOTHING.to_owned())]);
        let silent = Request { options: BTreeMap::new(), ..request("1") };
        let before = serde_json::to_value(&silent).unwrap();
        assert!(
            Request { options: held_out, ..silent }.differences(&before).is_empty(),
            "nothing is as before"
        );
    }

    /// The options of `pleach fit`, and what each of them may be given that is not its default.
    const GIVEN: [(&str, &str); 30] = [
        ("height", "12"),
        ("size", "64"),
        ("mask", "auto"),
        ("tree", "dark"),
        ("ground_row", "200"),
        ("axis_column", "100.5"),
        ("view", "30"),
        ("free_frame", ""),
        ("holdout_view", "45=corner.png"),
        ("leaves", "on"),
        ("no_leaves", ""),
        ("from", "acer"),
        ("generator", "fractal"),
        ("volume_from", "goal"),
        ("free", "crown"),
        ("fix", "leaves"),
        ("frame", "0.05,30,60"),
        ("optimizer", "cma"),
        ("evolve_rules", ""),
        ("settings", "children=8"),
        ("objective", "iou"),
        ("seed", "2"),
        ("tree_seed", "any"),
        ("robust", "3"),
        ("individual", "off"),
        ("individuals", "2"),
        ("timeout", "20s"),
        ("evaluations", "30"),
        ("generations", "7"),
        ("target_iou", "0.5"),
    ];

    /// Those that say which goals are fitted, how and where results are kept, and what is printed; the goal itself
    /// is in the request beside the options.
    const WITHOUT_EFFECT: [&str; 10] = [
        "goals",
        "list",
        "out",
        "resume",
        "go_on",
        "shard",
        "checkpoint_every",
        "overwrite",
        "verbose",
        "json",
    ];

    #[derive(clap::Parser)]
    struct Line {
        #[command(flatten)]
        fit: Fit,
    }

    fn options_of(line: &[&str]) -> BTreeMap<&'static str, String> {
        use clap::Parser as _;
        let line = ["fit", "goal.png"].iter().chain(line);
        let fit = Line::try_parse_from(line).unwrap_or_else(|error| panic!("{error}")).fit;
        let crate::commands::fit::Settings::Fit(settings) = fit.settings().unwrap() else {
            panic!("help was not asked for")
        };
        options(&fit, &fit.goal_options, &settings).unwrap()
    }

    #[test]
    fn every_option_that_decides_what_comes_of_a_fit_is_in_its_request() {
        use clap::CommandFactory as _;
        let usual = options_of(&[]);
        let line = Line::command();
        for argument in line.get_arguments() {
            let id = argument.get_id().as_str();
            if WITHOUT_EFFECT.contains(&id) {
                continue;
            }
            let given = GIVEN.iter().find(|(name, _)| *name == id);
            let (_, value) = given.unwrap_or_else(|| panic!("{id} is in neither list"));
            let option = format!("--{}", argument.get_long().unwrap());
            let mut words = vec![option.as_str()];
            words.extend((!value.is_empty()).then_some(*value));
            assert_ne!(options_of(&words), usual, "{option} {value} changes nothing of the request");
        }
    }
}
