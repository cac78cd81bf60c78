//! Where a fit starts that takes its volume from a picture: `--volume-from`.

use anyhow::Context;
use pleach_fit::{
    Azimuth, Candidate, FitSettings, GoalSettings, GoalView, Guessing, Judging, Start, check_freedom,
};
use pleach_least_cost_path::{SideView, species_around};
use pleach_silhouette::goal::{Goal, GoalOptions};
use pleach_silhouette::{Bitmap, Frame, View};
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

/// Rows that an outline is read in.
const ROWS: u32 = 48;
/// Views from higher or lower than this, in radians, show no outline by height.
const MAX_ELEVATION: f64 = 0.2;
/// Ink at each end of a row that is not counted, in permille: single twigs are no crown.
const STRAY: usize = 15;

impl Outlined {
    /// The start that `from` says for a tree of `height` meters with these `goals`.
    pub(super) fn new(from: &VolumeFrom, goals: &[GoalView], height: f64) -> anyhow::Result<Self> {
        let views = match from {
            VolumeFrom::Goal => {
                let is_known = |goal: &&GoalView| {
                    goal.unknown.azimuth == Azimuth::Known && goal.view.elevation.abs() <= MAX_ELEVATION
                };
                let side = |goal: &GoalView| side_view(&goal.goal, &goal.frame, &goal.view, height);
                goals.iter().filter(is_known).map(side).collect::<Vec<_>>()
            }
            VolumeFrom::File(file) => {
                let goal = Goal::load(file, &GoalOptions::default())?;
                vec![side_view(&goal.bitmap, &goal.frame(height), &View::FRONT, height)]
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
        Ok(GoalSettings { search, guess: Guessing::Off, candidates, judging: Some(Judging::default()) })
    }
}

/// What `bitmap` shows of a tree of `height` meters, row by row from the ground.
fn side_view(bitmap: &Bitmap, frame: &Frame, view: &View, height: f64) -> SideView {
    let row = |i: u32| {
        // A band of pixels, so that gaps between branches do not count.
        let pixel = |z: f64| frame.ground_row - z / frame.meters_per_pixel;
        let at = height * f64::from(i) / f64::from(ROWS - 1);
        let half = 0.5 * height / f64::from(ROWS - 1);
        let (top, bottom) =
            (pixel(at + half).floor().max(0.0) as u32, pixel(at - half).ceil().max(0.0) as u32);
        let rows = top..bottom.min(bitmap.height());
        let mut columns: Vec<u32> = rows.flat_map(|y| bitmap.ink_in_row(y)).collect();
        columns.sort_unstable();
        let stray = columns.len() * STRAY / 1000;
        let (first, last) = (columns.get(stray)?, columns.get(columns.len().checked_sub(stray + 1)?)?);
        let meters = |column: f64| (column - frame.axis_column) * frame.meters_per_pixel;
        Some([-meters(f64::from(*first)), meters(f64::from(*last) + 1.0)])
    };
    SideView { azimuth: view.azimuth, rows: (0..ROWS).map(row).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_measured_from_the_foot() {
        // A bar of 20 pixels to the right of the foot and 10 to the left, from row 20 to row 59.
        let bitmap = Bitmap::from_fn(100, 100, |x, y| (40..70).contains(&x) && (20..60).contains(&y));
        let frame =
            Frame { width: 100, height: 100, meters_per_pixel: 0.1, axis_column: 50.0, ground_row: 100.0 };
        let view = side_view(&bitmap, &frame, &View::FRONT, 8.0);
        assert_eq!(view.rows.len(), ROWS as usize);
        assert_eq!(view.rows[0], None, "nothing stands on the ground");
        let [left, right] = view.rows[35].unwrap();
        assert!((left - 1.0).abs() < 0.11 && (right - 2.0).abs() < 0.11, "{left} {right}");
    }
}
