//! Options that are one word, or a word or something else.

use serde::{Deserialize, Serialize};
use std::convert::Infallible;
use std::fmt;
use std::str::FromStr;

/// Whether the fitted tree has leaves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Leaves {
    /// As the goal looks, where the fit starts from a first guess; from a species as its file says; otherwise it has.
    #[default]
    Auto,
    /// It has.
    On,
    /// It is bare.
    Off,
}

/// Where the colours and the season of a result come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum AppearanceFrom {
    /// From the goal's picture, where it has colours; what cannot be read in it from the species.
    #[default]
    Picture,
    /// From the species that the goal looks like, or that the fit started from.
    Species,
}

/// Which tone of a picture is the tree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Tone {
    /// Whichever does not fill the border.
    #[default]
    Auto,
    /// The darker one.
    Dark,
    /// The lighter one.
    Light,
}

/// Where the search starts: `auto`, `random`, or a species.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum StartFrom {
    /// The known species that the goal looks like.
    #[default]
    Auto,
    /// Random parameter lists.
    Random,
    /// A species: that of [`super::FitSource::start`] if there is one, or else a known name or a file.
    Species(String),
}

impl FromStr for StartFrom {
    type Err = Infallible;

    fn from_str(given: &str) -> Result<Self, Self::Err> {
        Ok(match given {
            "auto" => Self::Auto,
            "random" => Self::Random,
            species => Self::Species(species.to_owned()),
        })
    }
}

impl fmt::Display for StartFrom {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Auto => "auto",
            Self::Random => "random",
            Self::Species(name) => name,
        })
    }
}

/// What says where in the goal the tree is: `auto`, or a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MaskFrom {
    /// The goal is a photograph: its colours say it, see [`crate::Mask`].
    Auto,
    /// A file of a picture of the goal's size or shape: white on black.
    File(String),
}

impl FromStr for MaskFrom {
    type Err = Infallible;

    fn from_str(given: &str) -> Result<Self, Self::Err> {
        Ok(if given == "auto" { Self::Auto } else { Self::File(given.to_owned()) })
    }
}

impl fmt::Display for MaskFrom {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Auto => "auto",
            Self::File(file) => file,
        })
    }
}

/// The picture in whose outline a tree of least-cost paths starts: `goal`, or another one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum VolumeFrom {
    /// The goal, with its further pictures from known directions.
    Goal,
    /// Another picture, taken from the front: its name in [`super::FitSource::pictures`], or a file.
    Picture(String),
}

impl FromStr for VolumeFrom {
    type Err = Infallible;

    fn from_str(given: &str) -> Result<Self, Self::Err> {
        Ok(if given == "goal" { Self::Goal } else { Self::Picture(given.to_owned()) })
    }
}

impl fmt::Display for VolumeFrom {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Goal => "goal",
            Self::Picture(name) => name,
        })
    }
}

/// Scale and place of a tree in its picture, where they are known; in JSON an array of three numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "(f64, f64, f64)", into = "(f64, f64, f64)")]
pub struct KnownFrame {
    /// Metres per pixel, above 0.
    pub meters_per_pixel: f64,
    /// Column of the trunk's foot, in pixels of the file from its left edge.
    pub axis_column: f64,
    /// Row of the ground, in pixels of the file from its top edge.
    pub ground_row: f64,
}

impl From<(f64, f64, f64)> for KnownFrame {
    fn from((meters_per_pixel, axis_column, ground_row): (f64, f64, f64)) -> Self {
        Self { meters_per_pixel, axis_column, ground_row }
    }
}

impl From<KnownFrame> for (f64, f64, f64) {
    fn from(frame: KnownFrame) -> Self {
        (frame.meters_per_pixel, frame.axis_column, frame.ground_row)
    }
}
