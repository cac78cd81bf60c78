//! Strings of modules in flat arrays.

use crate::program::{Kind, KindIndex, Program};
use pleach_tree::Key;
use std::fmt::Write as _;

/// A string of modules: their kinds, all arguments in one array, and where something draws, their
/// addresses.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Modules {
    pub(crate) kinds: Vec<KindIndex>,
    pub(crate) values: Vec<f64>,
    /// One for each kind; empty if nothing draws.
    pub(crate) keys: Vec<Key>,
}

impl Modules {
    /// An empty string with room for this many modules and as many arguments.
    pub(crate) fn with_room(modules: usize) -> Self {
        let (kinds, values) = (Vec::with_capacity(modules), Vec::with_capacity(modules));
        Self { kinds, values, keys: Vec::new() }
    }

    pub(crate) fn clear(&mut self) {
        self.kinds.clear();
        self.values.clear();
        self.keys.clear();
    }

    pub(crate) fn append(&mut self, other: &Self) {
        self.kinds.extend_from_slice(&other.kinds);
        self.values.extend_from_slice(&other.values);
        self.keys.extend_from_slice(&other.keys);
    }

    /// The modules with their arguments.
    pub(crate) fn iter<'a>(&'a self, kinds: &'a [Kind]) -> impl Iterator<Item = (&'a Kind, &'a [f64])> {
        let mut at = 0;
        self.kinds.iter().map(move |&kind| {
            let kind = &kinds[usize::from(kind)];
            at += kind.arity;
            (kind, &self.values[at - kind.arity..at])
        })
    }

    /// The string as people write it: `A(2, 0.5)[+F]`.
    pub(crate) fn to_text(&self, program: &Program) -> String {
        let mut text = String::new();
        let spaced = program.kinds.iter().any(|k| k.name.len() > 1);
        let mut before = false;
        for (kind, values) in self.iter(&program.kinds) {
            let is_letter = kind.name.starts_with(|c: char| c.is_ascii_alphabetic());
            if spaced && before && is_letter {
                text.push(' ');
            }
            text.push_str(&kind.name);
            for (i, value) in values.iter().enumerate() {
                // Writing to a string cannot fail.
                let _ = write!(text, "{}{value}", if i == 0 { "(" } else { ", " });
            }
            if !values.is_empty() {
                text.push(')');
            }
            before = is_letter;
        }
        text
    }
}
