//! What a contestant may spend on a goal.

use super::contestant::Contestant;
use super::goal::Set;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use std::str::FromStr;
use std::time::Duration;

/// What a contestant may spend on a goal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Budget {
    /// It does not search.
    #[default]
    Free,
    /// Trees that the search grows: the result is the same everywhere.
    Trees(u64),
    /// Seconds of the whole fit: the result depends on the machine.
    Seconds(f64),
}

/// Fits of at most so many seconds are of every contestant that searches; longer ones are of the default alone.
const SHORT: f64 = 10.0;

impl Budget {
    pub(super) const fn trees(self) -> Option<u64> {
        match self {
            Self::Trees(trees) => Some(trees),
            Self::Free | Self::Seconds(_) => None,
        }
    }

    /// # Errors
    /// None for the seconds that an exam allows.
    pub(super) fn timeout(self) -> anyhow::Result<Option<Duration>> {
        match self {
            Self::Seconds(seconds) => Ok(Some(Duration::try_from_secs_f64(seconds)?)),
            Self::Free | Self::Trees(_) => Ok(None),
        }
    }

    /// Whether `contestant` has this budget on goals of `set`. Time is for goals that nobody here has grown: of our own
    /// a number of trees says more. Much time is for the default alone. So the exam ends within 90 minutes on two cores.
    pub(super) fn is_for(self, contestant: Contestant, set: Set) -> bool {
        match (self, contestant.search()) {
            (Self::Free, None) => contestant != Contestant::Truth || set == Set::Perturbed,
            (Self::Trees(_), Some(_)) => true,
            (Self::Seconds(seconds), Some(_)) => {
                set != Set::Perturbed && (seconds <= SHORT || contestant == Contestant::Default)
            }
            (Self::Free, Some(_)) | (Self::Trees(_) | Self::Seconds(_), None) => false,
        }
    }
}

/// In rows: empty, `100 trees` or `5 s`.
impl fmt::Display for Budget {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Free => Ok(()),
            Self::Trees(trees) => write!(f, "{trees} trees"),
            Self::Seconds(seconds) => write!(f, "{seconds} s"),
        }
    }
}

impl FromStr for Budget {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |text: &str| text.parse::<f64>().ok().filter(|n| n.is_finite() && *n > 0.0);
        let found = match text.rsplit_once(' ') {
            None if text.is_empty() => Some(Self::Free),
            Some((trees, "trees")) => trees.parse().ok().map(Self::Trees),
            Some((seconds, "s")) => number(seconds).map(Self::Seconds),
            _ => None,
        };
        let shown = pleach_tree::param::shown(text);
        found.ok_or_else(|| format!("`{shown}` is not a budget, expected such as `100 trees` or `5 s`"))
    }
}

impl Serialize for Budget {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Budget {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer)?.parse().map_err(serde::de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn budgets_are_texts_in_rows() {
        for (budget, text) in
            [(Budget::Free, ""), (Budget::Trees(100), "100 trees"), (Budget::Seconds(0.5), "0.5 s")]
        {
            assert_eq!((budget.to_string().as_str(), text.parse()), (text, Ok(budget)));
        }
        for text in ["100", "trees", "-1 s", "inf s", "1.5 trees"] {
            assert!(text.parse::<Budget>().is_err(), "{text}");
        }
    }

    #[test]
    fn every_contestant_has_its_budgets() {
        let is_for = |budget: Budget, one, set| budget.is_for(one, set);
        assert!(is_for(Budget::Free, Contestant::Truth, Set::Perturbed));
        assert!(!is_for(Budget::Free, Contestant::Truth, Set::Foreign));
        assert!(!is_for(Budget::Free, Contestant::Default, Set::Foreign));
        assert!(is_for(Budget::Trees(9), Contestant::Random, Set::Perturbed));
        assert!(!is_for(Budget::Trees(9), Contestant::Ellipse, Set::Perturbed));
        assert!(is_for(Budget::Seconds(5.0), Contestant::De, Set::Photographs));
        assert!(is_for(Budget::Seconds(60.0), Contestant::Default, Set::Foreign));
        assert!(!is_for(Budget::Seconds(60.0), Contestant::Cma, Set::Foreign));
        assert!(!is_for(Budget::Seconds(5.0), Contestant::Cma, Set::Perturbed));
    }
}
