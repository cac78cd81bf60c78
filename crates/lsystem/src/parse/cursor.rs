//! A place in the text of one statement, and what can be read there.

use crate::diagnostic::{Diagnostic, Fault};
use crate::syntax::{Name, Span};

pub(super) type Parsed<T> = Result<T, Box<Diagnostic>>;

/// Most layers of brackets, parentheses and signs in front.
pub(super) const MAX_DEPTH: usize = 64;

/// A place in a statement.
pub(super) struct Cursor<'a> {
    text: &'a str,
    pub(super) at: usize,
    end: usize,
    pub(super) depth: usize,
    /// Parts of the expression that is being read.
    pub(super) nodes: usize,
    /// Names of modules with several letters, longest first.
    pub(super) modules: &'a [String],
}

impl<'a> Cursor<'a> {
    pub(super) const fn new(text: &'a str, span: Span, modules: &'a [String]) -> Self {
        Self { text, at: span.start, end: span.end, depth: 0, nodes: 0, modules }
    }

    pub(super) fn rest(&self) -> &'a str {
        &self.text[self.at..self.end]
    }

    /// The next character; signs that PDF files have in place of ASCII's are read as these.
    pub(super) fn peek(&self) -> Option<char> {
        self.rest().chars().next().map(|c| match c {
            '\u{2212}' | '\u{2013}' => '-',
            '\u{2227}' => '^',
            c => c,
        })
    }

    pub(super) fn bump(&mut self) {
        self.at += self.rest().chars().next().map_or(0, char::len_utf8);
    }

    /// Skips white space and comments.
    pub(super) fn skip(&mut self) {
        while let Some(c) = self.peek() {
            if c == '#' {
                self.at += self.rest().find('\n').unwrap_or(self.end - self.at);
            } else if c.is_whitespace() {
                self.bump();
            } else {
                break;
            }
        }
    }

    /// Takes `sign` after white space, if it is next.
    pub(super) fn take(&mut self, sign: char) -> bool {
        self.skip();
        let found = self.peek() == Some(sign);
        if found {
            self.bump();
        }
        found
    }

    pub(super) fn expect(&mut self, sign: char, expected: &'static str) -> Parsed<()> {
        if self.take(sign) { Ok(()) } else { Err(self.unexpected(expected)) }
    }

    /// Takes the word `word` after white space, if it is next and ends there.
    pub(super) fn take_word(&mut self, word: &str) -> bool {
        self.skip();
        let found = self.word() == word;
        if found {
            self.at += word.len();
        }
        found
    }

    /// The identifier that stands here, empty if none.
    pub(super) fn word(&self) -> &'a str {
        let rest = self.rest();
        if !rest.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_') {
            return "";
        }
        let end = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(rest.len());
        &rest[..end]
    }

    /// Reads an identifier.
    pub(super) fn name(&mut self, expected: &'static str) -> Parsed<Name> {
        self.skip();
        let word = self.word();
        if word.is_empty() {
            return Err(self.unexpected(expected));
        }
        let start = self.at;
        self.at += word.len();
        let name = Name { text: word.to_owned(), span: self.since(start) };
        if super::is_reserved(word) {
            return Err(self.fault(name.span, Fault::Reserved { name: word.to_owned() }));
        }
        Ok(name)
    }

    /// Reads a number without a sign.
    pub(super) fn number(&mut self) -> Option<f64> {
        let bytes = self.rest().as_bytes();
        let digits = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
        let mut len = digits(0);
        if bytes.get(len) == Some(&b'.') && bytes.get(len + 1).is_some_and(u8::is_ascii_digit) {
            len += 1 + digits(len + 1);
        }
        if len == 0 {
            return None;
        }
        if matches!(bytes.get(len), Some(b'e' | b'E')) {
            let sign = usize::from(matches!(bytes.get(len + 1), Some(b'+' | b'-')));
            let exponent = digits((len + 1 + sign).min(bytes.len()));
            if exponent > 0 {
                len += 1 + sign + exponent;
            }
        }
        let number = self.rest()[..len].parse().ok()?;
        self.at += len;
        Some(number)
    }

    /// Length of the arrow that stands here (`->`, `-->`, `→`), 0 if none does.
    pub(super) fn arrow(&self) -> usize {
        let rest = self.rest();
        ["->", "-->", "\u{2192}"].iter().find(|a| rest.starts_with(**a)).map_or(0, |a| a.len())
    }

    /// Whether a weighted arrow such as `-0.4->` or `-(p)->` stands here.
    pub(super) fn weighted_arrow(&self) -> bool {
        if self.peek() != Some('-') {
            return false;
        }
        let mut ahead =
            Cursor { at: self.at, ..Cursor::new(self.text, Span { start: 0, end: self.end }, &[]) };
        ahead.bump();
        if ahead.peek() == Some('(') {
            let mut open = 0_usize;
            let Some(len) = ahead.rest().find(|c| {
                open = open + usize::from(c == '(') - usize::from(c == ')');
                open == 0
            }) else {
                return false;
            };
            ahead.at += len + 1;
        } else if ahead.number().is_none() {
            return false;
        }
        ahead.arrow() > 0
    }

    pub(super) const fn since(&self, start: usize) -> Span {
        Span { start, end: self.at }
    }

    pub(super) fn fault(&self, span: Span, fault: Fault) -> Box<Diagnostic> {
        Box::new(Diagnostic::new(span, fault))
    }

    /// The fault of finding something else than `expected` here.
    pub(super) fn unexpected(&mut self, expected: &'static str) -> Box<Diagnostic> {
        self.skip();
        let start = self.at;
        let (found, len) = match (self.word(), self.rest().chars().next()) {
            (_, None) => ("the end of the statement".to_owned(), 0),
            ("", Some(c)) => (format!("`{}`", pleach_tree::param::shown(&c.to_string())), c.len_utf8()),
            (word, _) => (format!("`{}`", pleach_tree::param::shown(word)), word.len()),
        };
        self.fault(Span { start, end: start + len }, Fault::Expected { expected, found })
    }

    /// Goes one layer deeper; the caller takes 1 from `depth` again.
    pub(super) fn descend(&mut self) -> Parsed<()> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            let span = Span { start: self.at, end: (self.at + 1).min(self.end) };
            return Err(self.fault(span, Fault::TooDeep { limit: MAX_DEPTH }));
        }
        Ok(())
    }
}
