//! How a fit is run.

use crate::budget::Budget;
use crate::genome::{Genome, Score};
use crate::method::{
    Cma, CmaSettings, Evolution, EvolutionSettings, Hewitt, HewittSettings, Method, Random, RandomSettings,
    Shade, ShadeSettings, Start,
};
use crate::objective::Objective;
use crate::space::{Freedom, SearchSpace, TreeSeed};
use pleach_tree::Limits;
use serde::{Deserialize, Serialize};
use std::num::NonZeroU32;
use std::str::FromStr;

/// Which optimiser, with its settings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Optimizer {
    /// [`Random`].
    Random(RandomSettings),
    /// [`Hewitt`].
    Hewitt(HewittSettings),
    /// [`Evolution`].
    Evolution(EvolutionSettings),
    /// [`Cma`].
    Cma(CmaSettings),
    /// [`Shade`].
    De(ShadeSettings),
}

/// A word that names no optimiser.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown optimizer `{given}`, known are {}", Optimizer::NAMES.join(", "))]
pub struct UnknownOptimizer {
    /// What was given.
    pub given: String,
}

impl Optimizer {
    /// The names of all optimisers, the default first.
    pub const NAMES: [&'static str; 5] = ["evolution", "cma", "de", "hewitt", "random"];

    /// The name on the command line.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Random(_) => "random",
            Self::Hewitt(_) => "hewitt",
            Self::Evolution(_) => "evolution",
            Self::Cma(_) => "cma",
            Self::De(_) => "de",
        }
    }

    /// The optimiser at its beginning.
    #[must_use]
    pub fn method(&self, seed: u64, start: Start) -> AnyMethod {
        match self {
            Self::Random(settings) => AnyMethod::Random(Random::new(settings.clone(), seed, start)),
            Self::Hewitt(settings) => AnyMethod::Hewitt(Hewitt::new(settings.clone(), seed, start)),
            Self::Evolution(settings) => AnyMethod::Evolution(Evolution::new(settings.clone(), seed, start)),
            Self::Cma(settings) => AnyMethod::Cma(Cma::new(settings.clone(), seed, start)),
            Self::De(settings) => AnyMethod::De(Shade::new(settings.clone(), seed, start)),
        }
    }
}

impl Optimizer {
    /// Whether it wants trees resized to the goal's height before they are compared: see
    /// [`crate::Evaluator::matching_height`]. The dissertation's algorithm and the random floor do not.
    #[must_use]
    pub const fn matches_height(&self) -> bool {
        match self {
            Self::Random(_) | Self::Hewitt(_) => false,
            Self::Evolution(settings) => settings.match_height,
            Self::Cma(_) | Self::De(_) => true,
        }
    }
}

impl Optimizer {
    /// Whether it searches what is [plausible](pleach_tree::Generator::plausible) only, and not all of
    /// the search ranges. The dissertation's algorithm and the random floor do not.
    pub(crate) const fn keeps_to_reason(&self) -> bool {
        !matches!(self, Self::Random(_) | Self::Hewitt(_))
    }

    /// How strongly numbers are drawn to the start: see [`SearchSpace::drawn_to`].
    pub(crate) const fn prior(&self) -> f64 {
        match self {
            Self::Evolution(settings) => settings.prior,
            Self::Random(_) | Self::Hewitt(_) | Self::Cma(_) | Self::De(_) => 0.0,
        }
    }
}

impl FromStr for Optimizer {
    type Err = UnknownOptimizer;

    fn from_str(given: &str) -> Result<Self, Self::Err> {
        match given {
            "random" => Ok(Self::Random(RandomSettings::default())),
            "cma" => Ok(Self::Cma(CmaSettings::default())),
            "de" => Ok(Self::De(ShadeSettings::default())),
            "evolution" => Ok(Self::Evolution(EvolutionSettings::default())),
            "hewitt" => Ok(Self::Hewitt(HewittSettings::default())),
            _ => Err(UnknownOptimizer { given: given.to_owned() }),
        }
    }
}

/// Any of the optimisers, at some point of its work.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum AnyMethod {
    /// [`Random`].
    Random(Random),
    /// [`Hewitt`].
    Hewitt(Hewitt),
    /// [`Evolution`].
    Evolution(Evolution),
    /// [`Cma`].
    Cma(Cma),
    /// [`Shade`].
    De(Shade),
}

impl AnyMethod {
    fn inner(&self) -> &dyn Method {
        match self {
            Self::Random(method) => method,
            Self::Hewitt(method) => method,
            Self::Evolution(method) => method,
            Self::Cma(method) => method,
            Self::De(method) => method,
        }
    }

    fn inner_mut(&mut self) -> &mut dyn Method {
        match self {
            Self::Random(method) => method,
            Self::Hewitt(method) => method,
            Self::Evolution(method) => method,
            Self::Cma(method) => method,
            Self::De(method) => method,
        }
    }
}

impl Method for AnyMethod {
    fn name(&self) -> &'static str {
        self.inner().name()
    }

    fn ask(&mut self, space: &SearchSpace, members: &mut Vec<Genome>) {
        self.inner_mut().ask(space, members);
    }

    fn tell(&mut self, space: &SearchSpace, members: &[Genome], scores: &[Score]) {
        self.inner_mut().tell(space, members, scores);
    }
}

/// Default bounds of a fit, tighter than [`Limits::default`]: room for every one of the fifteen
/// species (the weeping willow has 34,000 stems, 110,000 knots and 340,000 leaves), while no random
/// monster takes longer than a few willows or more than some 60 MB a thread.
pub const LIMITS: Limits = Limits { stems: 60_000, leaves: 500_000, knots: 300_000, ..Limits::DEFAULT };

/// Everything that decides how a fit runs; what it fits is a [`crate::FitProblem`].
#[derive(Clone, Debug, PartialEq)]
pub struct FitSettings {
    /// The optimiser and its settings.
    pub optimizer: Optimizer,
    /// When to stop.
    pub budget: Budget,
    /// Seed of the search.
    pub seed: u64,
    /// Seed of the tree: fixed, or searched.
    pub tree_seed: TreeSeed,
    /// Trees that each individual is judged by: see [`crate::Evaluator::over_seeds`].
    pub robust: NonZeroU32,
    /// What is made small.
    pub objective: Objective,
    /// Where the search starts.
    pub start: Start,
    /// Which parameters are free.
    pub freedom: Freedom,
    /// Bounds above which a tree counts as not growing.
    pub limits: Limits,
}

impl Default for FitSettings {
    /// The default optimiser from random lists, every parameter free, tree seed 1, no budget.
    fn default() -> Self {
        Self {
            optimizer: Optimizer::Evolution(EvolutionSettings::default()),
            budget: Budget::default(),
            seed: 1,
            tree_seed: TreeSeed::Fixed(1),
            robust: NonZeroU32::MIN,
            objective: Objective::default(),
            start: Start::default(),
            freedom: Freedom::default(),
            limits: LIMITS,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_and_others_are_told_which_there_are() {
        for name in Optimizer::NAMES {
            let optimizer: Optimizer = name.parse().unwrap();
            assert_eq!(optimizer.name(), name);
            assert_eq!(optimizer.method(1, Start::Random).name(), name);
        }
        assert_eq!(FitSettings::default().optimizer.name(), Optimizer::NAMES[0]);
        let message = "cmaes".parse::<Optimizer>().unwrap_err().to_string();
        assert!(message.starts_with("unknown optimizer `cmaes`, known are "), "{message}");
    }
}
