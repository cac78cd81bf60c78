//! The line of a text that a message is about, drawn with carets under the place.

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use std::ops::Range;

/// Of lines with more bytes only what is around the place is drawn: all would say nothing on a screen.
const MAX_LINE: usize = 1000;
/// Characters before and after the start of such a place.
const AROUND: usize = 40;

/// The first line of `span`, bytes of `text`, with carets under it, and what would be right; empty for an
/// empty text. With colours for terminals or without.
#[must_use]
pub fn excerpt(text: &str, span: &Range<usize>, help: Option<&str>, colored: bool) -> String {
    if text.is_empty() {
        return String::new();
    }
    let start = floor(text, span.start);
    let line_start = text[..start].rfind('\n').map_or(0, |at| at + 1);
    let number = text[..line_start].matches('\n').count() + 1;
    let line = text[line_start..].lines().next().unwrap_or_default();
    let from = (start - line_start).min(line.len());
    let to = span.end.saturating_sub(line_start).clamp(from, line.len());
    let (line, from, to) = if is_long(line) { around(line, from, to) } else { (line, from, to) };
    let line = drawable(line);
    let place =
        Snippet::source(line.as_str()).line_start(number).annotation(AnnotationKind::Primary.span(from..to));
    let mut group = Group::with_level(Level::ERROR).element(place);
    if let Some(help) = help {
        group = group.element(Level::HELP.message(help));
    }
    let renderer = if colored { Renderer::styled() } else { Renderer::plain() };
    renderer.render(&[group])
}

/// Whether a line is too long to be drawn whole.
#[must_use]
pub fn is_long(line: &str) -> bool {
    line.len() > MAX_LINE
}

/// `text` without the two-byte control characters, which the renderer lets through and terminals obey; as
/// many bytes as before.
#[must_use]
pub fn drawable(text: &str) -> String {
    text.replace(|c: char| matches!(c, '\u{80}'..='\u{9f}'), "\u{b7}")
}

/// The last boundary of characters of `text` that is not after byte `at`.
#[must_use]
pub fn floor(text: &str, at: usize) -> usize {
    (0..=at.min(text.len())).rev().find(|&at| text.is_char_boundary(at)).unwrap_or(0)
}

/// What of `line` is near byte `from`, and where the bytes from `from` to `to` are in it.
fn around(line: &str, from: usize, to: usize) -> (&str, usize, usize) {
    let first = line[..from].char_indices().rev().take(AROUND).last().map_or(from, |(at, _)| at);
    let end = line[from..].char_indices().nth(AROUND).map_or(line.len(), |(at, _)| from + at);
    (&line[first..end], from - first, to.min(end) - first)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn carets_stand_under_the_place() {
        let drawing = excerpt("a\nbcd\n", &(3..5), Some("e"), false);
        assert!(drawing.contains("2 | bcd\n  |  ^^") && drawing.contains("help: e"), "{drawing}");
        assert_eq!(excerpt("", &(0..1), None, false), "");
    }

    #[test]
    fn of_long_lines_what_is_around_is_drawn() {
        let text = format!("{}\u{e4}oak{}", "x".repeat(5000), "y".repeat(5000));
        let drawing = excerpt(&text, &(5002..5005), None, false);
        let lines: Vec<&str> = drawing.lines().collect();
        let caret = lines.iter().position(|line| line.contains("^^^")).unwrap();
        let at = lines[caret].chars().position(|c| c == '^').unwrap();
        let under: String = lines[caret - 1].chars().skip(at).take(3).collect();
        assert_eq!(under, "oak", "{drawing}");
        assert!(drawing.len() < 300, "{drawing}");
    }
}
