//! What can be wrong with a parameter's value, as facts.

use super::shown::shown;
use std::fmt;

/// What is wrong with one value or name. [`fmt::Display`] makes the rest of a sentence that begins
/// with the name: `g_scale` + "is 5000, …".
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Problem {
    /// Outside the allowed range.
    OutOfRange {
        /// What was given.
        value: f64,
        /// Smallest allowed value.
        min: f64,
        /// Largest allowed value.
        max: f64,
    },
    /// Infinite or not a number.
    NotFinite {
        /// What was given.
        value: f64,
    },
    /// Has a fraction where only whole numbers make sense.
    NotWhole {
        /// What was given.
        value: f64,
    },
    /// The wrong number of values.
    WrongLength {
        /// How many the parameter has.
        expected: usize,
        /// How many were given.
        found: usize,
    },
    /// Another type than expected.
    WrongType {
        /// What would be right, with its article.
        expected: &'static str,
        /// The type that was found.
        found: String,
    },
    /// A word that names none of the choices.
    UnknownChoice {
        /// What was given.
        value: String,
        /// The names that are known.
        known: Vec<String>,
        /// The nearest of them, if one is near.
        nearest: Option<String>,
    },
    /// A name that nothing has.
    UnknownName {
        /// The nearest name, if one is near.
        nearest: Option<String>,
    },
    /// A name that is known, but belongs elsewhere, or that another program gives to something known.
    Misplaced {
        /// What would be right.
        right: &'static str,
    },
    /// A word that chooses no slot.
    UnknownPattern {
        /// The nearest word that chooses some, if one is near.
        nearest: Option<String>,
        /// The groups of parameters.
        groups: Vec<String>,
        /// What lists are numbered by, and the length of the longest such list.
        lists: Vec<(String, usize)>,
    },
    /// Something that has to be given is not.
    Missing {
        /// What would be right.
        expected: String,
    },
    /// Anything that the format's parser objects to.
    Syntax {
        /// The parser's words.
        message: String,
    },
    /// A rule of one family of generators, or of one key, that no other variant says; values that do not go
    /// together. Families outside of pleach have rules of their own, so this one is a sentence.
    Conflict {
        /// What is wrong, and what would be right.
        message: String,
    },
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfRange { value, min, max } => {
                let (value, min, max) = (Plain(*value), Plain(*min), Plain(*max));
                write!(f, "is {value}, which is out of range: allowed is {min} to {max}")
            }
            Self::NotFinite { value } => write!(f, "is {value}, which is not a finite number"),
            Self::NotWhole { value } => write!(f, "is {}, which is not a whole number", Plain(*value)),
            Self::WrongLength { expected, found } => {
                write!(f, "has {found} value{}, expected {expected}", if *found == 1 { "" } else { "s" })
            }
            Self::WrongType { expected, found } => write!(f, "is {found}, expected {expected}"),
            Self::UnknownChoice { value, known, nearest } => {
                write!(f, "is `{}`, which is not one of {}", shown(value), known.join(", "))?;
                suggest(f, nearest.as_deref())
            }
            Self::UnknownName { nearest } => {
                write!(f, "is not a known name")?;
                suggest(f, nearest.as_deref())
            }
            Self::Misplaced { right } => write!(f, "is not a known name here: {right}"),
            Self::UnknownPattern { nearest, groups, lists } => {
                write!(f, "is not a known name")?;
                suggest(f, nearest.as_deref())?;
                let stop = if nearest.is_some() { "" } else { "." };
                write!(f, "{stop} Groups are {}", groups.join(", "))?;
                for (word, len) in lists {
                    let patterns: Vec<String> = (0..*len).map(|n| format!("{word}:{n}")).collect();
                    write!(f, "; {word}s are {}", patterns.join(", "))?;
                }
                Ok(())
            }
            Self::Missing { expected } => write!(f, "is missing, expected {expected}"),
            Self::Syntax { message } | Self::Conflict { message } => f.write_str(message),
        }
    }
}

/// A number without hundreds of digits.
struct Plain(f64);

impl fmt::Display for Plain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(value) = *self;
        if value == 0.0 || (1e-6..1e16).contains(&value.abs()) {
            write!(f, "{value}")
        } else {
            write!(f, "{value:e}")
        }
    }
}

fn suggest(f: &mut fmt::Formatter<'_>, nearest: Option<&str>) -> fmt::Result {
    nearest.map_or(Ok(()), |name| write!(f, ", did you mean `{name}`?"))
}

/// A problem with the value of one slot.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("`{slot}` {problem}")]
pub struct SlotError {
    /// The slot's name, such as `length[1]`.
    pub slot: String,
    /// What is wrong.
    pub problem: Problem,
}

