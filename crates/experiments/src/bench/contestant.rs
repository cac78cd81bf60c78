//! Who takes part in the exam.

use pleach_fit::Optimizer;
use pleach_tree::param::nearest;
use std::fmt;
use std::str::FromStr;

/// A way to find a tree for a goal: a row of the leaderboard for each of its budgets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Contestant {
    /// `pleach fit` as it is: the kind, without this very tree.
    Default,
    /// The same with the optimiser `cma`.
    Cma,
    /// The same with the optimiser `de`.
    De,
    /// The genetic algorithm of Hewitt's dissertation, from random lists.
    Hewitt,
    /// Random lists of numbers.
    Random,
    /// The known species that the goal looks most like, as it is, at the goal's height.
    Retrieval,
    /// The first guess with predicted numbers, without a race and without a search.
    Guess,
    /// The goal's own numbers, of another seed.
    Truth,
    /// The best single ellipse: a picture, not a tree.
    Ellipse,
}

impl Contestant {
    pub(super) const ALL: [Self; 9] = [
        Self::Default,
        Self::Cma,
        Self::De,
        Self::Hewitt,
        Self::Random,
        Self::Retrieval,
        Self::Guess,
        Self::Truth,
        Self::Ellipse,
    ];

    /// Its name in rows and options.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Default => "default",
            Self::Cma => "cma",
            Self::De => "de",
            Self::Hewitt => "hewitt",
            Self::Random => "random",
            Self::Retrieval => "retrieval",
            Self::Guess => "guess",
            Self::Truth => "truth",
            Self::Ellipse => "ellipse",
        }
    }

    /// The optimiser that it searches with, and whether from random lists; `None` where it does not search.
    pub(super) fn search(self) -> Option<(Optimizer, bool)> {
        let from_random = match self {
            Self::Default | Self::Cma | Self::De => false,
            Self::Hewitt | Self::Random => true,
            Self::Retrieval | Self::Guess | Self::Truth | Self::Ellipse => return None,
        };
        let named = self.name().parse().ok();
        Some((named.unwrap_or_default(), from_random))
    }
}

/// A name that no row has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct UnknownRow(String);

impl fmt::Display for UnknownRow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = Contestant::ALL.map(Contestant::name);
        write!(f, "no row is called `{}`", pleach_tree::param::shown(&self.0))?;
        if let Some(near) = nearest(&self.0, names) {
            write!(f, ", did you mean `{near}`?")?;
        }
        write!(f, "; there are {}", names.join(", "))
    }
}

impl std::error::Error for UnknownRow {}

impl FromStr for Contestant {
    type Err = UnknownRow;

    fn from_str(name: &str) -> Result<Self, UnknownRow> {
        let known = Self::ALL.into_iter().find(|one| one.name() == name);
        known.ok_or_else(|| UnknownRow(name.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_to_rows_and_optimisers() {
        for one in Contestant::ALL {
            assert_eq!(one.name().parse(), Ok(one));
        }
        let optimizer = |one: Contestant| one.search().map(|(optimizer, _)| optimizer.name().to_owned());
        assert_eq!(optimizer(Contestant::Default).as_deref(), Some(Optimizer::default().name()));
        for one in [Contestant::Cma, Contestant::De, Contestant::Hewitt, Contestant::Random] {
            assert_eq!(optimizer(one).as_deref(), Some(one.name()));
        }
        assert_eq!(Contestant::Ellipse.search(), None);
        let error = "defaulted".parse::<Contestant>().unwrap_err().to_string();
        assert!(error.contains("did you mean `default`?; there are default, cma, de"), "{error}");
    }
}
