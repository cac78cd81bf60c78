//! What a species looks like where that is not form: colours and season, for pictures and exports.
//!
//! ```toml
//! [appearance]
//! bark = "#6b5b4a"
//! bark_pattern = "furrowed"   # furrowed, banded, ringed or smooth
//! leaf = "#4f7a2e"
//! autumn = "#d9a520"          # leaves in autumn
//! blossom = "#f6dfe6"
//! evergreen = false
//! season = "summer"           # spring, summer, autumn or winter
//! ```
//!
//! Every key is optional. What is missing takes one plain look, [`Look::PLAIN`], whatever the species is
//! called. Generators never read it.

mod blend;
mod color;
mod words;

pub use color::Color;
pub use words::{BarkPattern, Season};

use super::doc::{Node, SpeciesDoc, Value};
use super::error::Issue;
use super::key::{Form, Key};
use crate::param::{Problem, nearest, shown};

/// The table `[appearance]` of a species file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Appearance {
    /// Colour of the bark.
    pub bark: Option<Color>,
    /// How bark is marked.
    pub bark_pattern: Option<BarkPattern>,
    /// Colour of leaves in summer.
    pub leaf: Option<Color>,
    /// Colour of leaves in autumn.
    pub autumn: Option<Color>,
    /// Colour of blossoms.
    pub blossom: Option<Color>,
    /// Whether leaves stay on, and green, all year.
    pub evergreen: Option<bool>,
    /// When the tree is shown.
    pub season: Option<Season>,
}

/// An [`Appearance`] with nothing left open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Look {
    /// Colour of the bark.
    pub bark: Color,
    /// How bark is marked.
    pub bark_pattern: BarkPattern,
    /// Colour of leaves in summer.
    pub leaf: Color,
    /// Colour of leaves in autumn.
    pub autumn: Color,
    /// Colour of blossoms.
    pub blossom: Color,
    /// Whether leaves stay on, and green, all year.
    pub evergreen: bool,
    /// When the tree is shown; `None` for full leaf with whatever blossom the model gives it.
    pub season: Option<Season>,
}

impl Look {
    /// What a species looks like that says nothing.
    pub const PLAIN: Self = Self {
        bark: Color::from_hex(0x6b_5c_4c),
        bark_pattern: BarkPattern::Furrowed,
        leaf: Color::from_hex(0x5c_83_36),
        autumn: Color::from_hex(0xd0_96_2c),
        blossom: Color::from_hex(0xf4_e3_e6),
        evergreen: false,
        season: None,
    };
}

/// A key of the table: its declaration, and how to write and to read it.
struct Field {
    key: Key,
    /// The value as it stands in a file, without quotes.
    written: fn(&Appearance) -> Option<String>,
    read: fn(&mut Appearance, &Said<'_>) -> Result<(), Issue>,
}

const COUNT: usize = 7;

const FIELDS: [Field; COUNT] = [
    Field {
        key: Key {
            name: "bark",
            form: Form::Color,
            default: "#6b5c4c",
            doc: "bark of trunks; twigs are drawn darker",
        },
        written: |a| a.bark.map(text),
        read: |a, said| said.color().map(|color| a.bark = Some(color)),
    },
    Field {
        key: Key {
            name: "bark_pattern",
            form: Form::Choice(&BarkPattern::NAMES),
            default: "furrowed",
            doc: "how bark is marked: along the stem, by level dashes, by rings, or nearly even",
        },
        written: |a| a.bark_pattern.map(|pattern| text(pattern.name())),
        read: |a, said| {
            let pattern = said.choice(&BarkPattern::NAMES, BarkPattern::from_name);
            pattern.map(|pattern| a.bark_pattern = Some(pattern))
        },
    },
    Field {
        key: Key { name: "leaf", form: Form::Color, default: "#5c8336", doc: "leaves in summer" },
        written: |a| a.leaf.map(text),
        read: |a, said| said.color().map(|color| a.leaf = Some(color)),
    },
    Field {
        key: Key {
            name: "autumn",
            form: Form::Color,
            default: "#d0962c",
            doc: "leaves in autumn, unless the species is evergreen",
        },
        written: |a| a.autumn.map(text),
        read: |a, said| said.color().map(|color| a.autumn = Some(color)),
    },
    Field {
        key: Key { name: "blossom", form: Form::Color, default: "#f4e3e6", doc: "blossoms" },
        written: |a| a.blossom.map(text),
        read: |a, said| said.color().map(|color| a.blossom = Some(color)),
    },
    Field {
        key: Key {
            name: "evergreen",
            form: Form::Switch,
            default: "false",
            doc: "whether leaves stay on, and green, in autumn and winter",
        },
        written: |a| a.evergreen.map(text),
        read: |a, said| said.switch().map(|evergreen| a.evergreen = Some(evergreen)),
    },
    Field {
        key: Key {
            name: "season",
            form: Form::Choice(&Season::NAMES),
            default: "none",
            doc: "when the tree is shown; without it in full leaf, and in blossom if it has any",
        },
        written: |a| a.season.map(|season| text(season.name())),
        read: |a, said| {
            let season = said.choice(&Season::NAMES, Season::from_name);
            season.map(|season| a.season = Some(season))
        },
    },
];

/// The declarations of the table's keys.
pub(super) const KEYS: [Key; COUNT] = {
    let mut keys = [FIELDS[0].key; COUNT];
    let mut i = 1;
    while i < COUNT {
        keys[i] = FIELDS[i].key;
        i += 1;
    }
    keys
};

fn text(value: impl std::fmt::Display) -> String {
    value.to_string()
}

/// A value of the table, and where it stands.
struct Said<'a> {
    doc: &'a SpeciesDoc,
    name: &'a str,
    node: &'a Node,
}

