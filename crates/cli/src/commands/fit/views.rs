//! Further pictures of the goal's tree: to fit, and to be held out.

use crate::input;
use pleach_fit::{Azimuth, GoalView, Placement, ROUGH_AZIMUTH, Unknown};
use pleach_silhouette::goal::{Crop, Goal, GoalOptions};
use pleach_silhouette::picture::{self, Picture as Overlay};
use pleach_silhouette::score::ScoreCard;
use pleach_silhouette::{Bitmap, Rasterizer, View};
use pleach_tree::{Foliage, Tree};
use serde::Serialize;
use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

/// `AZ[,EL]`, or a further picture: `AZ[,EL]=FILE`, `~AZ[,EL]=FILE` or `auto=FILE`.
#[derive(Clone, Debug)]
pub(super) enum Direction {
    /// That of the goal itself.
    Own(View),
    /// That of another picture.
    Further(Picture),
}

/// A picture and from where it was taken, so far as that is known.
#[derive(Clone, Debug)]
pub(super) struct Picture {
    view: View,
    azimuth: Azimuth,
    file: PathBuf,
}

/// A [`Picture`] whose direction is known.
#[derive(Clone, Debug)]
pub(super) struct KnownPicture(Picture);

impl FromStr for Direction {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (direction, file) = match text.split_once('=') {
            Some((direction, file)) if !file.is_empty() => (direction, Some(PathBuf::from(file))),
            Some(_) => return Err("expected a file after `=`".to_owned()),
            None => (text, None),
        };
        let (view, azimuth) = match (direction, direction.strip_prefix('~')) {
            ("auto", _) => (View::FRONT, Azimuth::Any),
            (_, Some(about)) => (input::view(about)?, Azimuth::Within(ROUGH_AZIMUTH)),
            _ => {
                (input::view(direction).map_err(|e| format!("{e}; or auto=FILE, ~AZ=FILE"))?, Azimuth::Known)
            }
        };
        match file {
            Some(file) => Ok(Self::Further(Picture { view, azimuth, file })),
            None if azimuth == Azimuth::Known => Ok(Self::Own(view)),
            None => Err("azimuths are counted from the goal's, which is known: expected a further picture, \
                         such as auto=side.png"
                .to_owned()),
        }
    }
}

impl Direction {
    /// The file of a further picture.
    pub(super) fn file(&self) -> Option<PathBuf> {
        match self {
            Self::Own(_) => None,
            Self::Further(picture) => Some(picture.file.clone()),
        }
    }
}

/// As it may be given, in degrees.
impl fmt::Display for Direction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (view, azimuth, file) = match self {
            Self::Own(view) => (view, Azimuth::Known, None),
            Self::Further(picture) => (&picture.view, picture.azimuth, Some(&picture.file)),
        };
        let (about, elevation) = (view.azimuth.to_degrees(), view.elevation.to_degrees());
        match azimuth {
            Azimuth::Any => write!(f, "auto")?,
            Azimuth::Within(_) => write!(f, "~{about},{elevation}")?,
            Azimuth::Known => write!(f, "{about},{elevation}")?,
        }
        file.map_or(Ok(()), |file| write!(f, "={}", file.display()))
    }
}

/// As it may be given, in degrees.
impl fmt::Display for KnownPicture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Direction::Further(self.0.clone()).fmt(f)
    }
}

impl FromStr for KnownPicture {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text.parse()? {
            Direction::Further(picture) if picture.azimuth == Azimuth::Known => Ok(Self(picture)),
            Direction::Further(_) => Err("a picture that is not fitted needs a known direction, such as \
                                          90=side.png"
                .to_owned()),
            Direction::Own(_) => Err("expected a direction and a picture, such as 90=side.png".to_owned()),
        }
    }
}

/// The direction of the goal itself, and the further pictures, of what `--view` said.
pub(super) fn sort(directions: &[Direction]) -> anyhow::Result<(View, Vec<&Picture>)> {
    let mut own = None;
    let mut further = Vec::new();
    for direction in directions {
        match direction {
            Direction::Own(_) if own.is_some() => anyhow::bail!(
                "the goal was taken from one direction: further ones need a picture, --view AZ=FILE"
            ),
            Direction::Own(view) => own = Some(*view),
            Direction::Further(picture) => further.push(picture),
        }
    }
    Ok((own.unwrap_or(View::FRONT), further))
}

