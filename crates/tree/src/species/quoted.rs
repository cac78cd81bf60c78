//! Where the characters of a TOML string stand in the file.

/// The byte of `raw`, a TOML string with its quotes, at which byte `byte` of `text` stands, which is
/// what the string says.
pub(super) fn place(raw: &str, text: &str, byte: usize) -> usize {
    let quotes = ["\"\"\"", "'''", "\"", "'"];
    let Some(quote) = quotes.into_iter().find(|quote| raw.starts_with(quote)) else { return 0 };
    let has_escapes = quote.starts_with('"');
    let mut at = quote.len();
    if quote.len() == 3 {
        // A line that begins right after the quotes is not part of the string.
        at += ["\r\n", "\n"].into_iter().find(|end| raw[at..].starts_with(end)).map_or(0, str::len);
    }
    let end = raw.len().saturating_sub(quote.len());
    let mut said = 0;
    while said < byte.min(text.len()) && at < end {
        let rest = &raw[at..end];
        let (taken, stands_for) = match rest.chars().next() {
            Some('\\') if has_escapes => escape(rest),
            Some('\r') if !text[said..].starts_with('\r') => (1, 0),
            Some(c) => (c.len_utf8(), c.len_utf8()),
            None => break,
        };
        at += taken;
        said += stands_for;
    }
    // What the string leaves out before the place does not belong to it.
    while has_escapes && raw[at..end].starts_with('\\') && escape(&raw[at..end]).1 == 0 {
        at += escape(&raw[at..end]).0;
    }
    at.min(end)
}

/// The bytes of the escape sequence at the start of `rest`, and those that it stands for.
fn escape(rest: &str) -> (usize, usize) {
    let digits = match rest.as_bytes().get(1) {
        Some(b'x') => 2,
        Some(b'u') => 4,
        Some(b'U') => 8,
        // The end of a line and all white space after it are left out.
        Some(b) if b.is_ascii_whitespace() => {
            return (rest.len() - rest[1..].trim_start().len(), 0);
        }
        _ => return (2.min(rest.len()), 1),
    };
    let code = rest.get(2..2 + digits).and_then(|digits| u32::from_str_radix(digits, 16).ok());
    (2 + digits, code.and_then(char::from_u32).map_or(1, char::len_utf8))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every character of the string has to be found where it stands.
    fn check(raw: &str, expected: &[(char, usize)]) {
        let file = format!("a = {raw}");
        let table: toml::Table = toml::from_str(&file).unwrap();
        let text = table["a"].as_str().unwrap();
        for &(c, at) in expected {
            let byte = text.find(c).unwrap();
            assert_eq!(place(raw, text, byte), at, "{c} in {raw:?}");
        }
        assert!(place(raw, text, text.len()) <= raw.len());
    }

    #[test]
    fn characters_of_strings_are_found_in_the_file() {
        check("'ab'", &[('a', 1), ('b', 2)]);
        check("'''\nab\nc'''", &[('a', 4), ('c', 7)]);
        check("'''ab'''", &[('a', 3), ('b', 4)]);
        check("'''\r\na\r\nb'''", &[('a', 5), ('b', 8)]);
        check("\"a\\tb\"", &[('a', 1), ('b', 4)]);
        check("\"\"\"\na\\\n   b\\u00e4c\"\"\"", &[('a', 4), ('b', 10), ('c', 17)]);
    }
}
