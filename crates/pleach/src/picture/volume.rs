//! A start whose volume is the outline of a picture: `volume_from`.

use super::error::PrepareError;
use super::source::FitSource;
use super::words::VolumeFrom;
use crate::option_error::OptionError;
use pleach_fit::{Azimuth, Candidate, FitSettings, GoalSettings, GoalView, Guessing, Start, check_freedom};
use pleach_least_cost_path::{SideView, species_around};
use pleach_silhouette::{Bitmap, Frame, GoalOptions, View, outline};
use pleach_tree::Species;

/// A species in the outline of a picture, and the lists of numbers to start from.
#[derive(Clone, Debug)]
pub(super) struct Outlined {
    pub(super) species: Species,
    lists: Vec<Vec<f64>>,
}

/// Views from higher or lower than this, in radians, show no outline by height.
const MAX_ELEVATION: f64 = 0.2;

impl Outlined {
    /// The start that `from` says for a tree of `height` metres with these `goals`.
    pub(super) fn new(
        from: &VolumeFrom,
        source: &FitSource,
        goals: &[GoalView],
        height: f64,
    ) -> Result<Self, PrepareError> {
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
            VolumeFrom::Picture(name) => {
                let goal = source.picture(name).goal(&GoalOptions::default())?;
                vec![side(&goal.bitmap, &goal.frame(height), &View::FRONT)]
            }
        };
        let (species, lists) = species_around(&views, height).ok_or_else(|| {
            OptionError::new("volume_from", format!("is {from}, in which no outline is seen from the side"))
        })?;
        Ok(Self { species, lists })
    }

    /// The whole fit, with `search` from here.
    pub(super) fn plan(&self, search: FitSettings) -> Result<GoalSettings, PrepareError> {
        check_freedom(self.species.generator.space(), &search.freedom, search.tree_seed)?;
        let search = FitSettings { start: Start::Lists(self.lists.clone()), ..search };
        let candidates = vec![Candidate::from(self.species.clone())];
        Ok(GoalSettings { search, guess: Guessing::Off, ..GoalSettings::new(candidates) })
    }
}
