//! Names of species: what may be one, and how to make one of any text.
//!
//! A name becomes part of file names and is printed, so it is a name and never a path.

use super::Species;
use crate::param::is_hidden;

/// Most characters of a name.
pub const MAX_NAME_CHARS: usize = 100;
/// Most bytes of a name: file systems allow 255 for a name with all that is appended to it.
pub const MAX_NAME_BYTES: usize = 200;

/// Checks that `name` can be the name of a species.
///
/// # Errors
/// What is wrong, as the rest of a sentence that begins with the name.
pub fn check_name(name: &str) -> Result<(), String> {
    if name.is_empty() {
        return Err("is empty; a name has 1 to 100 characters".to_owned());
    }
    if name.chars().count() > MAX_NAME_CHARS || name.len() > MAX_NAME_BYTES {
        return Err(format!(
            "is too long: a name has at most {MAX_NAME_CHARS} characters ({MAX_NAME_BYTES} bytes)"
        ));
    }
    if name == "." || name == ".." {
        return Err("is a folder, expected a name such as `my_tree`".to_owned());
    }
    match name.chars().find(|&c| !is_fit_for_names(c)) {
        None => Ok(()),
        Some(c) if matches!(c, '/' | '\\') => {
            Err(format!("contains `{c}`, expected a name such as `my_tree` and not a path"))
        }
        Some(c) => Err(format!("contains the character {}, which a name must not", c.escape_unicode())),
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
        assert!(check_name(&"x".repeat(101)).is_err() && check_name(&"木".repeat(70)).is_err());
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
