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
        let names = || pleach_generators::families().iter().map(|family| family.name());
        if ["auto", "all"].contains(&given) {
            return Ok(Self::Auto);
        }
        let known = || std::iter::once("auto").chain(names()).collect::<Vec<_>>().join(", ");
        names()
            .find(|name| *name == given)
            .map(Self::Family)
            .ok_or_else(|| format!("unknown generator `{given}`, known are {}", known()))
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

    /// Their names.
    pub(crate) fn names(&self) -> Vec<&'static str> {
        let families = pleach_generators::families().iter();
        let taken = families.filter(|family| *self == Self::Auto || *self == Self::Family(family.name()));
        taken.flat_map(|family| family.presets().iter().map(|(name, _)| *name)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn generators_are_named_and_others_are_told_which_there_are() {
        assert_eq!("all".parse(), Ok(GeneratorChoice::Auto));
        for name in ["auto", "weber-penn", "lsystem", "fractal"] {
            assert_eq!(name.parse::<GeneratorChoice>().unwrap().to_string(), name);
        }
        let error = "lsystems".parse::<GeneratorChoice>().unwrap_err();
        assert!(error.starts_with("unknown generator `lsystems`, known are auto, weber-penn"), "{error}");
    }
}