impl Said<'_> {
    fn wrong(&self, problem: Problem) -> Issue {
        self.doc.issue(self.node.span.clone(), self.name, problem)
    }

    fn color(&self) -> Result<Color, Issue> {
        let text = self.doc.text_of(self.name, self.node)?;
        Color::parse(text).ok_or_else(|| {
            let message =
                format!("\"{}\" is not a colour, expected \"#rrggbb\" such as \"#4f7a2e\"", shown(text));
            self.wrong(Problem::Conflict { message })
        })
    }

    fn switch(&self) -> Result<bool, Issue> {
        match &self.node.value {
            Value::Switch(value) => Ok(*value),
            other => {
                Err(self.wrong(Problem::WrongType { expected: "true or false", found: other.type_name() }))
            }
        }
    }

    fn choice<T>(&self, names: &[&str], from_name: fn(&str) -> Option<T>) -> Result<T, Issue> {
        let text = self.doc.text_of(self.name, self.node)?;
        from_name(text).ok_or_else(|| {
            self.wrong(Problem::UnknownChoice {
                value: text.to_owned(),
                known: names.iter().map(|&name| name.to_owned()).collect(),
                nearest: nearest(text, names.iter().copied()),
            })
        })
    }
}

impl Appearance {
    /// Reads the table of `doc`; what is wrong in it joins `issues` and is left out.
    #[must_use]
    pub fn read(doc: &SpeciesDoc, issues: &mut Vec<Issue>) -> Self {
        let mut appearance = Self::default();
        let Some(node) = doc.get("appearance") else { return appearance };
        let Value::Table(entries) = &node.value else {
            let problem = Problem::WrongType { expected: "a table", found: node.value.type_name() };
            issues.push(doc.issue(node.span.clone(), "appearance", problem));
            return appearance;
        };
        for entry in entries {
            let name = format!("appearance.{}", entry.key);
            let field = FIELDS.iter().find(|field| field.key.name == entry.key);
            let result = match field {
                Some(field) => (field.read)(&mut appearance, &Said { doc, name: &name, node: &entry.node }),
                None => {
                    let nearest = nearest(&entry.key, KEYS.iter().map(|key| key.name));
                    Err(doc.issue(entry.span.clone(), &name, Problem::UnknownName { nearest }))
                }
            };
            if let Err(issue) = result {
                issues.push(issue);
            }
        }
        appearance
    }

    /// How the species is drawn: what the table says, and the plain look where it is silent. What never
    /// turns has its summer's colour in autumn too.
    #[must_use]
    pub fn look(&self) -> Look {
        let plain = Look::PLAIN;
        let leaf = self.leaf.unwrap_or(plain.leaf);
        let evergreen = self.evergreen.unwrap_or(plain.evergreen);
        Look {
            bark: self.bark.unwrap_or(plain.bark),
            bark_pattern: self.bark_pattern.unwrap_or(plain.bark_pattern),
            leaf,
            autumn: if evergreen { leaf } else { self.autumn.unwrap_or(plain.autumn) },
            blossom: self.blossom.unwrap_or(plain.blossom),
            evergreen,
            season: self.season,
        }
    }

