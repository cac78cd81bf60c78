//! What can be wrong with a parameter's value, as facts.

use std::fmt;

/// What is wrong with one value or name; [`fmt::Display`] makes the sentence.
#[derive(Clone, Debug, PartialEq)]
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
    /// Values that are each allowed and do not go together.
    Conflict {
        /// Which, and what would be right.
        message: String,
    },
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfRange { value, min, max } => {
                write!(f, "{value} is out of range, allowed is {min} to {max}")
            }
            Self::NotFinite { value } => write!(f, "{value} is not a finite number"),
            Self::NotWhole { value } => write!(f, "{value} is not a whole number"),
            Self::WrongLength { expected, found } => {
                write!(f, "has {found} value{}, expected {expected}", if *found == 1 { "" } else { "s" })
            }
            Self::WrongType { expected, found } => write!(f, "is {found}, expected {expected}"),
            Self::UnknownChoice { value, known, nearest } => {
                write!(f, "`{value}` is not one of {}", known.join(", "))?;
                suggest(f, nearest.as_deref())
            }
            Self::UnknownName { nearest } => {
                write!(f, "unknown name")?;
                suggest(f, nearest.as_deref())
            }
            Self::Missing { expected } => write!(f, "is missing, expected {expected}"),
            Self::Syntax { message } | Self::Conflict { message } => f.write_str(message),
        }
    }
}

fn suggest(f: &mut fmt::Formatter<'_>, nearest: Option<&str>) -> fmt::Result {
    nearest.map_or(Ok(()), |name| write!(f, ", did you mean `{name}`?"))
}

/// A problem with the value of one slot.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{slot}: {problem}")]
pub struct SlotError {
    /// The slot's name, such as `length[1]`.
    pub slot: String,
    /// What is wrong.
    pub problem: Problem,
}

/// The known name that `name` most likely stands for, if any is near enough.
#[must_use]
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let lower = name.to_lowercase();
    known
        .into_iter()
        .map(|candidate| (strsim::jaro_winkler(&lower, &candidate.to_lowercase()), candidate))
        .filter(|(likeness, _)| *likeness > 0.75)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, candidate)| candidate.to_owned())
}
