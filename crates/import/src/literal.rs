//! Literals of Python and of JSON: numbers, strings, lists, dictionaries. Nothing is run.

use crate::source::Source;
use pleach_tree::SpeciesError;
use pleach_tree::param::shown;
use std::ops::Range;

/// Lists and dictionaries inside each other, at most: presets have three.
const MAX_DEPTH: usize = 16;

/// A value and the bytes where it stands.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Node {
    pub(crate) value: Value,
    pub(crate) span: Range<usize>,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Value {
    Nothing,
    Flag(bool),
    Number(f64),
    Text(String),
    List(Vec<Node>),
    Dict(Vec<(Node, Node)>),
}

impl Value {
    /// What it is, with its article.
    pub(crate) const fn type_name(&self) -> &'static str {
        match self {
            Self::Nothing => "nothing",
            Self::Flag(_) => "true or false",
            Self::Number(_) => "a number",
            Self::Text(_) => "a string",
            Self::List(_) => "a list",
            Self::Dict(_) => "a dictionary",
        }
    }

    /// The value under `key`, where this is a dictionary that has it.
    pub(crate) fn get(&self, key: &str) -> Option<&Node> {
        let Self::Dict(entries) = self else { return None };
        // As in Python, the last of equal keys counts.
        let is_called = |name: &Node| matches!(&name.value, Self::Text(text) if text == key);
        entries.iter().rev().find(|(name, _)| is_called(name)).map(|(_, node)| node)
    }
}

/// `text` after white space, a byte-order mark, comments and strings in three quotes.
pub(crate) fn after_comments(text: &str) -> &str {
    let mut rest = text.trim_start_matches('\u{feff}').trim_start();
    loop {
        if rest.starts_with('#') {
            rest = rest.split_once('\n').map_or("", |(_, rest)| rest);
        } else if let Some(quotes) = ["\"\"\"", "'''"].into_iter().find(|quotes| rest.starts_with(quotes)) {
            let Some((_, after)) = rest[3..].split_once(quotes) else { return rest };
            rest = after;
        } else {
            return rest;
        }
        rest = rest.trim_start();
    }
}

/// The name and the text behind it, where `text` begins with `name =`.
pub(crate) fn after_assignment(text: &str) -> Option<(&str, &str)> {
    let (name, value) = text.split_once('=')?;
    let name = name.trim_end();
    let is_name = !name.is_empty() && name.chars().all(|c| c.is_alphanumeric() || c == '_');
    is_name.then(|| (name, value.trim_start()))
}

/// Reads the one literal of a file, after `name =` or alone.
pub(crate) fn parse(source: &Source<'_>) -> Result<Node, SpeciesError> {
    let start = after_comments(source.text);
    let start = after_assignment(start).map_or(start, |(_, value)| value);
    let mut parser = Parser { source, at: source.text.len() - start.len() };
    let node = parser.value(0)?;
    parser.skip();
    if parser.at < source.text.len() {
        return Err(parser.unexpected("the end of the file after the preset"));
    }
    Ok(node)
}

/// The entries of a dictionary, or an error that says what is there instead.
pub(crate) fn entries<'a>(source: &Source<'_>, node: &'a Node) -> Result<&'a [(Node, Node)], SpeciesError> {
    match &node.value {
        Value::Dict(entries) => Ok(entries),
        other => Err(source.wrong(
            node.span.clone(),
            &format!("{} is here, expected a dictionary of parameters", other.type_name()),
        )),
    }
}

struct Parser<'a> {
    source: &'a Source<'a>,
    at: usize,
}

