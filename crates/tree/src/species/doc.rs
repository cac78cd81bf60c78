//! A parsed species file that remembers where everything stood.

use super::error::{Issue, SpeciesError};
use super::key::{Form, KEYS, Key, MAX_SEED};
use super::name::check_name;
use crate::param::{Kind, ParamSpace, Problem, escaped, is_hidden, nearest};
use std::ops::Range;
use toml::de::{DeTable, DeValue};

/// Names that are wrong at the top level, and what would be right.
const MISPLACED: [(&str, &str); 4] = [
    ("seed", "the seed of the tree is `tree_seed`"),
    ("height", "the height of the tree is `g_scale`"),
    ("leaves", "the number of leaves on a stem is `leaf_blos_num`"),
    ("species", "the species is called by `name`"),
];

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
            Err(error) => {
                Err(SpeciesError { issues: vec![doc.syntax(error.span().unwrap_or(0..0), error.message())] })
            }
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
        Issue { origin: self.origin.clone(), line, column, parameter: parameter.to_owned(), problem }
    }

    /// The string under a top-level key, if it is there.
    ///
    /// # Errors
    /// If it is there and no string.
    pub fn text(&self, key: &str) -> Result<Option<&str>, Issue> {
        self.get(key).map(|node| self.text_of(key, node)).transpose()
    }

    /// The name of the species, if the file says one.
    ///
    /// # Errors
    /// If it is no string, or cannot be a name: see [`check_name`].
    pub fn name(&self) -> Result<Option<&str>, Issue> {
        let Some(node) = self.get("name") else { return Ok(None) };
        let name = self.text_of("name", node)?;
        check_name(name)
            .map_err(|message| self.issue(node.span.clone(), "name", Problem::Conflict { message }))?;
        Ok(Some(name))
    }

    /// The description of the species, if the file has one; it may have several lines.
    ///
    /// # Errors
    /// If it is no string, or has control characters.
    pub fn description(&self) -> Result<Option<&str>, Issue> {
        let Some(node) = self.get("description") else { return Ok(None) };
        let text = self.text_of("description", node)?;
        match text.chars().find(|&c| is_hidden(c) && c != '\n') {
            None => Ok(Some(text)),
            Some(c) => {
                let message = format!("contains the character {}, expected plain text", c.escape_unicode());
                Err(self.issue(node.span.clone(), "description", Problem::Conflict { message }))
            }
        }
    }

    /// The string in `node`.
    ///
    /// # Errors
    /// If it is no string.
    pub fn text_of<'a>(&self, name: &str, node: &'a Node) -> Result<&'a str, Issue> {
        match &node.value {
            Value::Text(text) => Ok(text),
            other => Err(self.wrong_type(name, node, "a string", other)),
        }
    }

    /// The number in `node`.
    ///
    /// # Errors
    /// If it is no number.
    pub fn number_of(&self, name: &str, node: &Node) -> Result<f64, Issue> {
        match &node.value {
            Value::Number(number) => Ok(*number),
            other => Err(self.wrong_type(name, node, "a number", other)),
        }
    }

    /// Three finite numbers in `node`, such as a position in metres.
    ///
    /// # Errors
    /// If it is no array of three finite numbers.
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

    fn wrong_type(&self, name: &str, node: &Node, expected: &'static str, found: &Value) -> Issue {
        self.issue(node.span.clone(), name, Problem::WrongType { expected, found: found.type_name() })
    }

    /// The seed under `tree_seed`, if it is there.
    ///
    /// # Errors
    /// If it is there and no whole number from 0 on.
    pub fn tree_seed(&self) -> Result<Option<u64>, Issue> {
        let Some(node) = self.get("tree_seed") else { return Ok(None) };
        let seed = self.number_of("tree_seed", node)?;
        let max = MAX_SEED as f64;
        if (0.0..=max).contains(&seed) && seed.fract() == 0.0 {
            Ok(Some(seed as u64))
        } else {
            Err(self.issue(
                node.span.clone(),
                "tree_seed",
                Problem::OutOfRange { value: seed, min: 0.0, max },
            ))
        }
    }

    /// Reads every parameter of `space`; `own_keys` are the generator's own
    /// ([`Family::keys`](crate::Family::keys)).
    ///
    /// Returns one value a slot (the default where the file is silent or wrong) and every issue, in
    /// order of place: unknown names, wrong types and lengths, values that are not allowed.
    #[must_use]
    pub fn read(&self, space: &ParamSpace, own_keys: &[Key]) -> (Vec<f64>, Vec<Issue>) {
        let mut values = space.defaults();
        let mut issues = Vec::new();
        for entry in &self.entries {
            let key = entry.key.as_str();
            let keys = || KEYS.iter().chain(own_keys);
            if keys().any(|known| known.name == key) {
                continue;
            }
            let Some((number, param)) = space.find(key) else {
                let known = space.params().iter().map(|p| p.name.as_ref());
                let problem = match MISPLACED.iter().find(|(name, _)| *name == key) {
                    Some((_, right)) => Problem::Misplaced { right },
                    None => Problem::UnknownName {
                        nearest: inside_a_table(key, keys())
                            .or_else(|| nearest(key, known.chain(keys().map(|known| known.name)))),
                    },
                };
                issues.push(self.issue(entry.span.clone(), key, problem));
                continue;
            };
            let nodes: &[Node] = match &entry.node.value {
                Value::List(list) => list,
                _ => std::slice::from_ref(&entry.node),
            };
            let slots = space.slots_of(number);
            let is_list = matches!(entry.node.value, Value::List(_));
            if nodes.len() != slots.len() || is_list != (param.layout.len() > 1) {
                let problem = if is_list == (param.layout.len() > 1) || nodes.len() != slots.len() {
                    Problem::WrongLength { expected: slots.len(), found: nodes.len() }
                } else {
                    Problem::WrongType { expected: "a single number", found: "an array".to_owned() }
                };
                issues.push(self.issue(entry.node.span.clone(), key, problem));
                continue;
            }
            for (slot, node) in slots.zip(nodes) {
                match self.slot_value(space, slot, node) {
                    Ok(value) => values[slot] = value,
                    Err(issue) => issues.push(issue),
                }
            }
        }
        issues.sort_by_key(|issue| (issue.line, issue.column));
        (values, issues)
    }

    fn slot_value(&self, space: &ParamSpace, slot: usize, node: &Node) -> Result<f64, Issue> {
        let name = space.slot_name(slot);
        let value = match (&node.value, space.kind_of(slot)) {
            (Value::Text(text), Kind::Choice { first, names }) => {
                names.iter().position(|n| n == text).map(|i| (first + i as i64) as f64).ok_or_else(|| {
                    let problem = Problem::UnknownChoice {
                        value: text.clone(),
                        known: names.iter().map(|&n| n.to_owned()).collect(),
                        nearest: nearest(text, names.iter().copied()),
                    };
                    self.issue(node.span.clone(), &name, problem)
                })?
            }
            _ => self.number_of(&name, node)?,
        };
        space.check_slot(slot, value).map_err(|problem| self.issue(node.span.clone(), &name, problem))?;
        Ok(value)
    }
}

/// `table.key`, where `key` stands outside the table that it belongs to.
fn inside_a_table<'a>(key: &str, mut keys: impl Iterator<Item = &'a Key>) -> Option<String> {
    keys.find_map(|table| match table.form {
        Form::Table(inside) if inside.iter().any(|inner| inner.name == key) => {
            Some(format!("{}.{key}", table.name))
        }
        _ => None,
    })
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
