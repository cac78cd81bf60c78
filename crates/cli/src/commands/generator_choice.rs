//! Which families of generators take part: what `--generator` says.

use pleach_tree::Species;
use std::str::FromStr;

/// Which families of generators take part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum GeneratorChoice {
    /// All of them.
    Auto,
    /// The one of this name.
    Family(&'static str),
}

impl FromStr for GeneratorChoice {
    type Err = String;

    fn from_str(given: &str) -> Result<Self, Self::Err> {
        if ["auto", "all"].contains(&given) {
            return Ok(Self::Auto);
        }
        let family = pleach_generators::family(given);
        family.map(|family| Self::Family(family.name())).map_err(|error| format!("{error}, and auto for all"))
    }
}

impl std::fmt::Display for GeneratorChoice {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Auto => "auto",
            Self::Family(name) => name,
        })
    }
}

impl GeneratorChoice {
    /// Whether `species` is of them.
    pub(crate) fn takes(&self, species: &Species) -> bool {
        match self {
            Self::Auto => true,
            Self::Family(name) => species.generator.family() == *name,
        }
    }

    /// The known species of the families that take part, those of the default family first.
    pub(crate) fn known(&self) -> impl Iterator<Item = Species> {
        let all = pleach_generators::families().iter().flat_map(|family| pleach_generators::presets(*family));
        all.filter(|species| self.takes(species))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn generators_are_named_and_others_are_told_which_there_are() {
        assert_eq!("all".parse(), Ok(GeneratorChoice::Auto));
        for name in std::iter::once("auto").chain(pleach_generators::family_names()) {
            assert_eq!(name.parse::<GeneratorChoice>().unwrap().to_string(), name);
        }
        let error = "lsystems".parse::<GeneratorChoice>().unwrap_err();
        assert!(error.starts_with("unknown generator `lsystems`, known are weber-penn, lsystem"), "{error}");
    }
}
