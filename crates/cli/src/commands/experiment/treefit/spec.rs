//! What the benchmark's `experiment.toml` says.

use serde::Deserialize;
use std::path::PathBuf;

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in super::super) struct TreefitSpec {
    /// The goals.
    pub(super) goals: Vec<GoalSpec>,
    /// Ways to fit them.
    pub(super) methods: Vec<MethodSpec>,
}

/// A goal: a tree of ours, or a picture.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub(super) enum GoalSpec {
    Own(OwnGoal),
    File(FileGoal),
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct OwnGoal {
    /// The species by name.
    pub(super) species: String,
    /// Seed of its tree.
    pub(super) seed: u64,
    /// Whether its leaves are left out.
    #[serde(default)]
    pub(super) bare: bool,
    /// Azimuth in degrees of a second picture that is fitted as well.
    pub(super) second_view: Option<f64>,
    /// Azimuth in degrees of a picture that is only compared with.
    pub(super) held_out: Option<f64>,
    /// What is wrong with the picture.
    pub(super) degraded: Option<Degraded>,
}

/// What may be wrong with a picture.
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

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileGoal {
    /// The picture, from the experiment's folder.
    pub(super) file: PathBuf,
    /// Height of its tree in metres.
    pub(super) height: f64,
    /// Whether it shows no leaves.
    #[serde(default)]
    pub(super) bare: bool,
    /// Pictures of trees of other seeds by the same program, from the experiment's folder: likeness to
    /// them is what can be asked for.
    #[serde(default)]
    pub(super) others: Vec<PathBuf>,
    /// Where there are none: the species here that is nearest, whose seeds take their place.
    pub(super) like: Option<String>,
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

    /// What it is called in the results.
    pub(super) fn name(&self) -> String {
        match self {
            Self::File(goal) => goal.file.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
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
    /// What it is called in the results.
    pub(super) name: String,
    /// The optimiser, at its default settings.
    pub(super) optimizer: String,
    /// Where it starts: auto or random.
    pub(super) from: String,
    /// Evaluations of a fit.
    pub(super) evaluations: Option<u64>,
    /// Seconds of a fit, its first guess included; such rows depend on the machine.
    pub(super) seconds: Option<f64>,
    /// What is made small; the default objective if it is not said.
    pub(super) objective: Option<String>,
    /// Whether the tree's seed is searched; fixed if not said.
    #[serde(default)]
    pub(super) any_seed: bool,
    /// Fits of each goal, seeded 1, 2, …; one if it is not said.
    pub(super) repetitions: Option<u64>,
    /// Kinds of goals that it fits; all if it is not said.
    pub(super) goals: Option<Vec<Kind>>,
}

impl MethodSpec {
    pub(super) fn fits(&self, kind: Kind) -> bool {
        self.goals.as_ref().is_none_or(|kinds| kinds.contains(&kind))
    }
}
