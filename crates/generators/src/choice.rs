//! Which families of generators take part.

use crate::{UnknownFamily, default_family, families, family, presets};
use pleach_tree::Species;
use std::str::FromStr;

/// Which families of generators take part in a fit or a sheet: `auto`, `all`, or the name of one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GeneratorChoice {
    /// All of them.
    Auto,
    /// The one of this name.
    Family(&'static str),
}

impl Default for GeneratorChoice {
    /// The default family.
    fn default() -> Self {
        Self::Family(default_family().name())
    }
}

/// A word that is neither `auto`, `all` nor the name of a family.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}, and auto for all")]
pub struct UnknownGenerator(UnknownFamily);

impl FromStr for GeneratorChoice {
    type Err = UnknownGenerator;

    fn from_str(given: &str) -> Result<Self, Self::Err> {
        if ["auto", "all"].contains(&given) {
            return Ok(Self::Auto);
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
    /// Its name: `auto`, or the family's.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Family(name) => name,
        }
    }

    /// Whether `species` belongs to a family that takes part.
    #[must_use]
    pub fn takes(self, species: &Species) -> bool {
        match self {
            Self::Auto => true,
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
        for name in std::iter::once("auto").chain(crate::family_names()) {
            assert_eq!(name.parse::<GeneratorChoice>().unwrap().to_string(), name);
        }
        let error = "lsystems".parse::<GeneratorChoice>().unwrap_err().to_string();
        assert!(error.starts_with("unknown generator `lsystems`, known are weber-penn, lsystem"), "{error}");
    }
}
