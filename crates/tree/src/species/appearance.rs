//! What a species looks like where that is not form: colours and season, for pictures and exports.
//!
//! ```toml
//! [appearance]
//! bark = "#6b5b4a"
//! leaf = "#4f7a2e"
//! autumn = "#d9a520"      # leaves in autumn
//! blossom = "#f6dfe6"
//! season = "summer"       # spring, summer, autumn or winter
//! ```
//!
//! Every key is optional; what is missing is left to whoever draws the tree. Generators never read
//! it.

use super::doc::{SpeciesDoc, Value};
use super::error::Issue;
use crate::param::{Problem, nearest};
use std::fmt;

/// A colour as on screens: sRGB, 0 to 255 a channel. Written `#rrggbb`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Colour(pub [u8; 3]);

impl Colour {
    /// Reads `#rrggbb`.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        let digits = text.strip_prefix('#').filter(|d| d.len() == 6 && d.is_ascii())?;
        let channel = |i: usize| u8::from_str_radix(&digits[2 * i..2 * i + 2], 16).ok();
        Some(Self([channel(0)?, channel(1)?, channel(2)?]))
    }
}

impl fmt::Display for Colour {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self([r, g, b]) = self;
        write!(f, "#{r:02x}{g:02x}{b:02x}")
    }
}

/// A time of the year.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Season {
    /// Young leaves, full blossom.
    Spring,
    /// Full leaf.
    #[default]
    Summer,
    /// Turning leaves, no blossom.
    Autumn,
    /// Bare, unless the species is evergreen.
    Winter,
}

impl Season {
    /// All four, in the order of the year.
    pub const ALL: [Self; 4] = [Self::Spring, Self::Summer, Self::Autumn, Self::Winter];

    /// The name in files and flags.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Spring => "spring",
            Self::Summer => "summer",
            Self::Autumn => "autumn",
            Self::Winter => "winter",
        }
    }

    /// The season of this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|season| season.name() == name)
    }
}

/// The table `[appearance]` of a species file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Appearance {
    /// Colour of the bark.
    pub bark: Option<Colour>,
    /// Colour of leaves in summer.
    pub leaf: Option<Colour>,
    /// Colour of leaves in autumn.
    pub autumn: Option<Colour>,
    /// Colour of blossoms.
    pub blossom: Option<Colour>,
    /// When the tree is shown.
    pub season: Option<Season>,
}

const KEYS: [&str; 5] = ["bark", "leaf", "autumn", "blossom", "season"];

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
            let mut colour = || {
                let text = doc.text_of(&name, &entry.node).map_err(|issue| issues.push(issue)).ok()?;
                let colour = Colour::parse(text);
                if colour.is_none() {
                    let message =
                        format!("\"{text}\" is no colour, expected \"#rrggbb\" such as \"#4f7a2e\"");
                    issues.push(doc.issue(entry.node.span.clone(), &name, Problem::Conflict { message }));
                }
                colour
            };
            match entry.key.as_str() {
                "bark" => appearance.bark = colour(),
                "leaf" => appearance.leaf = colour(),
                "autumn" => appearance.autumn = colour(),
                "blossom" => appearance.blossom = colour(),
                "season" => match season(doc, &name, &entry.node) {
                    Ok(season) => appearance.season = Some(season),
                    Err(issue) => issues.push(issue),
                },
                key => {
                    let problem = Problem::UnknownName { nearest: nearest(key, KEYS) };
                    issues.push(doc.issue(entry.span.clone(), &name, problem));
                }
            }
        }
        appearance
    }

    /// The table as TOML, empty where nothing is said.
    #[must_use]
    pub fn to_toml(&self) -> String {
        let colours =
            [("bark", self.bark), ("leaf", self.leaf), ("autumn", self.autumn), ("blossom", self.blossom)];
        let colours = colours.into_iter().filter_map(|(key, c)| Some((key, c?.to_string())));
        let season = self.season.map(|season| ("season", season.name().to_owned()));
        let lines: String =
            colours.chain(season).map(|(key, value)| format!("{key} = \"{value}\"\n")).collect();
        if lines.is_empty() { lines } else { format!("\n[appearance]\n{lines}") }
    }
}

fn season(doc: &SpeciesDoc, name: &str, node: &super::Node) -> Result<Season, Issue> {
    let text = doc.text_of(name, node)?;
    Season::from_name(text).ok_or_else(|| {
        let known = Season::ALL.map(Season::name);
        let problem = Problem::UnknownChoice {
            value: text.to_owned(),
            known: known.map(str::to_owned).to_vec(),
            nearest: nearest(text, known),
        };
        doc.issue(node.span.clone(), name, problem)
    })
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
        assert_eq!(appearance.bark, Some(Colour([0x6b, 0x5b, 0x4a])));
        assert_eq!((appearance.leaf, appearance.season), (None, Some(Season::Winter)));
        assert_eq!(appearance.to_toml(), text);
        assert_eq!(read("").0.to_toml(), "");
    }

    #[test]
    fn mistakes_are_named_with_their_place() {
        let (_, issues) =
            read("[appearance]\nbark = \"brown\"\nleef = \"#000000\"\nseason = \"sumer\"\nleaf = 3");
        assert_eq!(issues.len(), 4, "{issues:?}");
        let said = |words: [&str; 2]| issues.iter().any(|i| words.iter().all(|w| i.contains(w)));
        for words in
            [["t.toml:2:8", "#rrggbb"], ["t.toml:3:1", "`leaf`"], ["sumer", "summer"], ["5:8", "a string"]]
        {
            assert!(said(words), "{words:?} in {issues:?}");
        }
        assert!(read("appearance = 3").1[0].contains("a table"));
    }
}
