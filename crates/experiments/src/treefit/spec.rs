//! The benchmark's `experiment.toml`.

use crate::spec::{Evaluations, Repetitions, Seed, Source, stem};
use crate::within::{Azimuth, FileName, List, Meters, Real, Seconds, SpeciesName, Word};
use pleach_fit::{Objective, Optimizer};
use pleach_generators::GeneratorChoice;
use serde::Deserialize;
use serde::de::{Error, IgnoredAny};
use std::path::PathBuf;
use toml::Spanned;

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in super::super) struct TreefitSpec {
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    #[serde(rename = "question")]
    _question: Option<String>,
    /// The goals.
    pub(super) goals: List<Spanned<GoalSpec>>,
    /// Ways to fit them.
    pub(super) methods: List<Spanned<MethodSpec>, 1, 100>,
}

impl TreefitSpec {
    pub(in super::super) fn checked(self, source: &Source) -> anyhow::Result<Self> {
        source.are_names_of_files(&self.goals, GoalSpec::name)?;
        source.all_differ(&self.methods, |method| method.name.clone(), "")?;
        for method in &self.methods {
            let MethodSpec { evaluations, seconds, .. } = method.get_ref();
            if evaluations.is_none() && seconds.is_none() {
                return Err(source.wrong(method.span(), "a method without `evaluations` or `seconds`"));
            }
            let MethodSpec { from, generator, .. } = method.get_ref();
            if *from != From::Auto && generator.is_some() {
                return Err(source.wrong(method.span(), "`generator` is for `from = \"auto\"`"));
            }
        }
        Ok(self)
    }

    /// The goals in order.
    pub(super) fn goals(&self) -> impl Iterator<Item = &GoalSpec> {
        self.goals.iter().map(Spanned::get_ref)
    }

    /// The methods in order.
    pub(super) fn methods(&self) -> impl Iterator<Item = &MethodSpec> {
        self.methods.iter().map(Spanned::get_ref)
    }

    /// The method that the report tells names of.
    pub(super) fn first_method(&self) -> &MethodSpec {
        self.methods[0].get_ref()
    }

    /// The methods whose results are kept in `fits`: the first, and the first of each other sort.
    pub(super) fn kept(&self) -> Vec<&MethodSpec> {
        let mut kept: Vec<&MethodSpec> = Vec::new();
        for method in self.methods() {
            if kept.iter().all(|other| other.sort() != method.sort()) {
                kept.push(method);
            }
        }
        kept
    }
}

/// A goal: a tree of ours, or a picture.
#[derive(Clone, Debug, Deserialize)]
#[serde(try_from = "GoalOptions")]
pub(super) enum GoalSpec {
    Own(OwnGoal),
    File(FileGoal),
}

/// The options of goals of either sort.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct GoalOptions {
    name: Option<FileName>,
    #[serde(default)]
    bare: bool,
    species: Option<SpeciesName>,
    seed: Option<Seed>,
    second_view: Option<Real<Azimuth>>,
    held_out: Option<Real<Azimuth>>,
    degraded: Option<Degraded>,
    file: Option<PathBuf>,
    height: Option<Real<Meters>>,
    #[serde(default)]
    others: List<PathBuf, 0, 100>,
    like: Option<SpeciesName>,
}

#[derive(Clone, Debug)]
pub(super) struct OwnGoal {
    /// Its name, if one is given.
    pub(super) name: Option<FileName>,
    /// The species by name.
    pub(super) species: String,
    /// Seed of its tree.
    pub(super) seed: u64,
    /// Whether its leaves are left out.
    pub(super) bare: bool,
    /// Azimuth in degrees of a second picture that is fitted as well.
    pub(super) second_view: Option<f64>,
    /// Azimuth in degrees of a picture that is only compared with.
    pub(super) held_out: Option<f64>,
    /// How the picture is spoilt.
    pub(super) degraded: Option<Degraded>,
}

impl OwnGoal {
    /// A whole tree from the front.
    pub(super) fn new(species: &str, seed: u64, bare: bool) -> Self {
        let (second_view, held_out) = (None, None);
        Self { name: None, species: species.to_owned(), seed, bare, second_view, held_out, degraded: None }
    }
}

/// How a picture may be spoilt.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Degraded {
    /// The right edge cuts off what is beyond half of the crown's reach.
    CutOff,
    /// The lowest sixth of the tree is hidden.
    NoTrunk,
    /// One pixel in fifty is of the wrong tone.
    Noise,
}

#[derive(Clone, Debug)]
pub(super) struct FileGoal {
    /// Its name, if one is given.
    name: Option<FileName>,
    /// The picture, from the experiment's folder.
    pub(super) file: PathBuf,
    /// Height of its tree in metres.
    pub(super) height: f64,
    /// Whether it shows no leaves.
    pub(super) bare: bool,
    /// Pictures of trees of other seeds by the same program, from the experiment's folder: likeness to
    /// them is what can be asked for.
    pub(super) others: Vec<PathBuf>,
    /// Where there are none: the species here that is nearest, whose seeds take their place.
    pub(super) like: Option<String>,
}

impl TryFrom<GoalOptions> for GoalSpec {
    type Error = serde::de::value::Error;

