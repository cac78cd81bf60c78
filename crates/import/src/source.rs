//! A file that is being read, and messages about its places.

use pleach_tree::SpeciesError;
use pleach_tree::param::Problem;
use pleach_tree::species::Issue;
use std::ops::Range;

/// A file's name and text.
pub(crate) struct Source<'a> {
    pub(crate) origin: &'a str,
    pub(crate) text: &'a str,
}

impl Source<'_> {
    /// A problem with `parameter` at the bytes `span`.
    pub(crate) fn issue(&self, span: Range<usize>, parameter: &str, problem: Problem) -> Issue {
        let at = pleach_tree::species::excerpt::floor(self.text, span.start);
        let before = &self.text[..at];
        Issue {
            origin: self.origin.to_owned(),
            line: before.matches('\n').count() + 1,
            column: before.rsplit('\n').next().map_or(0, |line| line.chars().count()) + 1,
            span,
            parameter: parameter.to_owned(),
            problem,
            help: None,
        }
    }

    /// An error of one sentence about the bytes `span`.
    pub(crate) fn wrong(&self, span: Range<usize>, message: &str) -> SpeciesError {
        self.errors(vec![self.issue(span, "", Problem::Syntax { message: message.to_owned() })])
    }

    /// An error of several problems.
    pub(crate) fn errors(&self, mut issues: Vec<Issue>) -> SpeciesError {
        issues.sort_by_key(|issue| issue.span.start);
        SpeciesError::new(self.text, issues)
    }
}
