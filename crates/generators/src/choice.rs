//! Which families of generators take part.

use crate::{UnknownFamily, default_family, families, family, presets};
use pleach_tree::Species;
use std::str::FromStr;

/// Which families of generators take part in a fit or a sheet: `auto`, `all`, `trees`, or the name of one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GeneratorChoice {
    /// All of them.
    Auto,
    /// Those whose trees stand as real ones do: Weber and Penn's, and space colonisation.
    Trees,
    /// The one of this name.
    Family(&'static str),
}

/// The families of [`GeneratorChoice::Trees`].
const TREES: [&str; 2] = ["weber-penn", "space-colonization"];

impl Default for GeneratorChoice {
    /// The default family.
    fn default() -> Self {
        Self::Family(default_family().name())
    }
}

/// A word that is neither `auto`, `all`, `trees` nor the name of a family.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}, auto for all, and trees for weber-penn and space-colonization")]
pub struct UnknownGenerator(UnknownFamily);

impl FromStr for GeneratorChoice {
    type Err = UnknownGenerator;

    fn from_str(given: &str) -> Result<Self, Self::Err> {
        if ["auto", "all"].contains(&given) {
            return Ok(Self::Auto);
        }
        if given == "trees" {
            return Ok(Self::Trees);
        }
        family(given).map(|family| Self::Family(family.name())).map_err(UnknownGenerator)
    }
}

impl std::fmt::Display for GeneratorChoice {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

impl GeneratorChoice {
    /// For drawings in flat colours: trees of few, smooth volumes.
    pub const DRAWINGS: Self = Self::Family("stylised");

    /// Its name: `auto`, `trees`, or the family's.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Trees => "trees",
            Self::Family(name) => name,
        }
    }

    /// Whether `species` belongs to a family that takes part.
    #[must_use]
    pub fn takes(self, species: &Species) -> bool {
        match self {
            Self::Auto => true,
            Self::Trees => TREES.contains(&species.generator.family()),
            Self::Family(name) => species.generator.family() == name,
        }
    }

    /// The known species of the families that take part, those of the default family first.
    pub fn known(self) -> impl Iterator<Item = Species> {
        let all = families().iter().flat_map(|family| presets(*family));
        all.filter(move |species| self.takes(species))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn generators_are_named_and_others_are_told_which_there_are() {
        assert_eq!("all".parse(), Ok(GeneratorChoice::Auto));
        assert_eq!("stylised".parse(), Ok(GeneratorChoice::DRAWINGS));
        for name in ["auto", "trees"].into_iter().chain(crate::family_names()) {
            assert_eq!(name.parse::<GeneratorChoice>().unwrap().to_string(), name);
        }
        assert!(TREES.iter().all(|name| crate::family(name).is_ok()));
        let of_trees = GeneratorChoice::Trees.known();
        assert_eq!(of_trees.filter(|species| species.generator.family() == TREES[1]).count(), 13);
        let error = "lsystems".parse::<GeneratorChoice>().unwrap_err().to_string();
        assert!(error.starts_with("unknown generator `lsystems`, known are weber-penn, lsystem"), "{error}");
    }
}