    fn try_from(said: GoalOptions) -> Result<Self, Self::Error> {
        let refuse = |is: bool, name: &str, sort: &str| {
            if is { Err(Self::Error::custom(format!("`{name}` is not for {sort}"))) } else { Ok(()) }
        };
        match (said.species, said.file) {
            (Some(species), None) => {
                let sort = "goals that are grown";
                refuse(said.height.is_some(), "height", sort)?;
                refuse(!said.others.is_empty(), "others", sort)?;
                refuse(said.like.is_some(), "like", sort)?;
                Ok(Self::Own(OwnGoal {
                    name: said.name,
                    species: species.to_string(),
                    seed: *said.seed.ok_or_else(|| Self::Error::missing_field("seed"))?,
                    bare: said.bare,
                    second_view: said.second_view.map(|azimuth| *azimuth),
                    held_out: said.held_out.map(|azimuth| *azimuth),
                    degraded: said.degraded,
                }))
            }
            (None, Some(file)) => {
                let sort = "goals that are files";
                refuse(said.seed.is_some(), "seed", sort)?;
                refuse(said.second_view.is_some(), "second_view", sort)?;
                refuse(said.held_out.is_some(), "held_out", sort)?;
                refuse(said.degraded.is_some(), "degraded", sort)?;
                Ok(Self::File(FileGoal {
                    name: said.name,
                    file,
                    height: *said.height.ok_or_else(|| Self::Error::missing_field("height"))?,
                    bare: said.bare,
                    others: said.others.to_vec(),
                    like: said.like.map(|species| species.to_string()),
                }))
            }
            _ => Err(Self::Error::custom("expected a goal with either `species` or `file`")),
        }
    }
}

/// Goals of a kind are reported together.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Kind {
    /// Leafy trees of known species.
    Own,
    /// The same without leaves.
    Bare,
    /// Two pictures of one tree.
    TwoViews,
    /// Spoilt pictures.
    Degraded,
    /// Leafy trees of other programs.
    Foreign,
    /// Trees of other programs without leaves.
    ForeignBare,
}

impl Kind {
    pub(super) const ALL: [Self; 6] =
        [Self::Own, Self::Bare, Self::TwoViews, Self::Degraded, Self::Foreign, Self::ForeignBare];

    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Own => "own",
            Self::Bare => "bare",
            Self::TwoViews => "two-views",
            Self::Degraded => "degraded",
            Self::Foreign => "foreign",
            Self::ForeignBare => "foreign-bare",
        }
    }
}

impl GoalSpec {
    pub(super) const fn kind(&self) -> Kind {
        match self {
            Self::Own(OwnGoal { degraded: Some(_), .. }) => Kind::Degraded,
            Self::Own(OwnGoal { second_view: Some(_), .. }) => Kind::TwoViews,
            Self::Own(OwnGoal { bare: true, .. }) => Kind::Bare,
            Self::Own(_) => Kind::Own,
            Self::File(FileGoal { bare: true, .. }) => Kind::ForeignBare,
            Self::File(_) => Kind::Foreign,
        }
    }

    /// Its name in the results.
    pub(super) fn name(&self) -> String {
        match self {
            Self::File(FileGoal { name: Some(name), .. }) | Self::Own(OwnGoal { name: Some(name), .. }) => {
                name.to_string()
            }
            Self::File(goal) => stem(&goal.file),
            Self::Own(goal) => {
                let ending = match (goal.degraded, self.kind()) {
                    (Some(Degraded::CutOff), _) => "_cut_off",
                    (Some(Degraded::NoTrunk), _) => "_no_trunk",
                    (Some(Degraded::Noise), _) => "_noise",
                    (None, Kind::TwoViews) => "_two_views",
                    (None, Kind::Bare) => "_bare",
                    (None, _) => "",
                };
                goal.species.clone() + ending
            }
        }
    }
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MethodSpec {
    /// Its name in the results.
    pub(super) name: String,
    /// The optimiser, at its default settings.
    pub(super) optimizer: Word<Optimizer>,
    /// Where it starts.
    pub(super) from: From,
    /// The generators that it fits; by default that of fits.
    generator: Option<Word<GeneratorChoice>>,
    /// Evaluations of a fit.
    pub(super) evaluations: Option<Evaluations>,
    /// Seconds of a fit, its first guess included; such rows depend on the machine.
    pub(super) seconds: Option<Real<Seconds>>,
    /// The objective; by default that of fits.
    pub(super) objective: Option<Word<Objective>>,
    /// Whether the tree's seed is searched; by default it is fixed.
    #[serde(default)]
    pub(super) any_seed: bool,
    /// Whether the result is the one of the last bests whose other seeds are best too; by default the last best.
    #[serde(default)]
    pub(super) validates: bool,
    /// Fits of each goal, seeded 1, 2, …; one by default.
    pub(super) repetitions: Option<Repetitions>,
    /// Kinds of goals that it fits; all by default.
    pub(super) goals: Option<List<Kind>>,
}

/// Where a fit starts.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub(super) enum From {
    /// From the first guess.
    Auto,
    /// From random lists.
    Random,
    /// From a volume in the goal's outline.
    Outline,
}

impl MethodSpec {
    /// The generators that it fits.
    pub(super) fn generator(&self) -> GeneratorChoice {
        let default = || GeneratorChoice::Family(pleach_generators::default_family().name());
        self.generator.as_ref().map_or_else(default, |word| word.value)
    }

    /// The sort of trees that it finds, as in the names of files.
    pub(super) fn sort(&self) -> &'static str {
        match self.from {
            From::Outline => "outline",
            From::Auto | From::Random => self.generator().name(),
        }
    }

    pub(super) fn fits(&self, kind: Kind) -> bool {
        self.goals.as_ref().is_none_or(|kinds| kinds.contains(&kind))
    }
}
