//! Problems of a grammar, each with its place, and how they are drawn.

mod fault;

pub use fault::Fault;

use crate::syntax::Span;
use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};
use pleach_tree::species::excerpt;
use std::fmt;

/// One problem at one place.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// Bytes of the grammar's text.
    pub span: Span,
    /// What is wrong.
    pub fault: Fault,
}

impl Diagnostic {
    /// A problem at `span`.
    #[must_use]
    pub const fn new(span: Span, fault: Fault) -> Self {
        Self { span, fault }
    }
}

/// Problems with the text that they are about.
///
/// Shown as drawings of the lines with carets under the places.
#[derive(Clone, Debug)]
pub struct Report {
    /// File name, or what stands for it.
    pub origin: String,
    /// The grammar's text, empty where it was too large to read.
    pub text: String,
    /// The problems in order of place; at least one.
    pub diagnostics: Vec<Diagnostic>,
}

/// Line and column of a byte of `text`, as [`Report::place`] has them.
pub(crate) fn place(text: &str, byte: usize) -> (usize, usize) {
    let before = &text[..excerpt::floor(text, byte)];
    let line_start = before.rfind('\n').map_or(0, |i| i + 1);
    (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
}

/// Most problems that a report shows.
const MAX_SHOWN: usize = 20;

impl Report {
    pub(crate) fn new(origin: &str, text: &str, mut diagnostics: Vec<Diagnostic>) -> Self {
        diagnostics.sort_by_key(|d| d.span.start);
        Self { origin: origin.to_owned(), text: text.to_owned(), diagnostics }
    }

    /// Line and column of a byte, both from 1, the column in characters.
    #[must_use]
    pub fn place(&self, byte: usize) -> (usize, usize) {
        place(&self.text, byte)
    }

    /// The drawings, with colours or without.
    #[must_use]
    pub fn draw(&self, colored: bool) -> String {
        let text = excerpt::drawable(&self.text);
        let renderer = if colored { Renderer::styled() } else { Renderer::plain() };
        let mut drawing = String::new();
        for diagnostic in self.diagnostics.iter().take(MAX_SHOWN) {
            let Diagnostic { span, fault } = diagnostic;
            let title = fault.to_string();
            let start = excerpt::floor(&self.text, span.start);
            let end = excerpt::floor(&self.text, span.end).max(start);
            let level = if fault.is_warning() { Level::WARNING } else { Level::ERROR };
            let help = fault.help();
            let (line, column) = self.place(start);
            if touched(&text, start, end).lines().any(excerpt::is_long) {
                let word = if fault.is_warning() { "warning" } else { "error" };
                let lines = excerpt::excerpt(&text, &(start..end), help.as_deref(), colored);
                drawing
                    .push_str(&format!("{word}: {title}\n --> {}:{line}:{column}\n{lines}\n", self.origin));
                continue;
            }
            let place = Snippet::source(text.as_str())
                .path(self.origin.as_str())
                .annotation(AnnotationKind::Primary.span(start..end));
            let mut group = level.primary_title(title.as_str()).element(place);
            if let Some(help) = &help {
                group = group.element(Level::HELP.message(help.as_str()));
            }
            drawing.push_str(&renderer.render(&[group]));
            drawing.push('\n');
        }
        if let Some(more) = self.diagnostics.len().checked_sub(MAX_SHOWN + 1) {
            drawing.push_str(&format!("and {} more\n", more + 1));
        }
        drawing
    }
}

/// The lines that the bytes from `start` to `end` of `text` touch.
fn touched(text: &str, start: usize, end: usize) -> &str {
    let first = text[..start].rfind('\n').map_or(0, |at| at + 1);
    let last = text[end..].find('\n').map_or(text.len(), |at| end + at);
    &text[first..last]
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.draw(false).trim_end())
    }
}

impl std::error::Error for Report {}
