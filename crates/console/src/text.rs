//! Text from outside: names and contents of files. A terminal obeys some characters and a spreadsheet runs some
//! cells; this module's output is safe for both.

use std::borrow::Cow;
use std::fmt::{self, Write as _};
use std::path::Path;

/// Whether a terminal may obey `c`: control characters, line ends among them, and marks that change the
/// writing direction or are not seen.
pub(crate) fn is_hidden(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}')
}

/// `text` on one line, with unprintable characters escaped as in `\u{1b}`.
#[must_use]
pub fn shown(text: &str) -> Cow<'_, str> {
    escaped(text, is_hidden)
}

/// A path for messages, on one line.
#[must_use]
pub fn path(path: &Path) -> Shown<'_> {
    Shown(path)
}

/// A path that displays like [`shown`].
#[derive(Clone, Copy, Debug)]
pub struct Shown<'a>(&'a Path);

impl fmt::Display for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&shown(&self.0.to_string_lossy()))
    }
}

/// `text` of several lines for a terminal: like [`shown`], but line ends and tabs stay.
pub(crate) fn lines(text: &str) -> Cow<'_, str> {
    escaped(text, |c| is_hidden(c) && !matches!(c, '\n' | '\t'))
}

fn escaped(text: &str, is_escaped: impl Fn(char) -> bool) -> Cow<'_, str> {
    if !text.contains(&is_escaped) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len() + 8);
    for c in text.chars() {
        if is_escaped(c) {
            // Writing to a string cannot fail.
            let _ = write!(shown, "{}", c.escape_unicode());
        } else {
            shown.push(c);
        }
    }
    Cow::Owned(shown)
}

/// JSON text with unprintable characters, which occur only in strings, escaped.
pub(crate) fn json(text: &str) -> String {
    let mut json = String::with_capacity(text.len() + 8);
    for c in text.chars() {
        if is_hidden(c) {
            // A surrogate pair where one unit of UTF-16 is not enough.
            for unit in c.encode_utf16(&mut [0; 2]) {
                let _ = write!(json, "\\u{unit:04x}");
            }
        } else {
            json.push(c);
        }
    }
    json
}

/// The mark before a cell that a spreadsheet would run or a terminal obey.
const QUOTE: char = '\'';

/// `text` as the cell of a table. Text that begins with `=`, `+`, `-` or `@`, which spreadsheets take for a
/// formula, gets an apostrophe before it, as spreadsheets themselves write it. So does text with unprintable
/// characters, which are escaped as in `\u{a}`, and backslashes with them.
/// For names and sentences; numbers are written as they are. [`from_cell`] reads it back.
#[must_use]
pub fn cell(text: &str) -> Cow<'_, str> {
    let is_formula = text.starts_with(['=', '+', '-', '@']);
    if is_formula || text.contains(is_hidden) || (text.starts_with(QUOTE) && unquoted(text).is_some()) {
        return Cow::Owned(quoted(text));
    }
    Cow::Borrowed(text)
}

fn quoted(text: &str) -> String {
    format!("{QUOTE}{}", escaped(text, |c| is_hidden(c) || c == '\\'))
}

/// The text that [`cell`] wrote as this cell; any other cell is the text itself.
#[must_use]
pub fn from_cell(cell: &str) -> Cow<'_, str> {
    unquoted(cell).map_or(Cow::Borrowed(cell), Cow::Owned)
}

/// The text that `cell` quotes, if it is quoted.
fn unquoted(cell: &str) -> Option<String> {
    let mut rest = cell.strip_prefix(QUOTE)?;
    let mut text = String::new();
    while let Some((before, after)) = rest.split_once("\\u{") {
        let (code, after) = after.split_once('}')?;
        text.push_str(before);
        text.push(char::from_u32(u32::from_str_radix(code, 16).ok()?)?);
        rest = after;
    }
    text.push_str(rest);
    let has_to_be = text.starts_with(['=', '+', '-', '@', QUOTE]) || text.contains(is_hidden);
    (has_to_be && quoted(&text) == cell).then_some(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ODD: [&str; 16] = [
        "=1+1",
        "+1",
        "-x.png",
        "@sum",
        "a\u{1b}[31mred.png",
        "two\nlines",
        "\ttab",
        "right\u{202e}left",
        "'=1",
        "''=1",
        "'tis.png",
        "\\u{41}",
        "=\\u{41}\\",
        "'\\u{a}",
        "'",
        "",
    ];

    #[test]
    fn a_cell_is_never_run_and_is_read_back() {
        for text in ODD.iter().copied().chain(["plain.png", "a=b", "it's.png", "Süß\\x.png"]) {
            let cell = cell(text);
            assert!(!cell.starts_with(['=', '+', '-', '@', '\t', '\r']), "{text:?} as {cell:?}");
            assert!(!cell.contains(is_hidden), "{text:?} as {cell:?}");
            assert_eq!(from_cell(&cell), text, "as {cell:?}");
        }
        assert_eq!(cell("=HYPERLINK(1)"), "'=HYPERLINK(1)");
        assert_eq!(cell("two\nlines"), "'two\\u{a}lines");
        // Cells that need no mark have none, and cells of others are not changed.
        for text in ["plain.png", "'tis.png", "a=b", "\\u{41}"] {
            assert_eq!((cell(text), from_cell(text)), (text.into(), text.into()));
        }
    }

    #[test]
    fn what_terminals_obey_is_escaped() {
        assert_eq!(shown("a\u{1b}[2Jb\nc\u{202e}d\u{9b}"), "a\\u{1b}[2Jb\\u{a}c\\u{202e}d\\u{9b}");
        assert_eq!(path(Path::new("a\r.png")).to_string(), "a\\u{d}.png");
        assert_eq!(lines("a\u{1b}\n\tb"), "a\\u{1b}\n\tb");
        assert_eq!(json("[\"a\u{7f}\u{202e}\"]"), r#"["a\u007f\u202e"]"#);
        assert_eq!(shown("Süßkirsche 🌸"), "Süßkirsche 🌸");
    }
}