/// What of a view was searched.
#[derive(Clone, Copy, Debug)]
struct Found {
    azimuth: bool,
    frame: bool,
}

/// From which scale and offset on a report says them.
const WORTH_SAYING: f64 = 0.02;

/// How the result does in one of the further pictures, in `summary.json`.
#[derive(Debug, Serialize)]
pub(super) struct ViewScore {
    file: PathBuf,
    azimuth: f64,
    elevation: f64,
    /// Factor on the metres that a pixel of the picture is wide, as found.
    scale: f64,
    /// How far the trunk's foot is to the right of where the picture says, in its widths, and below
    /// it, in its heights, as found.
    offset: [f64; 2],
    /// Whether azimuth, scale and offset were searched.
    #[serde(skip)]
    found: Found,
    iou: f64,
    best_ellipse_iou: f64,
    likeness: f64,
}

impl Picture {
    /// Reads the picture, reduced to at most `most` pixels on each side, of a tree of `height` metres.
    pub(super) fn goal_view(&self, height: f64, most: u32, free_frame: bool) -> anyhow::Result<GoalView> {
        let options = GoalOptions { max_side: Some(most), crop: Crop::ToTree, ..GoalOptions::default() };
        let goal = Goal::load(&self.file, &options)?;
        let unknown = Unknown { azimuth: self.azimuth, frame: free_frame };
        let frame = goal.frame(height);
        Ok(GoalView { unknown, ..GoalView::from_picture(goal.bitmap, self.view, frame) })
    }

    /// Scores `tree` against the picture, which is placed as was found; with the tree drawn over it.
    pub(super) fn score(
        &self,
        tree: &Tree,
        foliage: Foliage,
        height: f64,
        placement: &Placement,
    ) -> anyhow::Result<(ViewScore, Overlay)> {
        let options = GoalOptions { crop: Crop::ToTree, ..GoalOptions::default() };
        let goal = Goal::load(&self.file, &options)?;
        let mut bitmap = Bitmap::default();
        let (view, frame) = (placement.view(&self.view), placement.frame(&goal.frame(height)));
        Rasterizer::new().draw(tree, &view, &frame, foliage.into(), &mut bitmap);
        let card = ScoreCard::new(&bitmap, &goal.bitmap)?;
        let overlay = picture::overlay(&bitmap, &goal.bitmap);
        let score = ViewScore {
            file: self.file.clone(),
            // As it was found: to radians and back would be another number.
            azimuth: placement.azimuth.unwrap_or_else(|| view.azimuth.to_degrees()),
            elevation: view.elevation.to_degrees(),
            scale: placement.scale,
            offset: placement.offset,
            found: Found {
                azimuth: placement.azimuth.is_some(),
                // What is registered is within some pixels, and of no interest.
                frame: (placement.scale - 1.0).abs() > WORTH_SAYING
                    || placement.offset.iter().any(|part| part.abs() > WORTH_SAYING),
            },
            iou: card.iou,
            best_ellipse_iou: card.best_ellipse_iou,
            likeness: card.likeness,
        };
        Ok((score, overlay))
    }
}

impl KnownPicture {
    pub(super) fn file(&self) -> PathBuf {
        self.0.file.clone()
    }

    /// Tells whether the picture can be read.
    pub(super) fn check(&self, height: f64, most: u32) -> anyhow::Result<()> {
        self.0.goal_view(height, most, false).map(|_| ())
    }

    /// Scores `tree` against the picture; with the tree drawn over it.
    pub(super) fn score(
        &self,
        tree: &Tree,
        foliage: Foliage,
        height: f64,
    ) -> anyhow::Result<(ViewScore, Overlay)> {
        self.0.score(tree, foliage, height, &Placement::KNOWN)
    }
}

impl ViewScore {
    /// A line of the report.
    pub(super) fn line(&self, what: &str) -> String {
        let mut placed = String::new();
        if self.found.azimuth {
            placed += &format!(", from {:.1}°", self.azimuth);
        }
        if self.found.frame {
            let [right, down] = self.offset.map(|part| 100.0 * part);
            placed += &format!(", scale {:.3}, {right:+.1} % right, {down:+.1} % down", self.scale);
        }
        format!(
            "{what} {}: likeness {:.3}, IoU {:.3} (best single ellipse {:.3}){placed}\n",
            self.file.display(),
            self.likeness,
            self.iou,
            self.best_ellipse_iou
        )
    }
}
