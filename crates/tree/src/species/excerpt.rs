//! The line of a file that a message is about, drawn with carets under the place.

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use std::ops::Range;

/// Lines with more bytes are not drawn: they would say nothing on a screen.
const MAX_LINE: usize = 2000;

/// The first line of `span` in `text` with carets under it, and what would be right; nothing where the
/// line is too long to be shown.
pub(super) fn excerpt(text: &str, span: &Range<usize>, help: Option<&str>, colored: bool) -> Option<String> {
    let mut start = span.start.min(text.len());
    while !text.is_char_boundary(start) {
        start -= 1;
    }
    let line_start = text[..start].rfind('\n').map_or(0, |at| at + 1);
    let line = text[line_start..].lines().next().unwrap_or_default();
    if text.is_empty() || line.len() > MAX_LINE {
        return None;
    }
    let from = (start - line_start).min(line.len());
    let to = span.end.saturating_sub(line_start).clamp(from, line.len());
    let number = text[..line_start].matches('\n').count() + 1;
    // Two-byte control characters, which the renderer lets through and terminals obey; as many bytes as
    // before.
    let line = line.replace(|c: char| matches!(c, '\u{80}'..='\u{9f}'), "\u{b7}");
    let place =
        Snippet::source(line.as_str()).line_start(number).annotation(AnnotationKind::Primary.span(from..to));
    let mut group = Group::with_level(Level::ERROR).element(place);
    if let Some(help) = help {
        group = group.element(Level::HELP.message(help));
    }
    let renderer = if colored { Renderer::styled() } else { Renderer::plain() };
    Some(renderer.render(&[group]))
}
