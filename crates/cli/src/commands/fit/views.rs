//! Further pictures of the goal's tree: to fit, and to be held out.

use crate::input;
use pleach_fit::GoalView;
use pleach_silhouette::goal::{Goal, GoalOptions};
use pleach_silhouette::score::ScoreCard;
use pleach_silhouette::{Bitmap, Rasteriser, View};
use pleach_tree::Tree;
use serde::Serialize;
use std::path::PathBuf;
use std::str::FromStr;

/// `AZ[,EL]`, or `AZ[,EL]=FILE`.
#[derive(Clone, Debug)]
pub(super) struct Direction {
    view: View,
    file: Option<PathBuf>,
}

/// `AZ[,EL]=FILE`: a picture and from where it was taken.
#[derive(Clone, Debug)]
pub(super) struct Picture {
    view: View,
    file: PathBuf,
}

impl FromStr for Direction {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (direction, file) = match text.split_once('=') {
            Some((direction, file)) if !file.is_empty() => (direction, Some(PathBuf::from(file))),
            Some(_) => return Err("expected a file after `=`".to_owned()),
            None => (text, None),
        };
        Ok(Self { view: input::view(direction)?, file })
    }
}

impl FromStr for Picture {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let Direction { view, file } = text.parse()?;
        let file = file.ok_or("expected a direction and a picture, such as 90=side.png")?;
        Ok(Self { view, file })
    }
}

/// The direction of the goal itself, and the further pictures, of what `--view` said.
pub(super) fn sort(directions: &[Direction]) -> anyhow::Result<(View, Vec<Picture>)> {
    let mut own = directions.iter().filter(|direction| direction.file.is_none());
    let goal = own.next().map_or(View::FRONT, |direction| direction.view);
    if own.next().is_some() {
        anyhow::bail!("the goal was taken from one direction: further ones need a picture, --view AZ=FILE");
    }
    let further = directions
        .iter()
        .filter_map(|direction| Some(Picture { view: direction.view, file: direction.file.clone()? }));
    Ok((goal, further.collect()))
}

/// How the result does in one of the further pictures, in `summary.json`.
#[derive(Debug, Serialize)]
pub(super) struct ViewScore {
    file: PathBuf,
    azimuth: f64,
    elevation: f64,
    iou: f64,
    best_ellipse_iou: f64,
    likeness: f64,
}

impl Picture {
    /// Reads the picture, reduced to `most` pixels a side, of a tree of `height` metres.
    pub(super) fn goal_view(&self, height: f64, most: u32) -> anyhow::Result<GoalView> {
        let options = GoalOptions { max_side: Some(most), ..GoalOptions::default() };
        let goal = Goal::load(&self.file, &options)?;
        Ok(GoalView { frame: goal.frame(height), goal: goal.bitmap, view: self.view })
    }

    /// Scores `tree` against the picture.
    pub(super) fn score(&self, tree: &Tree, foliage: bool, height: f64) -> anyhow::Result<ViewScore> {
        let goal = Goal::load(&self.file, &GoalOptions::default())?;
        let mut bitmap = Bitmap::default();
        Rasteriser::new().draw(tree, &self.view, &goal.frame(height), foliage, &mut bitmap);
        let card = ScoreCard::of(&bitmap, &goal.bitmap)?;
        Ok(ViewScore {
            file: self.file.clone(),
            azimuth: self.view.azimuth.to_degrees(),
            elevation: self.view.elevation.to_degrees(),
            iou: card.iou,
            best_ellipse_iou: card.best_ellipse_iou,
            likeness: card.likeness,
        })
    }
}

impl ViewScore {
    /// A line of the report.
    pub(super) fn line(&self, what: &str) -> String {
        format!(
            "{what} {}: likeness {:.3}, IoU {:.3} (best single ellipse {:.3})\n",
            self.file.display(),
            self.likeness,
            self.iou,
            self.best_ellipse_iou
        )
    }
}
