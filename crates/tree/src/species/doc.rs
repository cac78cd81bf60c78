//! A parsed species file that remembers where everything stood.

use super::error::{Issue, SpeciesError};
use super::quoted;
use crate::param::{Problem, escaped};
use std::ops::Range;
use toml::de::{DeTable, DeValue};

/// A value and the bytes of the file that it came from.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Bytes in the file.
    pub span: Range<usize>,
    /// The value.
    pub value: Value,
}

/// What a node holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// An integer or a float.
    Number(f64),
    /// A string.
    Text(String),
    /// `true` or `false`.
    Switch(bool),
    /// An array.
    List(Vec<Node>),
    /// A table.
    Table(Vec<Entry>),
    /// Something that no species file needs, by its type's name.
    Other(&'static str),
}

impl Value {
    /// The type's name with its article, for messages.
    #[must_use]
    pub fn type_name(&self) -> String {
        match self {
            Self::Number(_) => "a number".to_owned(),
            Self::Text(_) => "a string".to_owned(),
            Self::Switch(_) => "a boolean".to_owned(),
            Self::List(_) => "an array".to_owned(),
            Self::Table(_) => "a table".to_owned(),
            Self::Other(name) => format!("a {name}"),
        }
    }
}

/// A key and its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The key.
    pub key: String,
    /// Bytes of the key in the file.
    pub span: Range<usize>,
    /// The value.
    pub node: Node,
}

/// A species file after parsing and before any generator has read it.
#[derive(Clone, Debug, PartialEq)]
pub struct SpeciesDoc {
    origin: String,
    line_starts: Vec<usize>,
    text: String,
    entries: Vec<Entry>,
}

impl SpeciesDoc {
    /// Parses `text`; `origin` (a file name) is for messages.
    ///
    /// # Errors
    /// What the TOML parser objects to, with line and column.
    pub fn parse(origin: &str, text: &str) -> Result<Self, SpeciesError> {
        let line_starts = std::iter::once(0).chain(text.match_indices('\n').map(|(i, _)| i + 1)).collect();
        let mut doc =
            Self { origin: origin.to_owned(), line_starts, text: text.to_owned(), entries: Vec::new() };
        match DeTable::parse(text) {
            Ok(table) => {
                doc.entries = entries(table.get_ref());
                Ok(doc)
            }
            Err(error) => Err(doc.wrong(vec![doc.syntax(error.span().unwrap_or(0..0), error.message())])),
        }
    }

    /// What the parser says, on one line that is not too long.
    fn syntax(&self, span: Range<usize>, message: &str) -> Issue {
        /// Most characters of what the parser says; it quotes keys of any length.
        const MAX_CHARS: usize = 200;
        let mut short = escaped(&message.trim().replace('\n', "; "), MAX_CHARS);
        if message.trim().chars().nth(MAX_CHARS).is_some() {
            short.push('…');
        }
        self.issue(span, "", Problem::Syntax { message: short })
    }

    /// Where the file came from.
    #[must_use]
    pub fn origin(&self) -> &str {
        &self.origin
    }

    /// All top-level keys with their values, in the order in which the parser gives them.
    pub(super) fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// The value of a top-level key.
    #[must_use]
    pub fn get(&self, key: &str) -> Option<&Node> {
        self.entries.iter().find(|e| e.key == key).map(|e| &e.node)
    }

    /// A problem at `span`.
    #[must_use]
    pub fn issue(&self, span: Range<usize>, parameter: &str, problem: Problem) -> Issue {
        let at = span.start.min(self.text.len());
        let line = self.line_starts.partition_point(|&start| start <= at);
        let column = self.text[self.line_starts[line - 1]..at].chars().count() + 1;
        Issue {
            origin: self.origin.clone(),
            line,
            column,
            span,
            parameter: parameter.to_owned(),
            problem,
            help: None,
        }
    }

    /// The file with these problems, at least one.
    #[must_use]
    pub fn wrong(&self, issues: Vec<Issue>) -> SpeciesError {
        SpeciesError::new(&self.text, issues)
    }

    /// The bytes of the file that these bytes of the string in `node` came from; all of `node` if it is
    /// not a string.
    #[must_use]
    pub fn span_within(&self, node: &Node, inside: Range<usize>) -> Range<usize> {
        let (Value::Text(text), Some(raw)) = (&node.value, self.text.get(node.span.clone())) else {
            return node.span.clone();
        };
        let at = |byte| node.span.start + quoted::place(raw, text, byte);
        at(inside.start)..at(inside.end.max(inside.start))
    }