impl<'a> Parser<'a> {
    fn rest(&self) -> &'a str {
        &self.source.text[self.at..]
    }

    fn next(&self) -> Option<char> {
        self.rest().chars().next()
    }

    /// Skips white space and comments.
    fn skip(&mut self) {
        loop {
            let rest = self.rest().trim_start();
            self.at = self.source.text.len() - rest.len();
            if !rest.starts_with('#') {
                return;
            }
            self.at += rest.find('\n').unwrap_or(rest.len());
        }
    }

    fn take(&mut self, c: char) -> bool {
        self.skip();
        let found = self.next() == Some(c);
        if found {
            self.at += c.len_utf8();
        }
        found
    }

    /// The word at this place: letters, digits, underscores and dots.
    fn word(&self) -> &'a str {
        let rest = self.rest();
        let end = rest.find(|c: char| !(c.is_alphanumeric() || matches!(c, '_' | '.'))).unwrap_or(rest.len());
        &rest[..end]
    }

    fn unexpected(&self, expected: &str) -> SpeciesError {
        let Some(found) = self.next() else {
            let end = self.at..self.at;
            return self.source.wrong(end, &format!("the file ends here, expected {expected}"));
        };
        let word = self.word();
        let name = if word.is_empty() { found.to_string() } else { word.to_owned() };
        let span = self.at..self.at + name.len();
        let is_name = word.starts_with(|c: char| c.is_alphabetic() || c == '_');
        let why = if is_name { "; presets are read as literals, and code in them is not run" } else { "" };
        self.source.wrong(span, &format!("`{}` is here, expected {expected}{why}", shown(&name)))
    }

    fn value(&mut self, depth: usize) -> Result<Node, SpeciesError> {
        self.skip();
        let start = self.at;
        let value = match self.next() {
            Some('{' | '[' | '(') if depth == MAX_DEPTH => {
                let message = format!("lists are nested here more than {MAX_DEPTH} deep, which no preset is");
                return Err(self.source.wrong(start..start + 1, &message));
            }
            Some('{') => self.dict(depth)?,
            Some('[') => self.list(']', depth)?,
            Some('(') => self.list(')', depth)?,
            Some(quote @ ('"' | '\'')) => self.text(quote)?,
            Some(c) if c.is_ascii_digit() || matches!(c, '-' | '+' | '.') => self.number()?,
            _ => {
                let (value, length) = match self.word() {
                    "None" | "null" => (Value::Nothing, 4),
                    "True" | "true" => (Value::Flag(true), 4),
                    "False" | "false" => (Value::Flag(false), 5),
                    _ => return Err(self.unexpected("a number, a string, a list or a dictionary")),
                };
                self.at += length;
                value
            }
        };
        Ok(Node { value, span: start..self.at })
    }

    fn dict(&mut self, depth: usize) -> Result<Value, SpeciesError> {
        self.at += 1;
        let mut entries = Vec::new();
        while !self.take('}') {
            let key = self.value(depth + 1)?;
            if !matches!(key.value, Value::Text(_) | Value::Number(_)) {
                let message = format!("{} is here, expected a name in quotes", key.value.type_name());
                return Err(self.source.wrong(key.span, &message));
            }
            if !self.take(':') {
                return Err(self.unexpected("`:` after a name"));
            }
            entries.push((key, self.value(depth + 1)?));
            if !self.take(',') && self.next() != Some('}') {
                return Err(self.unexpected("`,` or `}`"));
            }
        }
        Ok(Value::Dict(entries))
    }

    /// A list or a tuple; a value in parentheses alone is that value.
    fn list(&mut self, close: char, depth: usize) -> Result<Value, SpeciesError> {
        self.at += 1;
        let (mut values, mut commas) = (Vec::new(), 0);
        while !self.take(close) {
            values.push(self.value(depth + 1)?);
            if self.take(',') {
                commas += 1;
            } else if self.next() != Some(close) {
                return Err(self.unexpected(&format!("`,` or `{close}`")));
            }
        }
        match values.pop() {
            Some(only) if close == ')' && values.is_empty() && commas == 0 => Ok(only.value),
            last => {
                values.extend(last);
                Ok(Value::List(values))
            }
        }
    }

    fn text(&mut self, quote: char) -> Result<Value, SpeciesError> {
        let start = self.at;
        let mut text = String::new();
        let mut chars = self.source.text[start + 1..].char_indices();
        while let Some((at, c)) = chars.next() {
            match c {
                '\n' => break,
                '\\' => match chars.next() {
                    Some((_, 'n')) => text.push('\n'),
                    Some((_, 't')) => text.push('\t'),
                    Some((_, other @ ('\\' | '/' | '\'' | '"'))) => text.push(other),
                    Some((escape, _)) => {
                        let at = start + escape;
                        let message = "an escape is here that names and words of presets do not have";
                        return Err(self.source.wrong(at..at + 1, message));
                    }
                    None => break,
                },
                c if c == quote => {
                    self.at = start + 1 + at + c.len_utf8();
                    return Ok(Value::Text(text));
                }
                c => text.push(c),
            }
        }
        Err(self.source.wrong(start..start + 1, "a string begins here and does not end on its line"))
    }

    fn number(&mut self) -> Result<Value, SpeciesError> {
        let rest = self.rest();
        let mut end = 0;
        let mut before = ' ';
        for c in rest.chars() {
            let is_sign = matches!(c, '-' | '+') && (end == 0 || matches!(before, 'e' | 'E'));
            if !(is_sign || c.is_alphanumeric() || matches!(c, '.' | '_')) {
                break;
            }
            (end, before) = (end + c.len_utf8(), c);
        }
        let word = &rest[..end];
        let plain = word.trim_start_matches('+').replace('_', "");
        let is_plain = plain.chars().all(|c| c.is_ascii_digit() || matches!(c, '-' | '+' | '.' | 'e' | 'E'));
        let number = plain.parse::<f64>().ok().filter(|number| is_plain && number.is_finite());
        let Some(number) = number else {
            let message = format!("`{}` is not a number", shown(word));
            return Err(self.source.wrong(self.at..self.at + end.max(1), &message));
        };
        self.at += end;
        Ok(Value::Number(number))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Value, String> {
        let source = Source { origin: "it", text };
        parse(&source).map(|node| node.value).map_err(|error| error.to_string())
    }

    fn number(value: f64, span: Range<usize>) -> Node {
        Node { value: Value::Number(value), span }
    }

    #[test]
    fn literals_of_both_languages_are_read() {
        assert_eq!(read("-1.5e-3"), Ok(Value::Number(-0.0015)));
        assert_eq!(read("+.5"), Ok(Value::Number(0.5)));
        assert_eq!(read("5."), Ok(Value::Number(5.0)));
        assert_eq!(read("True"), Ok(Value::Flag(true)));
        assert_eq!(read("null"), Ok(Value::Nothing));
        assert_eq!(read(r"'it\'s'"), Ok(Value::Text("it's".to_owned())));
        assert_eq!(read("(1, 2,)"), Ok(Value::List(vec![number(1.0, 1..2), number(2.0, 4..5)])));
        assert_eq!(read("(1,)"), Ok(Value::List(vec![number(1.0, 1..2)])));
        assert_eq!(read("((1))"), Ok(Value::Number(1.0)));
        assert_eq!(read("[]"), Ok(Value::List(Vec::new())));
        let dict = read("# one\n'''two'''\nparams = {\n 'a': 1, # three\n \"b\": [2]\n}\n").unwrap();
        assert_eq!(dict.get("a").unwrap().value, Value::Number(1.0));
        assert!(matches!(dict.get("b").unwrap().value, Value::List(_)) && dict.get("c").is_none());
        assert_eq!(read("{'a': 1, 'a': 2}").unwrap().get("a").unwrap().value, Value::Number(2.0));
    }

    #[test]
    fn what_is_not_a_literal_has_a_place() {
        let told = |text: &str| read(text).unwrap_err();
        assert!(
            told("{'a': __import__('os')}").starts_with("it:1:7: `__import__` is here, expected a number")
        );
        assert!(told("{'a': __import__('os')}").contains("code in them is not run"));
        assert!(told("import os\n").starts_with("it:1:1: `import` is here"));
        assert!(
            told("x = {'a': 1}\nos.remove('b')").starts_with("it:2:1: `os.remove` is here, expected the end")
        );
        assert!(told("{'a': 2 * 3}").starts_with("it:1:9: `*` is here, expected `,` or `}`"));
        assert!(told("{'a': 1e999}").starts_with("it:1:7: `1e999` is not a number"));
        assert!(told("{'a': 1j}").contains("`1j` is not a number"));
        assert!(told("{'a': 'b\n'}").starts_with("it:1:7: a string begins here"));
        assert!(told("{'a': [1, 2").starts_with("it:1:12: the file ends here, expected `,` or `]`"));
        assert!(told("{[1]: 2}").starts_with("it:1:2: a list is here, expected a name in quotes"));
        assert!(told("{'a' 2}").contains("expected `:` after a name"));
        assert!(told("").contains("the file ends here"));
        assert!(told(&"[".repeat(100_000)).starts_with("it:1:17: lists are nested here more than 16 deep"));
        assert!(told("{'ä': é}").starts_with("it:1:7: `é`"));
    }
}
