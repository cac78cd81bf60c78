//! Where a stem is in its tree, whatever other stems do.

use crate::random::Key;
use std::fmt::{self, Write as _};
use std::str::FromStr;

/// One step from a stem to one that grows from it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Step {
    /// To the child of this number, or from the ground to the trunk of this number.
    Child(u32),
    /// To the fork of this number.
    Fork(u32),
}

/// The numbers of the stems from the ground to a stem, as in `0/12/f1`: the first fork of child 12 of the
/// first trunk. At least one step.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct StemPath(Vec<Step>);

/// A text that is not the path of a stem.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected numbers from the trunk up, such as \"0/12/f1\"")]
pub struct BadStemPath;

impl StemPath {
    /// Most steps: trees have fewer levels, and their stems few forks after each other.
    pub const MAX_STEPS: usize = 64;

    /// The trunk of this number.
    #[must_use]
    pub fn trunk(number: u32) -> Self {
        Self(vec![Step::Child(number)])
    }

    /// The stem that `step` leads to from here.
    #[must_use]
    pub fn then(&self, step: Step) -> Self {
        let mut steps = self.0.clone();
        steps.push(step);
        Self(steps)
    }

    /// Whether it is on `stem`: carried by it, or the stem itself.
    #[must_use]
    pub fn is_on(&self, stem: &Self) -> bool {
        self.0.starts_with(&stem.0)
    }

    /// The same as a generator carries it.
    #[must_use]
    pub fn address(&self) -> Address {
        let mut address = None;
        for step in &self.0 {
            address = Some(match (address, step) {
                (None, Step::Child(number) | Step::Fork(number)) => Address::trunk(*number),
                (Some(parent), step) => Address::then(parent, *step),
            });
        }
        // A path has at least one step.
        address.unwrap_or(Address::trunk(0))
    }
}

impl fmt::Display for StemPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, step) in self.0.iter().enumerate() {
            if i > 0 {
                f.write_char('/')?;
            }
            match step {
                Step::Child(number) => write!(f, "{number}")?,
                Step::Fork(number) => write!(f, "f{number}")?,
            }
        }
        Ok(())
    }
}

impl FromStr for StemPath {
    type Err = BadStemPath;

    fn from_str(text: &str) -> Result<Self, BadStemPath> {
        let number = |digits: &str| {
            // Other spellings of a number would give a stem two names.
            let number: u32 = digits.parse().map_err(|_| BadStemPath)?;
            if number.to_string() == digits { Ok(number) } else { Err(BadStemPath) }
        };
        let mut steps = Vec::new();
        for part in text.split('/') {
            if steps.len() == Self::MAX_STEPS {
                return Err(BadStemPath);
            }
            steps.push(match part.strip_prefix('f') {
                Some(digits) if !steps.is_empty() => Step::Fork(number(digits)?),
                _ => Step::Child(number(part)?),
            });
        }
        Ok(Self(steps))
    }
}

/// Where a stem is, in a form that costs nothing to carry: a hash of its [`StemPath`], which is not a
/// function of the seed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Address {
    hash: Key,
    generation: u16,
    is_fork: bool,
}

impl Address {
    /// The trunk of this number.
    #[must_use]
    pub fn trunk(number: u32) -> Self {
        Self { hash: Key::root(u64::from(number)), generation: 0, is_fork: false }
    }

    /// The child of this number.
    #[must_use]
    pub fn child(self, number: u32) -> Self {
        Self {
            hash: self.hash.child(0, number),
            generation: self.generation.saturating_add(1),
            is_fork: false,
        }
    }

    /// The fork of this number.
    #[must_use]
    pub fn fork(self, number: u32) -> Self {
        Self {
            hash: self.hash.child(1, number),
            generation: self.generation.saturating_add(1),
            is_fork: true,
        }
    }

    fn then(self, step: Step) -> Self {
        match step {
            Step::Child(number) => self.child(number),
            Step::Fork(number) => self.fork(number),
        }
    }

    /// Number of stems below it, down to the trunk: 0 for trunks.
    #[must_use]
    pub const fn generation(self) -> u16 {
        self.generation
    }

    /// Whether it is a fork.
    #[must_use]
    pub const fn is_fork(self) -> bool {
        self.is_fork
    }

    /// A number that, but for collisions of 64 bits, no other stem of the tree has.
    #[must_use]
    pub fn bits(self) -> u64 {
        self.hash.bits(3, 0)
    }

    /// The hash.
    pub(super) fn key(self) -> Key {
        self.hash
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_read_as_they_are_written() {
        for text in ["0", "3/12", "0/12/f1/4", "0/f4294967295"] {
            let path: StemPath = text.parse().unwrap();
            assert_eq!(path.to_string(), text);
        }
        let long = vec!["1"; StemPath::MAX_STEPS + 1].join("/");
        for text in ["", "f0", "0/", "/1", "0/x", "0/-1", "0/+1", "0/01", "0/4294967296", "0 / 1", &long] {
            assert_eq!(text.parse::<StemPath>(), Err(BadStemPath), "{text}");
        }
    }

    #[test]
    fn an_address_is_that_of_its_path() {
        let path: StemPath = "2/12/f1".parse().unwrap();
        let address = Address::trunk(2).child(12).fork(1);
        assert_eq!(path.address(), address);
        assert_eq!((address.generation(), address.is_fork()), (2, true));
        assert_eq!(path, StemPath::trunk(2).then(Step::Child(12)).then(Step::Fork(1)));
        assert_ne!(address, Address::trunk(2).child(12).child(1));
        assert_ne!(Address::trunk(1).child(2), Address::trunk(2).child(1));
    }

    #[test]
    fn a_stem_is_on_itself_and_on_what_carries_it() {
        let path = |text: &str| text.parse::<StemPath>().unwrap();
        assert!(path("0/1/f2").is_on(&path("0/1")) && path("0/1").is_on(&path("0/1")));
        assert!(!path("0/1").is_on(&path("0/1/f2")) && !path("0/12").is_on(&path("0/1")));
    }
}
