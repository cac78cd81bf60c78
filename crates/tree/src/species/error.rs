//! Problems of a species file, each with its place.

use super::excerpt::excerpt;
use crate::param::{Problem, escaped, shown};
use std::fmt;
use std::ops::Range;

/// One problem at one place.
#[derive(Clone, Debug, PartialEq)]
pub struct Issue {
    /// File name, or what stands for it.
    pub origin: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// Bytes of the file that it is about.
    pub span: Range<usize>,
    /// The parameter or key it is about; empty if it is about the whole file.
    pub parameter: String,
    /// What is wrong.
    pub problem: Problem,
    /// What would be right, where the problem itself does not say it.
    pub help: Option<String>,
}

impl fmt::Display for Issue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { origin, line, column, parameter, problem, .. } = self;
        write!(f, "{}:{line}:{column}: ", escaped(origin, usize::MAX))?;
        if !parameter.is_empty() {
            write!(f, "`{}` ", shown(parameter))?;
        }
        write!(f, "{problem}")
    }
}

/// Everything that is wrong with a species file.
///
/// Its text has a line for each problem; [`SpeciesError::draw`] shows the places too.
#[derive(Clone, Debug, PartialEq)]
pub struct SpeciesError {
    /// The file's text, as far as it is text.
    pub text: String,
    /// The problems in order of place; at least one.
    pub issues: Vec<Issue>,
}

/// Problems that are listed, at most.
const MAX: usize = 20;

impl SpeciesError {
    /// The problems, at least one, of a file with this text.
    #[must_use]
    pub fn new(text: &str, issues: Vec<Issue>) -> Self {
        Self { text: text.to_owned(), issues }
    }

    /// The problems, each with its line of the file, a caret under the place and what would be right;
    /// with colours for terminals or without.
    #[must_use]
    pub fn draw(&self, colored: bool) -> String {
        let mut drawing = String::new();
        for (i, issue) in self.issues.iter().take(MAX).enumerate() {
            if i > 0 {
                drawing.push('\n');
            }
            drawing.push_str(&issue.to_string());
            if !self.text.is_empty() {
                drawing.push('\n');
                drawing.push_str(&excerpt(&self.text, &issue.span, issue.help.as_deref(), colored));
            }
        }
        drawing.push_str(&self.more());
        drawing
    }

    /// How many problems are not listed.
    fn more(&self) -> String {
        match self.issues.len().saturating_sub(MAX) {
            0 => String::new(),
            1 => "\nand one more mistake".to_owned(),
            more => format!("\nand {more} more mistakes"),
        }
    }
}

impl fmt::Display for SpeciesError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, issue) in self.issues.iter().take(MAX).enumerate() {
            if i > 0 {
                writeln!(f)?;
            }
            write!(f, "{issue}")?;
        }
        f.write_str(&self.more())
    }
}

impl std::error::Error for SpeciesError {}