    /// The keys that are said, with their values as they stand in a file, without quotes.
    #[must_use]
    pub fn said(&self) -> Vec<(Key, String)> {
        FIELDS.iter().filter_map(|field| Some((field.key, (field.written)(self)?))).collect()
    }

    /// The table as TOML, empty where nothing is said.
    #[must_use]
    pub fn to_toml(&self) -> String {
        let line = |(key, value): (Key, String)| match key.form {
            Form::Switch => format!("{} = {value}\n", key.name),
            _ => format!("{} = \"{value}\"\n", key.name),
        };
        let lines: String = self.said().into_iter().map(line).collect();
        if lines.is_empty() { lines } else { format!("\n[appearance]\n{lines}") }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> (Appearance, Vec<String>) {
        let doc = SpeciesDoc::parse("t.toml", text).unwrap();
        let mut issues = Vec::new();
        let appearance = Appearance::read(&doc, &mut issues);
        (appearance, issues.iter().map(Issue::to_string).collect())
    }

    #[test]
    fn a_table_survives_the_file() {
        let text = "\n[appearance]\nbark = \"#6b5b4a\"\nautumn = \"#d9a520\"\nseason = \"winter\"\n";
        let (appearance, issues) = read(text);
        assert_eq!(issues, Vec::<String>::new());
        assert_eq!(appearance.bark, Some(Color([0x6b, 0x5b, 0x4a])));
        assert_eq!((appearance.leaf, appearance.season), (None, Some(Season::Winter)));
        assert_eq!(appearance.to_toml(), text);
        assert_eq!(read("").0.to_toml(), "");
    }

    #[test]
    fn every_key_survives_the_file() {
        let text = "\n[appearance]\nbark = \"#000001\"\nbark_pattern = \"banded\"\nleaf = \"#000002\"\n\
                    autumn = \"#000003\"\nblossom = \"#000004\"\nevergreen = true\nseason = \"spring\"\n";
        let (appearance, issues) = read(text);
        assert_eq!((issues, appearance.to_toml().as_str()), (Vec::new(), text));
        assert_eq!(text.lines().count(), 2 + KEYS.len(), "every key is in this test");
    }

    #[test]
    fn defaults_are_declared_as_they_are_drawn() {
        let default = |name: &str| KEYS.iter().find(|key| key.name == name).unwrap().default;
        let plain = Appearance::default().look();
        assert_eq!(plain, Look::PLAIN);
        for (name, color) in
            [("bark", plain.bark), ("leaf", plain.leaf), ("autumn", plain.autumn), ("blossom", plain.blossom)]
        {
            assert_eq!(default(name), color.to_string(), "{name}");
        }
        assert_eq!(default("bark_pattern"), plain.bark_pattern.name());
        assert_eq!(default("evergreen"), plain.evergreen.to_string());
    }

    #[test]
    fn mistakes_are_named_with_their_place() {
        let (_, issues) =
            read("[appearance]\nbark = \"brown\"\nleef = \"#000000\"\nseason = \"sumer\"\nleaf = 3");
        assert_eq!(issues.len(), 4, "{issues:?}");
        let said = |issues: &[String], words: [&str; 2]| {
            assert!(issues.iter().any(|i| words.iter().all(|w| i.contains(w))), "{words:?} in {issues:?}");
        };
        for words in
            [["t.toml:2:8", "#rrggbb"], ["t.toml:3:1", "`leaf`"], ["sumer", "summer"], ["5:8", "a string"]]
        {
            said(&issues, words);
        }
        assert!(read("appearance = 3").1[0].contains("a table"));
        let (_, issues) = read("[appearance]\nevergreen = \"yes\"\nbark_pattern = \"bandd\"\nbark = true");
        assert_eq!(issues.len(), 3, "{issues:?}");
        said(&issues, ["t.toml:2:13", "is a string, expected true or false"]);
        said(
            &issues,
            ["t.toml:3:16", "one of furrowed, banded, ringed, smooth, plain, did you mean `banded`?"],
        );
        said(&issues, ["t.toml:4:8", "is a boolean, expected a string"]);
    }
}
