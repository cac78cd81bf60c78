//! `experiment.toml`: read and checked before anything runs; the kinds with folders have their own.
//!
//! Every option's type carries its range (`within.rs`); combinations of options are checked here. A
//! message names the option's place in the file and what would be right.

use super::within::{FileName, List, Meters, Real, SpeciesName, Whole, Word};
use anyhow::Context;
use pleach_fit::{Objective, Optimizer};
use serde::Deserialize;
use serde::de::{DeserializeOwned, IgnoredAny};
use std::ops::Range;
use std::path::{Path, PathBuf};
use toml::Spanned;

/// Kinds of experiments.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Kind {
    /// Optimisers against each other on goals.
    Fits,
    /// Time and size of trees, species by species.
    Growth,
    /// Blends of species, ours against the dissertation's.
    Blend,
    /// Measures of how alike pictures of trees are, against each other.
    Likeness,
    /// Fits of goals that the search has not grown.
    Treefit,
    /// How near to the truth parameters must be.
    Needle,
    /// Spoilt input of every sort.
    Robustness,
    /// Goals' own trees, branch by branch.
    Individual,
    /// Grammars evolved from nothing.
    Rules,
    /// Which family of generators a goal is taken for.
    Families,
    /// Graphs of least-cost paths and what they cost.
    Yao,
    /// Time, memory and vertices of stylised trees.
    Stylised,
    /// What is read in pictures of grown trees.
    Reading,
    /// Whole fits of pictures of real trees.
    Photographs,
    /// What one picture says about the numbers of its tree.
    Posterior,
    /// Fits of trees whose numbers no library has.
    Perturbed,
    /// The exam: every way to find a tree on the same goals.
    Bench,
}

impl Kind {
    /// The word in `experiment.toml`.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Fits => "fits",
            Self::Growth => "growth",
            Self::Blend => "blend",
            Self::Likeness => "likeness",
            Self::Treefit => "treefit",
            Self::Needle => "needle",
            Self::Robustness => "robustness",
            Self::Individual => "individual",
            Self::Rules => "rules",
            Self::Families => "families",
            Self::Yao => "yao",
            Self::Stylised => "stylised",
            Self::Reading => "reading",
            Self::Photographs => "photographs",
            Self::Posterior => "posterior",
            Self::Perturbed => "perturbed",
            Self::Bench => "bench",
        }
    }
}

/// The options of every experiment; its kind adds others.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct Head {
    pub(super) kind: Kind,
    /// The question, in one line.
    #[serde(default)]
    pub(super) question: String,
}

/// Largest seed: it must survive JSON.
pub(super) const MAX_SEED: u64 = 1 << 53;

