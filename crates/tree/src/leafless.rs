//! Why a species that asks for leaves has none.

use std::fmt;

/// A number without which no tree of a species has leaves, although other numbers ask for them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Leafless {
    /// The number as in files: `length[3]`.
    pub parameter: String,
    /// What it is and what follows, as a clause that begins with a verb.
    pub cause: String,
    /// What to do about it, as a clause in the imperative.
    pub remedy: String,
}

impl fmt::Display for Leafless {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { parameter, cause, remedy } = self;
        write!(f, "`{parameter}` {cause}: {remedy}")
    }
}
