//! Where a fit starts: random lists, a species, or whatever the goal looks like.

use crate::{input, output};
use anyhow::Context;
use indicatif::{ProgressBar, ProgressStyle};
use pleach_fit::{Candidate, FitProblem, FitSettings, GuessLibrary, GuessSettings, References, Start};
use pleach_tree::Species;
use pleach_tree::species::Appearance;
use serde::Serialize;
use std::str::FromStr;
use std::sync::atomic::AtomicBool;

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
    /// Whether leaves are grown unless the goal says otherwise.
    pub(super) const fn are_expected(self) -> bool {
        !matches!(self, Self::Off)
    }
}

/// What is known once a fit has begun.
#[derive(Default)]
pub(super) struct Begun {
    /// What the goal looks like, if that was asked for.
    pub(super) looks_like: Vec<LooksLike>,
    /// What its likeness stands beside, if the guess has told.
    pub(super) references: Option<References>,
    /// Whether it was looked at whether the goal has leaves.
    pub(super) leaves_detected: bool,
}

/// Species with less confidence than this are not spoken of.
const MIN_CONFIDENCE: f64 = 0.01;

impl From {
    /// The species whose generator is fitted, and whose values fixed parameters keep unless a guess
    /// has better ones.
    pub(super) fn species(&self) -> anyhow::Result<Species> {
        match self {
            Self::Species(name) => Ok(input::species(name)?),
            Self::Auto | Self::Random => {
                pleach_generators::preset("quaking_aspen").context("the default species is built in")
            }
        }
    }

    /// Colours and season of the species that is fitted: the given one, or the one that the goal looks
    /// like.
    pub(super) fn appearance(&self, looks_like: &[LooksLike]) -> anyhow::Result<Appearance> {
        let name = match (self, looks_like.first()) {
            (Self::Species(name), _) => name,
            (_, Some(first)) => &first.species,
            (Self::Auto | Self::Random, None) => return Ok(Appearance::default()),
        };
        Ok(input::species(name)?.appearance)
    }

    /// Sets where the search begins, and whether leaves are grown if that is to be seen in the goal;
    /// says unless `quiet` what the goal looks like.
    pub(super) fn begin(
        &self,
        quiet: bool,
        leaves: Leaves,
        (problem, settings): (&mut FitProblem, &mut FitSettings),
        library: &mut GuessLibrary,
        stop: &AtomicBool,
    ) -> anyhow::Result<Begun> {
        match self {
            Self::Random => settings.start = Start::Random,
            Self::Species(_) => settings.start = Start::Lists(vec![problem.base.clone()]),
            Self::Auto => return guess(quiet, leaves, problem, settings, library, stop),
        }
        Ok(Begun::default())
    }
}

fn guess(
    quiet: bool,
    leaves: Leaves,
    problem: &mut FitProblem,
    settings: &mut FitSettings,
    library: &mut GuessLibrary,
    stop: &AtomicBool,
) -> anyhow::Result<Begun> {
    let bar = if output::is_watched() { ProgressBar::new(1) } else { ProgressBar::hidden() };
    if let Ok(style) = ProgressStyle::with_template("first guess {wide_bar} {pos} of {len} trees") {
        bar.set_style(style);
    }
    let progress = |done, all| {
        bar.set_length(all as u64);
        bar.set_position(done as u64);
    };
    let leaves_detected = leaves == Leaves::Auto;
    let how = GuessSettings { detect_leaves: leaves_detected, ..GuessSettings::default() };
    let guess = library.first_guess(problem, settings, &candidates(problem), &how, stop, progress)?;
    bar.finish_and_clear();
    let mut names = guess.names;
    names.retain(|(_, confidence)| *confidence >= MIN_CONFIDENCE);
    if !quiet {
        let said: Vec<String> =
            names.iter().take(3).map(|(name, c)| format!("{name} ({:.0} %)", 100.0 * c)).collect();
        let bare = if leaves_detected && !guess.foliage {
            ": a bare tree, so no leaves are grown (--leaves on grows them)"
        } else {
            ""
        };
        output::note(format!("looks like {}{bare}", said.join(", ")));
    }
    problem.foliage = guess.foliage;
    problem.base = guess.nearest[0].values.clone();
    settings.start = Start::Lists(guess.nearest.into_iter().map(|guess| guess.values).collect());
    let looks_like =
        names.into_iter().map(|(species, confidence)| LooksLike { species, confidence }).collect();
    Ok(Begun { looks_like, references: Some(guess.references), leaves_detected })
}

/// The known species that the problem's generator grows.
pub(super) fn candidates(problem: &FitProblem) -> Vec<Candidate> {
    let species = pleach_generators::names().into_iter().filter_map(pleach_generators::preset);
    species
        .filter(|s| s.generator.family() == problem.generator.family() && s.generator.structure().is_empty())
        .map(|s| Candidate { name: s.name.clone(), values: s.params.values().to_vec() })
        .collect()
}
