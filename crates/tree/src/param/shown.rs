//! Other people's text in our messages: short, and without anything that a terminal obeys.

use std::fmt::Write as _;

/// Characters that a message shows of a key or a value.
const MAX_CHARS: usize = 60;

/// Whether `c` moves the cursor, turns the writing direction or is otherwise not to be printed.
#[must_use]
pub(crate) fn is_hidden(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}')
}

/// `text` as messages show it: control characters and marks that change the writing direction
/// escaped, and no longer than 60 characters.
#[must_use]
pub fn shown(text: &str) -> String {
    let mut escaped = escaped(text, MAX_CHARS + 1);
    if let Some((end, _)) = escaped.char_indices().nth(MAX_CHARS) {
        escaped.truncate(end);
        escaped.push('…');
    }
    escaped
}

/// `text` with what is not to be printed escaped; ends soon after `enough` characters.
pub(crate) fn escaped(text: &str, enough: usize) -> String {
    let mut escaped = String::new();
    for c in text.chars().take(enough) {
        if is_hidden(c) {
            // Writing to a string cannot fail.
            let _ = write!(escaped, "{}", c.escape_unicode());
        } else {
            escaped.push(c);
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_plain_text_stays() {
        assert_eq!(shown("branches"), "branches");
        assert_eq!(shown("Bäume 木"), "Bäume 木");
        assert_eq!(shown(""), "");
    }

    #[test]
    fn long_text_is_cut_and_hidden_characters_are_told() {
        assert_eq!(shown(&"x".repeat(60)), "x".repeat(60));
        assert_eq!(shown(&"x".repeat(10_000)), format!("{}…", "x".repeat(60)));
        assert_eq!(shown("a\u{1b}[2Jb\nc"), "a\\u{1b}[2Jb\\u{a}c");
        assert_eq!(shown("gnp\u{202e}.exe"), "gnp\\u{202e}.exe");
    }
}
