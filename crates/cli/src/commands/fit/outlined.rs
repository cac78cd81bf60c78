//! Where a fit starts that takes its volume from a picture: `--volume-from`.

use anyhow::Context;
use pleach_fit::{Azimuth, Candidate, FitSettings, GoalSettings, GoalView, Guessing, Start, check_freedom};
use pleach_least_cost_path::{SideView, species_around};
use pleach_silhouette::goal::{Goal, GoalOptions};
use pleach_silhouette::{Bitmap, Frame, View, outline};
use pleach_tree::Species;
use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

/// The picture whose outline is taken.
#[derive(Clone, Debug)]
pub(super) enum VolumeFrom {
    /// The goal itself, and its further pictures from known directions.
    Goal,
    /// Another picture, seen from the front.
    File(PathBuf),
}

impl FromStr for VolumeFrom {
    type Err = std::convert::Infallible;

    fn from_str(given: &str) -> Result<Self, Self::Err> {
        Ok(if given == "goal" { Self::Goal } else { Self::File(given.into()) })
    }
}

impl fmt::Display for VolumeFrom {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Goal => f.write_str("goal"),
            Self::File(file) => write!(f, "{}", file.display()),
        }
    }
}

/// A species in the outline of a picture, and the lists of numbers to start from.
#[derive(Clone, Debug)]
pub(super) struct Outlined {
    pub(super) species: Species,
    lists: Vec<Vec<f64>>,
}

/// Views from higher or lower than this, in radians, show no outline by height.
const MAX_ELEVATION: f64 = 0.2;

impl Outlined {
    /// The start that `from` says for a tree of `height` meters with these `goals`.
    pub(super) fn new(from: &VolumeFrom, goals: &[GoalView], height: f64) -> anyhow::Result<Self> {
        let side = |bitmap: &Bitmap, frame: &Frame, view: &View| SideView {
            azimuth: view.azimuth,
            rows: outline(bitmap, frame, height),
        };
        let views = match from {
            VolumeFrom::Goal => {
                let is_known = |goal: &&GoalView| {
                    goal.unknown.azimuth == Azimuth::Known && goal.view.elevation.abs() <= MAX_ELEVATION
                };
                let of_goal = |goal: &GoalView| side(&goal.goal, &goal.frame, &goal.view);
                goals.iter().filter(is_known).map(of_goal).collect::<Vec<_>>()
            }
            VolumeFrom::File(file) => {
                let goal = Goal::load(file, &GoalOptions::default())?;
                vec![side(&goal.bitmap, &goal.frame(height), &View::FRONT)]
            }
        };
        let (species, lists) = species_around(&views, height)
            .context("--volume-from: no outline is seen from the side in it")?;
        Ok(Self { species, lists })
    }

    /// The whole fit, with `search` from here.
    pub(super) fn plan(&self, search: &FitSettings) -> anyhow::Result<GoalSettings> {
        check_freedom(self.species.generator.space(), &search.freedom, search.tree_seed)?;
        let search = FitSettings { start: Start::Lists(self.lists.clone()), ..search.clone() };
        let candidates = vec![Candidate::from(self.species.clone())];
        Ok(GoalSettings { search, guess: Guessing::Off, ..GoalSettings::new(candidates) })
    }
}
