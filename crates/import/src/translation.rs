//! A species on its way from one file to the other: numbers with the places where they were found.

use crate::literal::{Node, Value};
use crate::program::Program;
use crate::source::Source;
use pleach_tree::SpeciesError;
use pleach_tree::param::{Problem, shown};
use pleach_tree::species::{Issue, safe_name};
use std::fmt::Write as _;
use std::ops::Range;

/// A species of another program, translated.
#[derive(Clone, Debug, PartialEq)]
pub struct Foreign {
    /// The program that it was written for.
    pub program: Program,
    /// The species file.
    pub toml: String,
    /// Where the numbers of each parameter stand in the other program's file: name, or that of one number of a list where
    /// they stand apart, and bytes of the text.
    pub places: Vec<(String, Range<usize>)>,
    /// Names in that file that have no counterpart. What is switched off there, by false or nothing, is not listed.
    pub without_counterpart: Vec<String>,
    /// What else is to be said about the translation, a sentence each.
    pub notes: Vec<String>,
}

impl Foreign {
    /// What is wrong with the numbers of [`Foreign::toml`], with the places of the other program's file: `text`, which
    /// messages call `origin`.
    #[must_use]
    pub fn relocated(&self, origin: &str, text: &str, error: SpeciesError) -> SpeciesError {
        let source = Source { origin, text };
        let moved = |issue: Issue| {
            let place = |name: &str| self.places.iter().find(|(known, _)| known == name);
            let list = issue.parameter.split('[').next().unwrap_or_default();
            let place = place(&issue.parameter).or_else(|| place(list));
            source.issue(place.map_or(0..0, |(_, span)| span.clone()), &issue.parameter, issue.problem)
        };
        source.errors(error.issues.into_iter().map(moved).collect())
    }
}

/// Levels of stems that parameters may differ by.
pub(crate) const LEVELS: usize = 4;

/// A species that is being put together.
pub(crate) struct Translation<'a> {
    source: &'a Source<'a>,
    program: Program,
    lines: String,
    places: Vec<(String, Range<usize>)>,
    without_counterpart: Vec<String>,
    notes: Vec<String>,
    issues: Vec<Issue>,
}

impl<'a> Translation<'a> {
    pub(crate) fn new(source: &'a Source<'a>, program: Program) -> Self {
        let lines = "generator = \"weber-penn\"\n".to_owned();
        let (places, without_counterpart, notes, issues) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Self { source, program, lines, places, without_counterpart, notes, issues }
    }

    /// What was put together, or everything that was wrong.
    pub(crate) fn finish(self) -> Result<Foreign, SpeciesError> {
        if !self.issues.is_empty() {
            return Err(self.source.errors(self.issues));
        }
        let Self { program, lines: toml, places, without_counterpart, notes, .. } = self;
        Ok(Foreign { program, toml, places, without_counterpart, notes })
    }

    /// Says that the species is called `name`.
    pub(crate) fn name(&mut self, name: &str) {
        let name = safe_name(name).replace(['\\', '"'], "_");
        if !name.is_empty() {
            let _ = writeln!(self.lines, "name = \"{name}\"");
        }
    }

    /// Says that trees are grown without leaves.
    pub(crate) fn bare(&mut self) {
        self.lines.push_str("bare = true\n");
    }

    /// Sets a parameter of one number, which was found at `span`.
    pub(crate) fn set(&mut self, parameter: &str, value: f64, span: &Range<usize>) {
        self.check(parameter, &[value], span);
        let _ = writeln!(self.lines, "{parameter} = {}", number(value));
        self.place(parameter, span);
    }

    /// Sets a parameter of several numbers, which were found at `span`.
    pub(crate) fn set_list(&mut self, parameter: &str, values: &[f64], span: &Range<usize>) {
        self.check(parameter, values, span);
        let numbers: Vec<String> = values.iter().map(|value| number(*value)).collect();
        let _ = writeln!(self.lines, "{parameter} = [{}]", numbers.join(", "));
        self.place(parameter, span);
    }

    /// Says that a parameter, or one number of a list, such as `curve[3]`, was found at `span`.
    pub(crate) fn place(&mut self, parameter: &str, span: &Range<usize>) {
        self.places.push((parameter.to_owned(), span.clone()));
    }

    /// Takes note of what has become infinite or no number by computing.
    fn check(&mut self, parameter: &str, values: &[f64], span: &Range<usize>) {
        if let Some(&value) = values.iter().find(|value| !value.is_finite()) {
            self.wrong(parameter, span, Problem::NotFinite { value });
        }
    }

    /// Lists `name` as one without a counterpart, unless `value` switches it off.
    pub(crate) fn omit(&mut self, name: &str, value: &Value) {
        if !matches!(value, Value::Flag(false) | Value::Nothing) {
            self.omit_name(name);
        }
    }

    pub(crate) fn omit_name(&mut self, name: &str) {
        let name = shown(name);
        if !self.without_counterpart.contains(&name) {
            self.without_counterpart.push(name);
        }
    }

    pub(crate) fn note(&mut self, note: impl Into<String>) {
        self.notes.push(note.into());
    }

    /// Takes note of a value that cannot be what it is.
    pub(crate) fn wrong(&mut self, name: &str, span: &Range<usize>, problem: Problem) {
        self.issues.push(self.source.issue(span.clone(), name, problem));
    }

    /// Takes note of a value of another type.
    pub(crate) fn wrong_type(&mut self, name: &str, node: &Node, expected: &'static str) {
        let found = match &node.value {
            Value::Text(text) => format!("the string `{}`", shown(text)),
            other => other.type_name().to_owned(),
        };
        self.wrong(name, &node.span, Problem::WrongType { expected, found });
    }

    /// The number that `node` is, also one in quotes; otherwise the problem is noted.
    pub(crate) fn number(&mut self, name: &str, node: &Node) -> Option<f64> {
        let number = match &node.value {
            Value::Number(number) => Some(*number),
            Value::Text(text) => text.trim().parse().ok().filter(|number: &f64| number.is_finite()),
            Value::Flag(flag) => Some(f64::from(u8::from(*flag))),
            _ => None,
        };
        if number.is_none() {
            self.wrong_type(name, node, "a number");
        }
        number
    }

    /// The `N` numbers that `node` is; otherwise the problem is noted.
    pub(crate) fn numbers<const N: usize>(&mut self, name: &str, node: &Node) -> Option<[f64; N]> {
        let Value::List(nodes) = &node.value else {
            self.wrong_type(name, node, "a list of numbers");
            return None;
        };
        let mut numbers = Vec::with_capacity(N);
        for node in nodes.iter().take(N) {
            numbers.push(self.number(name, node)?);
        }
        let found = nodes.len();
        numbers.try_into().ok().filter(|_| found == N).or_else(|| {
            self.wrong(name, &node.span, Problem::WrongLength { expected: N, found });
            None
        })
    }
}

/// A number as a species file has it: without a point where it is whole, and without what computing has left in the
/// tenth digit after the point and beyond.
fn number(value: f64) -> String {
    const DIGITS: f64 = 1e9;
    let value = if value.abs() < 1e6 { (value * DIGITS).round() / DIGITS } else { value };
    if value.fract() == 0.0 && value.abs() < 1e15 {
        format!("{}", value as i64)
    } else {
        format!("{value:?}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_those_of_species_files() {
        assert_eq!(
            ["3", "-2", "0", "0.5", "1e300"].map(str::to_owned),
            [3.0, -2.0, -0.0, 0.5, 1e300].map(number)
        );
    }
}
