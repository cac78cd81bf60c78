//! Fits that were made with other options, or by another version, than most.

use super::collected::{Collected, Differences, State};
use crate::commands::fit::flags::flag;
use crate::commands::fit::request::shown;
use serde_json::Value;
use std::collections::BTreeMap;

/// Options that a list gives each goal, and those that follow from them.
const OF_A_GOAL: [&str; 7] = ["height", "view", "mask", "tree", "ground_row", "axis_column", "leaves"];

/// What all fits of a batch have in common: the version and the options with their values.
type Common = BTreeMap<String, String>;

fn common(summary: &Value) -> Common {
    let options = summary["options"].as_object().into_iter().flatten();
    let options = options.filter(|(name, _)| !OF_A_GOAL.contains(&name.as_str()));
    let mut common: Common = options.map(|(key, value)| (flag(key), shown(key, value))).collect();
    let _ = common.insert("the version".to_owned(), shown("version", &summary["version"]));
    common
}

/// Notes of every finished goal how its fit differs from those of most.
pub(super) fn compare(goals: &mut [Collected]) {
    let all: Vec<Option<Common>> = goals
        .iter()
        .map(|goal| match &goal.state {
            State::Finished(run) => Some(common(&run.summary)),
            _ => None,
        })
        .collect();
    let mut counts: BTreeMap<&Common, usize> = BTreeMap::new();
    for one in all.iter().flatten() {
        *counts.entry(one).or_default() += 1;
    }
    // Of equally many, those of the goal that comes first.
    let most = counts.values().max().copied();
    let Some(most) = all.iter().flatten().find(|one| counts.get(one).copied() == most) else { return };
    for (goal, one) in goals.iter_mut().zip(&all) {
        goal.differences.extend(one.iter().flat_map(|one| differences(one, most)));
    }
}

fn differences(one: &Common, most: &Common) -> Differences {
    let nothing = || "not said".to_owned();
    let names = one.keys().chain(most.keys().filter(|name| !one.contains_key(*name)));
    let values = names.map(|name| (name, one.get(name), most.get(name)));
    let differing = values.filter(|(_, one, most)| one != most);
    differing
        .map(|(name, one, most)| {
            let text = |value: Option<&String>| value.cloned().unwrap_or_else(nothing);
            format!("{name} is {}, and {} in most", text(one), text(most))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::found::Run;
    use super::*;

    fn goal(name: &str, seed: &str, height: &str, version: &str) -> Collected {
        let options = serde_json::json!({ "seed": seed, "height": height });
        let summary = serde_json::json!({ "options": options, "version": version });
        let state = State::Finished(Run { folder: name.into(), summary });
        Collected { goal: name.into(), state, also_in: Vec::new(), differences: Vec::new() }
    }

    #[test]
    fn what_is_not_as_in_most_is_named() {
        let mut goals = [
            goal("a", "2", "10", "1"),
            goal("b", "1", "10", "1"),
            goal("c", "1", "20", "1"),
            goal("d", "1", "10", "2"),
        ];
        compare(&mut goals);
        let found: Vec<&[String]> = goals.iter().map(|goal| &goal.differences[..]).collect();
        assert_eq!(found[0], ["--seed is 2, and 1 in most"]);
        assert!(found[1].is_empty() && found[2].is_empty(), "a goal's own options may differ: {found:?}");
        assert_eq!(found[3], ["the version is 2, and 1 in most"]);
    }

    #[test]
    fn of_two_halves_the_first_is_most() {
        let mut goals = [goal("a", "2", "10", "1"), goal("b", "1", "10", "1")];
        compare(&mut goals);
        assert!(goals[0].differences.is_empty());
        assert_eq!(goals[1].differences, ["--seed is 1, and 2 in most"]);
    }
}
