//! What a fit was asked for: pictures and options, so that a later run can tell whether it asks for the
//! same.

use super::flags::{defaults, flag};
use crate::segmenter::Segmenter;
use anyhow::Context;
use pleach::{Encoded, FitOptions};
use serde::Serialize;
use serde_json::{Map, Value};
use sha2::{Digest as _, Sha256};
use std::collections::BTreeMap;
use std::path::Path;

/// The files that decide what comes of a fit, and its options.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Request {
    /// The goal's path, as it was given.
    pub(super) goal: String,
    /// SHA-256 of the goal's file, in hexadecimal digits.
    pub(super) goal_sha256: String,
    /// The same of every other file that is read: masks, further pictures, the species of the start.
    pub(super) inputs_sha256: BTreeMap<String, String>,
    /// The program that makes the goal's mask.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) mask_command: Option<String>,
    /// All options, which the report of the fit writes.
    #[serde(skip)]
    pub(super) options: Map<String, Value>,
}

impl Request {
    /// The request of a fit of `goal`, whose file is `source`.
    pub(super) fn new(
        goal: &Path,
        source: &Encoded,
        options: &FitOptions,
        segmenter: Option<&Segmenter>,
    ) -> anyhow::Result<Self> {
        let inputs =
            options.files().into_iter().map(|file| Ok((file.to_owned(), file_sha256(file.as_ref())?)));
        let Value::Object(written) = serde_json::to_value(options.spelled_out())? else {
            anyhow::bail!("options are an object");
        };
        Ok(Self {
            goal: goal.display().to_string(),
            goal_sha256: digits(Sha256::digest(source.file_bytes())),
            inputs_sha256: inputs.collect::<anyhow::Result<_>>()?,
            mask_command: segmenter.map(|command| command.text().to_owned()),
            options: written,
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
        let (then, usual) = (&summary["options"], defaults());
        for (key, value) in &self.options {
            // Options that came later were not given before.
            let before = if then.is_object() { then.get(key).or(usual.get(key)) } else { None };
            match before {
                Some(before) if is_same(before, value) => {}
                Some(before) => list.push(format!(
                    "{} was {} and is {}",
                    flag(key),
                    shown(key, before),
                    shown(key, value)
                )),
                None => list.push(format!(
                    "{} is {}, and it does not say what it was",
                    flag(key),
                    shown(key, value)
                )),
            }
        }
        let (before, now) = (summary["mask_command"].as_str(), self.mask_command.as_deref());
        if before != now {
            let said = |command: Option<&str>| command.unwrap_or("nothing").to_owned();
            list.push(format!("--mask-command was {} and is {}", said(before), said(now)));
        }
        let changed = self.inputs_sha256.iter().filter(|(path, hash)| {
            summary["inputs_sha256"][path.as_str()].as_str().is_some_and(|then| then != hash.as_str())
        });
        list.extend(changed.map(|(path, _)| format!("{path} has changed since")));
        list
    }
}

/// Whether two values of an option are the same; a number that was read back from a file may differ in its last bit.
fn is_same(one: &Value, other: &Value) -> bool {
    match (one.as_f64(), other.as_f64()) {
        (Some(one), Some(other)) => (one - other).abs() <= 1e-14 * one.abs().max(other.abs()),
        _ => match (one, other) {
            (Value::Array(some), Value::Array(others)) => {
                some.len() == others.len() && some.iter().zip(others).all(|(one, other)| is_same(one, other))
            }
            _ => one == other,
        },
    }
}

/// The value of an option as it is typed.
pub(in crate::commands) fn shown(key: &str, value: &Value) -> String {
    let list = |values: &[Value], between: &str| {
        values.iter().map(|value| shown("", value)).collect::<Vec<_>>().join(between)
    };
    match value {
        Value::Null => "nothing".to_owned(),
        Value::Array(values) if values.is_empty() => "nothing".to_owned(),
        Value::Array(values) if values[0].is_number() => list(values, ","),
        Value::Array(values) => list(values, " "),
        Value::String(text) => text.clone(),
        Value::Number(number) if key == "timeout" => {
            format!("{}s", number.as_f64().unwrap_or(f64::NAN))
        }
        Value::Number(number) if number.is_f64() => number.as_f64().unwrap_or(f64::NAN).to_string(),
        other => other.to_string(),
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

#[cfg(test)]
mod tests {
    use super::super::args::Fit;
    use super::*;

    fn request(seed: u64) -> Request {
        let options = Map::from_iter([("seed".to_owned(), seed.into()), ("size".to_owned(), 64.into())]);
        Request {
            goal: "oak.png".to_owned(),
            goal_sha256: "ab".to_owned(),
            inputs_sha256: BTreeMap::from([("side.png".to_owned(), "01".to_owned())]),
            mask_command: None,
            options,
        }
    }

    /// As the summary of a fit has it.
    fn summary(of: &Request) -> Value {
        let mut summary = serde_json::to_value(of).unwrap();
        summary["options"] = Value::Object(of.options.clone());
        summary
    }

    #[test]
    fn what_differs_is_named_with_both_values() {
        let summary = summary(&request(1));
        assert!(request(1).differences(&summary).is_empty());
        assert_eq!(request(2).differences(&summary), ["--seed was 1 and is 2"]);
        let moved = Request { goal: "a/oak.png".to_owned(), ..request(1) };
        assert!(moved.differences(&summary).is_empty(), "the same picture at another place");
        let other = Request { goal_sha256: "cd".to_owned(), ..moved };
        assert_eq!(other.differences(&summary), ["its goal was oak.png and is a/oak.png"]);
        let changed = Request { goal_sha256: "cd".to_owned(), ..request(1) };
        assert_eq!(changed.differences(&summary), ["oak.png has changed since"]);
        let side = BTreeMap::from([("side.png".to_owned(), "02".to_owned())]);
        let side = Request { inputs_sha256: side, ..request(1) };
        assert_eq!(side.differences(&summary), ["side.png has changed since"]);
        let command = Request { mask_command: Some("rembg i {in} {out}".to_owned()), ..request(1) };
        assert_eq!(command.differences(&summary), ["--mask-command was nothing and is rembg i {in} {out}"]);
        let silent = serde_json::json!({ "finished": true });
        assert_eq!(request(1).differences(&silent).len(), 3, "a summary that says nothing is of another fit");
        // An option that came later, by default and not.
        let older = summary_without(&request(1), "size");
        assert_eq!(request(1).differences(&older), ["--size was 256 and is 64"]);
        let usual = Request { options: Map::from_iter([("size".to_owned(), 256.into())]), ..request(1) };
        assert!(usual.differences(&older).is_empty());
    }

    fn summary_without(of: &Request, key: &str) -> Value {
        let mut summary = summary(of);
        let _ = summary["options"].as_object_mut().unwrap().remove(key);
        summary
    }

    #[test]
    fn values_are_shown_as_they_are_typed() {
        let json = |text: &str| serde_json::from_str::<Value>(text).unwrap();
        for (key, value, expected) in [
            ("height", "10.0", "10"),
            ("timeout", "20.0", "20s"),
            ("frame", "[0.05, 30.0, 60.5]", "0.05,30,60.5"),
            ("free", r#"["crown", "leaves"]"#, "crown leaves"),
            ("fix", "[]", "nothing"),
            ("mask", "null", "nothing"),
            ("optimizer", r#"{"cma": {"population": 8}}"#, r#"{"cma":{"population":8}}"#),
        ] {
            assert_eq!(shown(key, &json(value)), expected);
        }
    }

    /// The options of `pleach fit`, and what each of them may be given that is not its default.
    const GIVEN: [(&str, &str); 44] = [
        ("height", "12"),
        ("size", "64"),
        ("mask", "auto"),
        ("mask_command", "rembg i {in} {out}"),
        ("region", "1,2,30,40"),
        ("include", "5,6"),
        ("exclude", "7,8"),
        ("strokes", "marks.png"),
        ("wood", "wood.png"),
        ("tree", "dark"),
        ("ground_row", "200"),
        ("axis_column", "100.5"),
        ("view", "30"),
        ("free_frame", ""),
        ("reading", "tests/data/reading.json"),
        ("trunks", "2"),
        ("trunk_width", "0.05"),
        ("lean", "-4"),
        ("bare_height", "0.2"),
        ("first_fork", "none"),
        ("holdout_view", "45=corner.png"),
        ("appearance", "species"),
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
        ("posterior", "300"),
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

    fn options_of(line: &[&str]) -> Map<String, Value> {
        use clap::Parser as _;
        let line = ["fit", "goal.png"].iter().chain(line);
        let fit = Line::try_parse_from(line).unwrap_or_else(|error| panic!("{error}")).fit;
        let options = fit.as_typed(&fit.goal_options).unwrap();
        let Value::Object(options) = serde_json::to_value(options).unwrap() else { panic!("an object") };
        options
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
