//! Problems of a species file, each with its place.

use crate::param::{Problem, escaped, shown};
use std::fmt;

/// One problem at one place.
#[derive(Clone, Debug, PartialEq)]
pub struct Issue {
    /// File name, or what stands for it.
    pub origin: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// The parameter or key it is about; empty if it is about the whole file.
    pub parameter: String,
    /// What is wrong.
    pub problem: Problem,
}

impl fmt::Display for Issue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { origin, line, column, parameter, problem } = self;
        write!(f, "{}:{line}:{column}: ", escaped(origin, usize::MAX))?;
        if !parameter.is_empty() {
            write!(f, "`{}` ", shown(parameter))?;
        }
        write!(f, "{problem}")
    }
}

/// Everything that is wrong with a species file.
#[derive(Clone, Debug, PartialEq)]
pub struct SpeciesError {
    /// The problems in order of place; at least one.
    pub issues: Vec<Issue>,
}

impl fmt::Display for SpeciesError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        /// Problems that are listed, at most.
        const MAX: usize = 20;
        for (i, issue) in self.issues.iter().take(MAX).enumerate() {
            if i > 0 {
                writeln!(f)?;
            }
            write!(f, "{issue}")?;
        }
        match self.issues.len().saturating_sub(MAX) {
            0 => Ok(()),
            1 => write!(f, "\nand one more mistake"),
            more => write!(f, "\nand {more} more mistakes"),
        }
    }
}

impl std::error::Error for SpeciesError {}
