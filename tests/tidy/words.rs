//! The words of the sources: a name in a document has to be one of them.

use crate::tree::{Tree, text};
use std::collections::HashSet;

/// Files that say what names there are.
const SOURCES: [&str; 14] =
    ["rs", "py", "pyi", "ts", "tsx", "mjs", "js", "sh", "toml", "csv", "json", "html", "txt", "ipynb"];

pub(crate) struct Words {
    files: Vec<HashSet<String>>,
    options: HashSet<String>,
}

impl Words {
    pub(crate) fn read(tree: &Tree) -> Self {
        let mut words = Self { files: Vec::new(), options: HashSet::new() };
        // These tests name what is not there.
        for file in tree.with_extension(&SOURCES).filter(|file| !file.starts_with("tests/tidy/")) {
            let text = text(file);
            words.files.push(split(&text).map(str::to_owned).collect());
            words.options.extend(text.split("--").skip(1).map(|rest| {
                rest.split(|c: char| !(c.is_ascii_alphanumeric() || c == '-')).next().unwrap_or("").to_owned()
            }));
        }
        words
    }

    /// Whether one file has all of these words.
    pub(crate) fn has_together(&self, names: &[&str]) -> bool {
        self.files.iter().any(|file| names.iter().all(|name| file.contains(*name)))
    }

    /// Whether this is an option: written somewhere, or a field that an option is made of.
    pub(crate) fn has_option(&self, option: &str) -> bool {
        self.options.contains(option) || self.has_together(&[&option.replace('-', "_")])
    }
}

/// The identifiers of a text.
pub(crate) fn split(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).filter(|word| !word.is_empty())
}