/// A seed of trees or searches.
pub(super) type Seed = Whole<0, MAX_SEED>;
/// How often something is done with other seeds.
pub(super) type Repetitions = Whole<1, 10_000>;
/// Evaluations of a search.
pub(super) type Evaluations = Whole<1, 100_000_000>;

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FitsSpec {
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    #[serde(rename = "question")]
    _question: Option<String>,
    /// The goals.
    pub(super) goals: List<Spanned<GoalSpec>>,
    /// Optimisers by name, at their default settings.
    pub(super) optimizers: List<Spanned<Word<Optimizer>>>,
    /// Searches of each optimiser on each goal, seeded 1, 2, ….
    pub(super) repetitions: Repetitions,
    /// Evaluations of each search.
    pub(super) evaluations: Evaluations,
    /// Seed of every tree.
    pub(super) tree_seed: Seed,
    /// The objective; by default that of fits.
    pub(super) objective: Option<Word<Objective>>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GoalSpec {
    /// The picture, from the experiment's folder.
    pub(super) file: PathBuf,
    /// Height of its tree in metres.
    pub(super) height: Real<Meters>,
    /// Its name in the results; by default the file's name without its ending.
    name: Option<FileName>,
}

impl GoalSpec {
    /// Its name in the results.
    pub(super) fn name(&self) -> String {
        self.name.as_deref().map_or_else(|| stem(&self.file), str::to_owned)
    }
}

/// A file's name without its ending.
pub(super) fn stem(file: &Path) -> String {
    file.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GrowthSpec {
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    #[serde(rename = "question")]
    _question: Option<String>,
    /// Species by name.
    pub(super) species: List<Spanned<SpeciesName>>,
    /// Seeds 1 to this of each species.
    pub(super) seeds: Spanned<Whole<1, 100_000>>,
    /// Whether growing is timed as well.
    pub(super) timed: bool,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BlendSpec {
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    #[serde(rename = "question")]
    _question: Option<String>,
    /// Species by name; the palm, the quaking aspen and the silver birch among them.
    pub(super) species: Spanned<List<Spanned<SpeciesName>, 4, 100>>,
    /// Steps from one species to another.
    pub(super) steps: Whole<1, 1000>,
    /// Random points of the hull.
    pub(super) points: Whole<1, 10_000_000>,
}

/// The text of an `experiment.toml`, for messages that say where.
#[derive(Debug)]
pub(super) struct Source {
    pub(super) path: PathBuf,
    pub(super) text: String,
}

impl Source {
    pub(super) fn read(folder: &Path) -> anyhow::Result<Self> {
        let path = folder.join("experiment.toml");
        let bytes = std::fs::read(&path).with_context(|| {
            format!("cannot read {}: an experiment is a folder with an experiment.toml", path.display())
        })?;
        match String::from_utf8(bytes) {
            Ok(text) => Ok(Self { path, text }),
            Err(error) => {
                let whole = error.utf8_error().valid_up_to();
                let text = String::from_utf8_lossy(&error.as_bytes()[..whole]).into_owned();
                Err(Self { path, text }.wrong(whole..whole, "a byte that is not text, expected UTF-8"))
            }
        }
    }

    /// An error about the place `span`.
    pub(super) fn wrong(&self, span: Range<usize>, message: impl std::fmt::Display) -> anyhow::Error {
        let before = self.text.get(..span.start).unwrap_or(&self.text);
        let line = before.matches('\n').count() + 1;
        let column = before.chars().rev().take_while(|c| *c != '\n').count() + 1;
        // Names and values of any length and of any characters are quoted in it.
        let message = message.to_string();
        let short = |line: &str| line.split(' ').map(pleach_tree::param::shown).collect::<Vec<_>>().join(" ");
        let message: Vec<String> = message.lines().map(short).collect();
        anyhow::anyhow!("{}:{line}:{column}: {}", self.path.display(), message.join("\n"))
    }

    pub(super) fn parse<T: DeserializeOwned>(&self) -> anyhow::Result<T> {
        toml::from_str(&self.text).map_err(|e| self.wrong(e.span().unwrap_or(0..0), e.message().trim()))
    }

    pub(super) fn head(&self) -> anyhow::Result<Head> {
        self.parse()
    }

    /// Fails where an entry has the name of an earlier one.
    pub(super) fn all_differ<'a, T: 'a>(
        &self,
        entries: impl IntoIterator<Item = &'a Spanned<T>>,
        name: impl Fn(&T) -> String,
        hint: &str,
    ) -> anyhow::Result<()> {
        let mut seen = std::collections::BTreeSet::new();
        for entry in entries {
            let name = name(entry.get_ref());
            // Where case does not count, two files would be one.
            if !seen.insert(name.to_lowercase()) {
                return Err(self.wrong(entry.span(), format!("`{name}` is there twice{hint}")));
            }
        }
        Ok(())
    }

    /// Fails where the name of a goal cannot be that of a file, or is that of an earlier one.
    pub(super) fn are_names_of_files<T>(
        &self,
        goals: &[Spanned<T>],
        name: impl Fn(&T) -> String,
    ) -> anyhow::Result<()> {
        for goal in goals {
            if let Err(message) = name(goal.get_ref()).parse::<FileName>() {
                return Err(self.wrong(goal.span(), format!("{message}; `name` can be another")));
            }
        }
        self.all_differ(goals, name, ": give one of the two another `name`")
    }
}

impl FitsSpec {
    pub(super) fn checked(self, source: &Source) -> anyhow::Result<Self> {
        source.are_names_of_files(&self.goals, GoalSpec::name)?;
        source.all_differ(&self.optimizers, |word| word.text.clone(), "")?;
        Ok(self)
    }
}

impl GrowthSpec {
    pub(super) fn checked(self, source: &Source) -> anyhow::Result<Self> {
        source.all_differ(&self.species, |name| name.to_string(), "")?;
        if self.timed && **self.seeds.get_ref() < 2 {
            let message = "1 seed, expected at least 2 where trees are timed: one says nothing of growth";
            return Err(source.wrong(self.seeds.span(), message));
        }
        Ok(self)
    }
}

impl BlendSpec {
    pub(super) fn checked(self, source: &Source) -> anyhow::Result<Self> {
        let species = self.species.get_ref();
        source.all_differ(species, |name| name.to_string(), "")?;
        for needed in ["palm", "quaking_aspen", "silver_birch"] {
            if !species.iter().any(|name| **name.get_ref() == needed) {
                let message = format!("`{needed}` is missing: its blends are looked at");
                return Err(source.wrong(self.species.span(), message));
            }
        }
        Ok(self)
    }
}

/// The species that are files, which an experiment reads.
pub(super) fn species_files<'a>(
    names: impl IntoIterator<Item = &'a Spanned<SpeciesName>>,
) -> impl Iterator<Item = PathBuf> {
    names.into_iter().map(|name| PathBuf::from(name.get_ref().as_str())).filter(|path| path.is_file())
}
