//! Names of species: what may be one, and how to make one of any text.
//!
//! A name becomes part of file names and is printed, so it is a name and never a path.

use super::Species;
use crate::param::is_hidden;

/// Most characters of a name.
pub const MAX_NAME_CHARS: usize = 100;
/// Most bytes of a name: file systems allow 255 for a name with all that is appended to it.
pub const MAX_NAME_BYTES: usize = 200;

/// Why a text cannot be the name of a species. The message is the rest of a sentence that begins with the name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NameError {
    /// It has no characters.
    #[error("is empty; a name has 1 to {MAX_NAME_CHARS} characters")]
    Empty,
    /// It has more than [`MAX_NAME_CHARS`] characters or [`MAX_NAME_BYTES`] bytes.
    #[error("is too long: a name has at most {MAX_NAME_CHARS} characters ({MAX_NAME_BYTES} bytes)")]
    TooLong,
    /// It is `.` or `..`.
    #[error("is a folder, expected a name such as `my_tree`")]
    Folder,
    /// It has a separator of paths.
    #[error("contains `{separator}`, expected a name such as `my_tree` and not a path")]
    Path {
        /// A slash or a backslash.
        separator: char,
    },
    /// It has a control character or another that is not shown.
    #[error("contains the character {}, which a name must not", .character.escape_unicode())]
    Hidden {
        /// The first such character.
        character: char,
    },
}

/// Checks that `name` can be the name of a species.
///
/// # Errors
/// See [`NameError`].
pub fn check_name(name: &str) -> Result<(), NameError> {
    if name.is_empty() {
        return Err(NameError::Empty);
    }
    if name.chars().count() > MAX_NAME_CHARS || name.len() > MAX_NAME_BYTES {
        return Err(NameError::TooLong);
    }
    if name == "." || name == ".." {
        return Err(NameError::Folder);
    }
    match name.chars().find(|&c| !is_fit_for_names(c)) {
        None => Ok(()),
        Some(separator @ ('/' | '\\')) => Err(NameError::Path { separator }),
        Some(character) => Err(NameError::Hidden { character }),
    }
}

/// A name that [`check_name`] accepts, made of any text: `_` for each character that may not be in
/// one, cut where it is too long; text that is a name already is kept.
#[must_use]
pub fn safe_name(text: &str) -> String {
    let mut name = String::new();
    for c in text.chars().take(MAX_NAME_CHARS) {
        let c = if is_fit_for_names(c) { c } else { '_' };
        if name.len() + c.len_utf8() > MAX_NAME_BYTES {
            break;
        }
        name.push(c);
    }
    match name.as_str() {
        "" => "unnamed".to_owned(),
        "." | ".." => "_".repeat(name.len()),
        _ => name,
    }
}

fn is_fit_for_names(c: char) -> bool {
    !matches!(c, '/' | '\\') && !is_hidden(c)
}

impl Species {
    /// The species' name as part of a file name, whatever it was set to: see [`safe_name`].
    #[must_use]
    pub fn file_stem(&self) -> String {
        safe_name(&self.name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BAD: [&str; 12] = [
        "",
        ".",
        "..",
        "../../escaped",
        "/abs",
        "a\\b",
        "a\0b",
        "two\nlines",
        "\u{1b}[31mred",
        "gnp\u{202e}.exe",
        "zero\u{200b}width",
        "c1\u{85}",
    ];

    #[test]
    fn paths_and_hidden_characters_are_refused() {
        for name in BAD {
            assert!(check_name(name).is_err(), "{name:?}");
        }
        assert_eq!(check_name(""), Err(NameError::Empty));
        assert_eq!(check_name("a/b"), Err(NameError::Path { separator: '/' }));
        assert_eq!(check_name("two\nlines"), Err(NameError::Hidden { character: '\n' }));
        for long in ["x".repeat(101), "木".repeat(70)] {
            assert_eq!(check_name(&long), Err(NameError::TooLong));
        }
        for name in ["acer", "Quaking Aspen", "Bäumchen", "木", "v1.2", "..x", "-x", &"x".repeat(100)] {
            assert_eq!(check_name(name), Ok(()), "{name:?}");
        }
    }

    #[test]
    fn any_text_becomes_a_name_and_names_stay() {
        let long = ["x".repeat(1000), "木".repeat(1000)];
        for text in BAD.into_iter().chain(long.iter().map(String::as_str)) {
            let name = safe_name(text);
            assert_eq!(check_name(&name), Ok(()), "{text:?} became {name:?}");
            assert_eq!(safe_name(&name), name);
        }
        assert_eq!(safe_name("../../escaped"), ".._.._escaped");
        assert_eq!(safe_name("Quaking Aspen"), "Quaking Aspen");
    }
}
