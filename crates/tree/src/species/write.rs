//! Species as text.

use super::Species;
use super::name::safe_name;
use crate::param::{Kind, is_hidden};
use std::fmt::Write as _;

pub(super) fn species(species: &Species, comments: &[String]) -> String {
    let mut text = String::new();
    for line in comments {
        text.push_str("# ");
        text.extend(line.chars().map(|c| if is_hidden(c) { ' ' } else { c }));
        text.push('\n');
    }
    let space = species.generator.space();
    line(&mut text, "generator", &quoted(species.generator.family()));
    if !species.name.is_empty() {
        line(&mut text, "name", &quoted(&safe_name(&species.name)));
    }
    if !species.description.is_empty() {
        let plain = |c: char| if is_hidden(c) && c != '\n' { ' ' } else { c };
        let description: String = species.description.chars().map(plain).collect();
        line(&mut text, "description", &quoted(&description));
    }
    if let Some(seed) = species.tree_seed {
        line(&mut text, "tree_seed", &seed.to_string());
    }
    let mut group = "";
    for (i, param) in space.params().iter().enumerate() {
        if param.group != group {
            group = param.group;
            text.push_str("\n# ");
            text.push_str(group);
            text.push('\n');
        }
        let numbers: Vec<String> = species.params.of(space, i).iter().map(|&v| number(v)).collect();
        let value = if numbers.len() == 1 { numbers[0].clone() } else { format!("[{}]", numbers.join(", ")) };
        line(&mut text, &param.name, &value);
        if let Kind::Choice { first, names } = param.kind {
            let chosen = (species.params.of(space, i)[0] as i64 - first) as usize;
            text.truncate(text.len() - 1);
            text.push_str("  # ");
            text.push_str(names[chosen]);
            text.push('\n');
        }
    }
    let extra = species.generator.extra_toml();
    if !extra.is_empty() {
        text.push('\n');
        text.push_str(&extra);
    }
    // A table ends where the next begins, so it comes last.
    text.push_str(&species.appearance.to_toml());
    text
}

fn line(text: &mut String, key: &str, value: &str) {
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{key} = {value}");
}

/// The shortest text that reads back as the same number.
fn number(value: f64) -> String {
    if value.fract() == 0.0 && value.abs() < 1e15 {
        format!("{}", value as i64)
    } else {
        format!("{value:?}")
    }
}

fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}
