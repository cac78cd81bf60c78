//! Problems of a grammar, each with its place, and how they are drawn.

mod fault;

pub use fault::Fault;

use crate::syntax::Span;
use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};
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

/// Problems beyond which nobody reads on.
const MAX_SHOWN: usize = 20;
/// Of lines with more bytes only what is around a place is drawn: all would say nothing on a screen.
const MAX_LINE: usize = 1000;
/// Characters before and after such a place.
const AROUND: usize = 40;

impl Report {
    pub(crate) fn new(origin: &str, text: &str, mut diagnostics: Vec<Diagnostic>) -> Self {
        diagnostics.sort_by_key(|d| d.span.start);
        Self { origin: origin.to_owned(), text: text.to_owned(), diagnostics }
    }

    /// Line and column of a byte, both from 1, the column in characters.
    #[must_use]
    pub fn place(&self, byte: usize) -> (usize, usize) {
        let mut byte = byte.min(self.text.len());
        while !self.text.is_char_boundary(byte) {
            byte -= 1;
        }
        let before = &self.text[..byte];
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
    }

    /// The place of a byte with a few characters around it, for lines that are too long to be drawn.
    fn cut_out(&self, start: usize) -> String {
        let (line, column) = self.place(start);
        let is_boundary = |&at: &usize| self.text.is_char_boundary(at);
        let start = (0..=start).rev().find(is_boundary).unwrap_or(0);
        let shown = |c: char| if c.is_control() { '\u{b7}' } else { c };
        let before: String =
            self.text[..start].chars().rev().take_while(|&c| c != '\n').take(AROUND).map(shown).collect();
        let before: String = before.chars().rev().collect();
        let after: String =
            self.text[start..].chars().take_while(|&c| c != '\n').take(AROUND).map(shown).collect();
        let number = line.to_string();
        let (margin, indent) = (" ".repeat(number.len()), " ".repeat(before.chars().count()));
        format!(
            "{margin}--> {}:{line}:{column}\n{margin} |\n{number} | {before}{after}\n{margin} | {indent}^\n",
            self.origin
        )
    }

    /// The drawings, with colours or without.
    #[must_use]
    pub fn draw(&self, colored: bool) -> String {
        // What the renderer lets through and terminals obey; as many bytes as before.
        let text = self.text.replace(is_c1_control, "\u{b7}");
        let renderer = if colored { Renderer::styled() } else { Renderer::plain() };
        let mut drawing = String::new();
        for diagnostic in self.diagnostics.iter().take(MAX_SHOWN) {
            let Diagnostic { span, fault } = diagnostic;
            let title = fault.to_string();
            let start = span.start.min(self.text.len());
            let end = span.end.clamp(start, self.text.len());
            let level = if fault.is_warning() { Level::WARNING } else { Level::ERROR };
            if longest_line(&text, start, end) > MAX_LINE {
                let word = if fault.is_warning() { "warning" } else { "error" };
                drawing.push_str(&format!("{word}: {title}\n{}", self.cut_out(start)));
                continue;
            }
            let place = Snippet::source(text.as_str())
                .path(self.origin.as_str())
                .annotation(AnnotationKind::Primary.span(start..end));
            let mut group = level.primary_title(title.as_str()).element(place);
            let help = fault.help();
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

/// Bytes of the longest line that the bytes from `start` to `end` of `text` touch.
fn longest_line(text: &str, start: usize, end: usize) -> usize {
    let first = text.as_bytes()[..start].iter().rposition(|&b| b == b'\n').map_or(0, |at| at + 1);
    let last = text.as_bytes()[end..].iter().position(|&b| b == b'\n').map_or(text.len(), |at| end + at);
    text.as_bytes()[first..last].split(|&b| b == b'\n').map(<[u8]>::len).max().unwrap_or(0)
}

/// Whether a character is one of the two-byte control characters from U+0080 to U+009F.
const fn is_c1_control(c: char) -> bool {
    matches!(c, '\u{80}'..='\u{9f}')
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.draw(false).trim_end())
    }
}

impl std::error::Error for Report {}
