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

use super::doc::{Node, SpeciesDoc, Value};
use super::error::Issue;
use super::key::{Form, Key};
use crate::param::{Problem, nearest, shown};
use pleach_plant::{Appearance, BarkPattern, Color, Season};

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

/// Reads the table of `doc`; what is wrong in it joins `issues` and is left out.
pub(super) fn read(doc: &SpeciesDoc, issues: &mut Vec<Issue>) -> Appearance {
    let mut appearance = Appearance::default();
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

/// The keys of the table that `appearance` says, with their values as they stand in a file, without quotes.
#[must_use]
pub fn appearance_keys(appearance: &Appearance) -> Vec<(Key, String)> {
    FIELDS.iter().filter_map(|field| Some((field.key, (field.written)(appearance)?))).collect()
}

/// The table as TOML, empty where nothing is said.
pub(super) fn to_toml(appearance: &Appearance) -> String {
    let line = |(key, value): (Key, String)| match key.form {
        Form::Switch => format!("{} = {value}\n", key.name),
        _ => format!("{} = \"{value}\"\n", key.name),
    };
    let lines: String = appearance_keys(appearance).into_iter().map(line).collect();
    if lines.is_empty() { lines } else { format!("\n[appearance]\n{lines}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pleach_plant::Look;

    fn table(text: &str) -> (Appearance, Vec<String>) {
        let doc = SpeciesDoc::parse("t.toml", text).unwrap();
        let mut issues = Vec::new();
        let appearance = read(&doc, &mut issues);
        (appearance, issues.iter().map(Issue::to_string).collect())
    }

    #[test]
    fn a_table_survives_the_file() {
        let text = "\n[appearance]\nbark = \"#6b5b4a\"\nautumn = \"#d9a520\"\nseason = \"winter\"\n";
        let (appearance, issues) = table(text);
        assert_eq!(issues, Vec::<String>::new());
        assert_eq!(appearance.bark, Some(Color([0x6b, 0x5b, 0x4a])));
        assert_eq!((appearance.leaf, appearance.season), (None, Some(Season::Winter)));
        assert_eq!(to_toml(&appearance), text);
        assert_eq!(to_toml(&table("").0), "");
    }

    #[test]
    fn every_key_survives_the_file() {
        let text = "\n[appearance]\nbark = \"#000001\"\nbark_pattern = \"banded\"\nleaf = \"#000002\"\n\
                    autumn = \"#000003\"\nblossom = \"#000004\"\nevergreen = true\nseason = \"spring\"\n";
        let (appearance, issues) = table(text);
        assert_eq!((issues, to_toml(&appearance).as_str()), (Vec::new(), text));
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
            table("[appearance]\nbark = \"brown\"\nleef = \"#000000\"\nseason = \"sumer\"\nleaf = 3");
        assert_eq!(issues.len(), 4, "{issues:?}");
        let said = |issues: &[String], words: [&str; 2]| {
            assert!(issues.iter().any(|i| words.iter().all(|w| i.contains(w))), "{words:?} in {issues:?}");
        };
        for words in
            [["t.toml:2:8", "#rrggbb"], ["t.toml:3:1", "`leaf`"], ["sumer", "summer"], ["5:8", "a string"]]
        {
            said(&issues, words);
        }
        assert!(table("appearance = 3").1[0].contains("a table"));
        let (_, issues) = table("[appearance]\nevergreen = \"yes\"\nbark_pattern = \"bandd\"\nbark = true");
        assert_eq!(issues.len(), 3, "{issues:?}");
        said(&issues, ["t.toml:2:13", "is a string, expected true or false"]);
        said(
            &issues,
            ["t.toml:3:16", "one of furrowed, banded, ringed, smooth, plain, did you mean `banded`?"],
        );
        said(&issues, ["t.toml:4:8", "is a boolean, expected a string"]);
    }
}