    /// The string under a top-level key, if it is there.
    ///
    /// # Errors
    /// If it is there and no string.
    pub fn text(&self, key: &str) -> Result<Option<&str>, Issue> {
        self.get(key).map(|node| self.text_of(key, node)).transpose()
    }

    /// The string in `node`.
    ///
    /// # Errors
    /// If it is not a string.
    pub fn text_of<'a>(&self, name: &str, node: &'a Node) -> Result<&'a str, Issue> {
        match &node.value {
            Value::Text(text) => Ok(text),
            other => Err(self.wrong_type(name, node, "a string", other)),
        }
    }

    /// The number in `node`.
    ///
    /// # Errors
    /// If it is not a number.
    pub fn number_of(&self, name: &str, node: &Node) -> Result<f64, Issue> {
        match &node.value {
            Value::Number(number) => Ok(*number),
            other => Err(self.wrong_type(name, node, "a number", other)),
        }
    }

    /// The number in `node`, which has to lie in `min..=max`.
    ///
    /// # Errors
    /// If it is not a number, or lies outside.
    pub fn number_within(&self, name: &str, node: &Node, min: f64, max: f64) -> Result<f64, Issue> {
        let value = self.number_of(name, node)?;
        if (min..=max).contains(&value) {
            return Ok(value);
        }
        Err(self.issue(node.span.clone(), name, Problem::OutOfRange { value, min, max }))
    }

    /// The seed of draws in `node`: a whole number below 2³².
    ///
    /// # Errors
    /// If it is none.
    pub fn small_seed(&self, name: &str, node: &Node) -> Result<u32, Issue> {
        let seed = self.number_within(name, node, 0.0, f64::from(u32::MAX))?;
        if seed.fract() == 0.0 {
            return Ok(seed as u32);
        }
        let message = "has a seed with a fraction, expected a whole number".to_owned();
        Err(self.issue(node.span.clone(), name, Problem::Conflict { message }))
    }

    /// Three finite numbers in `node`, such as a position in metres.
    ///
    /// # Errors
    /// If it is not an array of three finite numbers.
    pub fn vector_of(&self, name: &str, node: &Node) -> Result<[f64; 3], Issue> {
        let Value::List(list) = &node.value else {
            return Err(self.wrong_type(name, node, "an array of 3 numbers", &node.value));
        };
        if list.len() != 3 {
            let problem = Problem::WrongLength { expected: 3, found: list.len() };
            return Err(self.issue(node.span.clone(), name, problem));
        }
        let mut vector = [0.0; 3];
        for (value, item) in vector.iter_mut().zip(list) {
            *value = self.number_of(name, item)?;
            if !value.is_finite() {
                return Err(self.issue(item.span.clone(), name, Problem::NotFinite { value: *value }));
            }
        }
        Ok(vector)
    }

    pub(crate) fn wrong_type(&self, name: &str, node: &Node, expected: &'static str, found: &Value) -> Issue {
        self.issue(node.span.clone(), name, Problem::WrongType { expected, found: found.type_name() })
    }
}

fn entries(table: &DeTable<'_>) -> Vec<Entry> {
    table
        .iter()
        .map(|(key, value)| Entry {
            key: key.get_ref().to_string(),
            span: key.span(),
            node: Node { span: value.span(), value: convert(value.get_ref()) },
        })
        .collect()
}

fn convert(value: &DeValue<'_>) -> Value {
    match value {
        DeValue::String(text) => Value::Text(text.to_string()),
        DeValue::Integer(integer) => {
            let digits = integer.as_str().replace('_', "");
            // Beyond 64 bits only the size matters, for the message that it is out of range.
            i64::from_str_radix(&digits, integer.radix())
                .map(|i| i as f64)
                .or_else(|_| digits.parse::<f64>())
                .map_or(Value::Other("number that cannot be read"), Value::Number)
        }
        DeValue::Float(float) => float
            .as_str()
            .replace('_', "")
            .parse()
            .map_or(Value::Other("number that cannot be read"), Value::Number),
        DeValue::Array(array) => {
            Value::List(array.iter().map(|v| Node { span: v.span(), value: convert(v.get_ref()) }).collect())
        }
        DeValue::Table(table) => Value::Table(entries(table)),
        DeValue::Boolean(value) => Value::Switch(*value),
        DeValue::Datetime(_) => Value::Other("date"),
    }
}
