//! Where a fit starts: random lists, a species, or whatever the goal looks like.

use crate::input;
use anyhow::{Context, bail, ensure};
use pleach::plan::{Origin, plan, usual_start};
use pleach_fit::{FirstGuess, FitSettings, GoalSettings, RulesSettings, Runner};
use pleach_generators::GeneratorChoice;
use pleach_tree::{Foliage, Species, SpeciesDoc};
use serde::Serialize;
use std::str::FromStr;

/// What `--from` says.
#[derive(Clone, Debug)]
pub(super) enum From {
    /// The known species that the goal looks like.
    Auto,
    /// Random parameter lists.
    Random,
    /// A species by name or file.
    Species(String),
}

impl FromStr for From {
    type Err = std::convert::Infallible;

    fn from_str(given: &str) -> Result<Self, Self::Err> {
        Ok(match given {
            "auto" => Self::Auto,
            "random" => Self::Random,
            species => Self::Species(species.to_owned()),
        })
    }
}

impl std::fmt::Display for From {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Auto => "auto",
            Self::Random => "random",
            Self::Species(name) => name,
        })
    }
}

/// A species that the goal was compared with, in `summary.json`.
#[derive(Clone, Debug, Serialize)]
pub(super) struct LooksLike {
    species: String,
    confidence: f64,
}

/// Whether a fit grows leaves: what `--leaves` says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Leaves {
    /// If the goal looks more like trees with leaves than like bare ones; with --from auto only
    Auto,
    /// Always
    On,
    /// Never: the goal is a bare tree
    Off,
}

impl Leaves {
    /// The leaves that are grown unless the goal says otherwise.
    pub(super) const fn expected(self) -> Foliage {
        if matches!(self, Self::Off) { Foliage::None } else { Foliage::All }
    }
}

/// Species with less confidence than this are not spoken of.
const MIN_CONFIDENCE: f64 = 0.01;

/// The species that a goal looks like, the likeliest first.
pub(super) fn looks_like(guess: Option<&FirstGuess>) -> Vec<LooksLike> {
    let names = guess.into_iter().flat_map(|guess| &guess.names);
    names
        .filter(|(_, confidence)| *confidence >= MIN_CONFIDENCE)
        .map(|(species, confidence)| LooksLike { species: species.clone(), confidence: *confidence })
        .collect()
}

/// The families that a goal was compared with, the best of each, best first; none if there is only one.
pub(super) fn families(guess: Option<&FirstGuess>) -> Vec<Runner> {
    let mut best: Vec<Runner> = Vec::new();
    for runner in guess.into_iter().flat_map(|guess| &guess.runners) {
        if best.iter().all(|known| known.family != runner.family) {
            best.push(runner.clone());
        }
    }
    if best.len() < 2 { Vec::new() } else { best }
}

/// What is said of the race of families, if there was one.
pub(super) fn raced(guess: &FirstGuess) -> Option<String> {
    let families = families(Some(guess));
    let (first, others) = families.split_first()?;
    let others: Vec<String> =
        others.iter().map(|one| format!("{} {:.2}, {:.3}", one.family, one.likeness, one.reached)).collect();
    Some(format!(
        "family {}: likeness at first {:.2}, cost after a short race {:.3}; {}",
        first.family,
        first.likeness,
        first.reached,
        others.join("; ")
    ))
}

/// What is said of a first guess; `detected` says whether leaves were looked for.
pub(super) fn said(guess: &FirstGuess, detected: bool) -> String {
    let names = looks_like(Some(guess));
    let said: Vec<String> = (names.iter().take(3))
        .map(|LooksLike { species, confidence }| format!("{species} ({:.0} %)", 100.0 * confidence))
        .collect();
    let bare = if detected && guess.foliage == Foliage::None {
        ": a bare tree, so no leaves are grown (--leaves on grows them)"
    } else {
        ""
    };
    format!("looks like {}{bare}", said.join(", "))
}

/// The family whose structures can be searched.
pub(super) fn varied_family() -> anyhow::Result<GeneratorChoice> {
    let family = pleach_generators::families().iter().find(|family| family.blank().is_some());
    Ok(GeneratorChoice::Family(family.context("a family has rules")?.name()))
}