/// Names longer than this are not misspellings, and comparing them takes time.
const MAX_NAME_CHARS: usize = 100;

/// The known name that `name` most likely stands for, if any is near enough: a few letters are wrong, or
/// it is a whole word of the known name, as `aspen` is of `quaking_aspen`.
#[must_use]
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<String> {
    if name.len() > MAX_NAME_CHARS {
        return None;
    }
    let lower = name.to_lowercase();
    known
        .into_iter()
        .filter_map(|candidate| Some((likeness(&lower, &candidate.to_lowercase())?, candidate)))
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, candidate)| candidate.to_owned())
}

/// How alike two names are, 0 to 1; `None` where they are too different to be confused.
fn likeness(name: &str, candidate: &str) -> Option<f64> {
    const MIN: f64 = 0.75;
    /// Alike enough whatever the number of letters that differ.
    const PLENTY: f64 = 0.85;
    const WORD: f64 = 0.95;
    let alike = strsim::jaro_winkler(name, candidate);
    if is_word_of(name, candidate) {
        return Some(alike.max(WORD));
    }
    // Jaro and Winkler's measure takes any few letters in their order for alike: `foo` for
    // `floor_splits`. One letter in three may be wrong.
    let letters = name.chars().count().max(candidate.chars().count());
    let few = strsim::osa_distance(name, candidate) <= (letters / 3).max(1);
    (alike > PLENTY || (few && alike > MIN)).then_some(alike)
}

/// Whether `name` is one of the words that `whole` is put together from, and not a mere letter.
#[must_use]
pub fn is_word_of(name: &str, whole: &str) -> bool {
    name.chars().count() > 2 && whole.split(|c: char| !c.is_alphanumeric()).any(|word| word == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sentences_have_a_verb() {
        let said = |problem: Problem| SlotError { slot: "g_scale".to_owned(), problem }.to_string();
        assert_eq!(
            said(Problem::OutOfRange { value: 5000.0, min: 0.01, max: 200.0 }),
            "`g_scale` is 5000, which is out of range: allowed is 0.01 to 200"
        );
        assert_eq!(said(Problem::NotWhole { value: 2.5 }), "`g_scale` is 2.5, which is not a whole number");
        assert_eq!(
            said(Problem::NotFinite { value: f64::NAN }),
            "`g_scale` is NaN, which is not a finite number"
        );
        assert_eq!(said(Problem::WrongLength { expected: 4, found: 1 }), "`g_scale` has 1 value, expected 4");
        let nearest = Some("g_scale_v".to_owned());
        assert_eq!(
            said(Problem::UnknownName { nearest }),
            "`g_scale` is not a known name, did you mean `g_scale_v`?"
        );
        let huge = said(Problem::OutOfRange { value: 1e308, min: 0.0, max: 1.0 });
        assert_eq!(huge, "`g_scale` is 1e308, which is out of range: allowed is 0 to 1");
    }

    #[test]
    fn values_are_shown_short() {
        let value = "y".repeat(5000);
        let problem = Problem::UnknownChoice { value, known: vec!["a".to_owned()], nearest: None };
        assert!(problem.to_string().len() < 120, "{problem}");
    }

    #[test]
    fn what_contains_the_typed_word_is_meant() {
        let known = ["apple", "acer", "quaking_aspen", "weeping_willow", "branches", "branch_dist"];
        let meant = |name| nearest(name, known);
        assert_eq!(meant("aspen").as_deref(), Some("quaking_aspen"));
        assert_eq!(meant("Willow").as_deref(), Some("weeping_willow"));
        assert_eq!(meant("brances").as_deref(), Some("branches"));
        assert_eq!(meant("appel").as_deref(), Some("apple"));
        assert_eq!(meant("zzz"), None);
        assert_eq!(meant(""), None);
    }

    #[test]
    fn misspelt_names_are_known_and_strangers_are_not() {
        let known = ["floor_splits", "branches", "branch_dist", "tree_seed", "length", "leaf_blos_num"];
        let near = |name: &str| nearest(name, known);
        for (name, meant) in [
            ("brances", "branches"),
            ("Lenght", "length"),
            ("seed", "tree_seed"),
            ("leaf_number", "leaf_blos_num"),
            ("floor_split", "floor_splits"),
        ] {
            assert_eq!(near(name).as_deref(), Some(meant), "{name}");
        }
        for stranger in ["foo", "all", "x", "", "oak", &"branches".repeat(1000)] {
            assert_eq!(near(stranger), None, "{stranger}");
        }
        let trees = ["apple", "quaking_aspen", "palm"];
        assert_eq!(nearest("aspen", trees).as_deref(), Some("quaking_aspen"));
        assert_eq!(nearest("plam", trees).as_deref(), Some("palm"));
    }
}
