//! Species as text.

use super::Species;
use super::appearance;
use super::name::safe_name;
use crate::param::{Kind, Shape, is_hidden};
use pleach_plant::Foliage;
use std::fmt::Write as _;

pub(super) fn species(species: &Species, comments: &[String]) -> String {
    let mut text = String::new();
    comments.iter().for_each(|paragraph| comment(&mut text, paragraph));
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
    if species.foliage == Foliage::None {
        line(&mut text, "bare", "true");
    }
    for group in space.groups() {
        text.push_str("\n# ");
        text.push_str(group);
        text.push('\n');
        parameters(&mut text, species, group);
    }
    let structure = species.generator.written();
    if !structure.is_empty() {
        text.push('\n');
        text.push_str(&structure);
    }
    // A table ends where the next begins, so it comes last.
    text.push_str(&appearance::to_toml(&species.appearance));
    text
}

/// The parameters of one group, a line each.
fn parameters(text: &mut String, species: &Species, group: &str) {
    let space = species.generator.space();
    for (i, param) in space.params().iter().enumerate().filter(|(_, param)| param.group == group) {
        let values = species.params.list(i);
        let numbers: Vec<String> = values.iter().map(|&v| number(v)).collect();
        let is_scalar = param.shape == Shape::Scalar;
        let value = if is_scalar { numbers[0].clone() } else { format!("[{}]", numbers.join(", ")) };
        line(text, &param.name, &value);
        if let (Kind::Choice { first, names }, true) = (&param.kind, is_scalar) {
            let chosen = (values[0] as i64 - first) as usize;
            text.truncate(text.len() - 1);
            text.push_str("  # ");
            text.push_str(&names[chosen]);
            text.push('\n');
        }
    }
}

/// Columns of the longest line of a comment, unless a single word is longer.
const COLUMNS: usize = 100;

/// A paragraph as lines that begin with `#`. Whatever would end a comment counts as a space.
fn comment(text: &mut String, paragraph: &str) {
    let mut line = String::from("#");
    for word in paragraph.split(|c: char| c.is_whitespace() || c.is_control()).filter(|w| !w.is_empty()) {
        if line.len() > 1 && line.chars().count() + 1 + word.chars().count() > COLUMNS {
            text.push_str(&line);
            text.push('\n');
            line.truncate(1);
        }
        line.push(' ');
        line.push_str(word);
    }
    text.push_str(&line);
    text.push('\n');
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

#[cfg(test)]
mod tests {
    use super::comment;

    #[test]
    fn comments_are_wrapped_and_stay_comments() {
        let mut text = String::new();
        comment(&mut text, "short");
        let names: Vec<String> = (0..60).map(|i| format!("parameter[{i}]")).collect();
        comment(&mut text, &format!("Not seen: {}.", names.join(", ")));
        comment(&mut text, "generator\n= \u{1b}[0m\r1");
        comment(&mut text, &"x".repeat(150));
        assert!(text.starts_with("# short\n# Not seen: parameter[0], "), "{text}");
        assert!(text.lines().all(|line| line.starts_with("# ")), "{text}");
        assert!(text.contains("# generator = [0m 1\n"), "{text}");
        let long: Vec<usize> = text.lines().map(str::len).filter(|len| *len > 100).collect();
        assert_eq!(long, [152], "only the word that has no end");
        assert!(text.lines().nth(1).unwrap().len() > 80, "lines are filled");
        assert_eq!(names.iter().filter(|name| text.contains(name.as_str())).count(), 60);
    }
}