impl From {
    /// The species that a search over rules starts from: that of `--from`, or one without rules.
    pub(super) fn varied(&self, generator: &GeneratorChoice) -> anyhow::Result<Species> {
        let given = if let Self::Species(_) = self { Some(self.species(generator)?) } else { None };
        let family = match (&given, generator) {
            (Some(species), _) => species.generator.family(),
            (None, GeneratorChoice::Family(name)) => name,
            (None, GeneratorChoice::Auto) => bail!(no_rules("auto")),
        };
        let family = pleach_generators::family(family)?;
        let blank = family.blank().with_context(|| no_rules(family.name()))?;
        let species = given.map_or_else(|| SpeciesDoc::parse("blank", blank)?.species(family), Ok)?;
        ensure!(
            species.generator.variation().is_some(),
            "the grammar of {} is longer than --evolve-rules takes",
            species.name
        );
        Ok(species)
    }

    /// The species whose generator is fitted, and whose values fixed parameters keep unless a guess
    /// has better ones.
    pub(super) fn species(&self, generator: &GeneratorChoice) -> anyhow::Result<Species> {
        if let Self::Species(name) = self {
            let species = input::species(name)?.kind();
            ensure!(
                generator.takes(&species),
                "--from {name} is a species of the generator {}, and --generator says {generator}",
                species.generator.family()
            );
            return Ok(species);
        }
        usual_start(*generator).context("a generator has species that are built in")
    }

    /// Whether leaves are looked for in the goal.
    pub(super) fn detects(&self, leaves: Leaves, rules: Option<&RulesSettings>) -> bool {
        matches!(self, Self::Auto) && rules.is_none() && leaves == Leaves::Auto
    }

    /// The whole fit, with `search` from `start`, the species that [`From::species`] says.
    ///
    /// An error if no parameter of the species that take part is free.
    pub(super) fn plan(
        &self,
        generator: GeneratorChoice,
        leaves: Leaves,
        start: &Species,
        search: &FitSettings,
    ) -> anyhow::Result<GoalSettings> {
        let rules = search.rules.as_ref();
        let origin = match self {
            Self::Auto if rules.is_none() => Origin::Guess { detect_leaves: self.detects(leaves, rules) },
            Self::Species(_) => Origin::Start,
            Self::Auto | Self::Random => Origin::Random,
        };
        Ok(plan(origin, generator, start, search.clone())?)
    }
}

/// Why `--evolve-rules` cannot be.
fn no_rules(generator: &str) -> String {
    format!("--evolve-rules is about grammars, and the generator is {generator}: --generator lsystem")
}

#[cfg(test)]
mod tests {
    use super::*;
    use pleach_fit::{Guessing, Start};

    #[test]
    fn a_species_of_another_generator_is_refused() {
        let from: From = "palm".parse().unwrap();
        assert!(from.species(&GeneratorChoice::Family("weber-penn")).is_ok());
        let error = from.species(&GeneratorChoice::Family("lsystem")).unwrap_err().to_string();
        assert!(
            error.contains("palm") && error.contains("weber-penn") && error.contains("lsystem"),
            "{error}"
        );
    }

    #[test]
    fn what_is_said_is_where_a_fit_begins() {
        let plan = |from: &str, leaves| {
            let from: From = from.parse().unwrap();
            let start = from.species(&GeneratorChoice::Auto).unwrap();
            let settings = from.plan(GeneratorChoice::Auto, leaves, &start, &FitSettings::default()).unwrap();
            (settings, start)
        };
        let (auto, _) = plan("auto", Leaves::Auto);
        assert!(matches!(auto.guess, Guessing::Compare(how) if how.detect_leaves));
        let (leafy, _) = plan("auto", Leaves::On);
        assert!(matches!(leafy.guess, Guessing::Compare(how) if !how.detect_leaves));
        let (random, start) = plan("random", Leaves::Auto);
        assert_eq!((random.search.start, start.name.as_str()), (Start::Random, "quaking_aspen"));
        let (palm, start) = plan("palm", Leaves::Auto);
        assert_eq!(palm.search.start, Start::Lists(vec![start.params.values().to_vec()]));
    }
}
