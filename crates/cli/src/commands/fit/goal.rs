//! The picture that is fitted to.

use super::{GoalArgs, options};
use crate::commands::describe::{self, cannot, places};
use crate::{input, output};
use anyhow::Context;
use pleach_silhouette::Bitmap;
use pleach_silhouette::goal::{Crop, Encoded, Goal, GoalOptions, GoalWarning, Polarity, Split};
use pleach_silhouette::mask::{Mask, MaskOptions, Photo};
use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// What says where in a picture the tree is.
#[derive(Clone, Debug)]
pub(super) enum MaskSource {
    /// A picture of the same size.
    File(PathBuf),
    /// The colours of the picture, a photograph.
    Auto,
}

impl FromStr for MaskSource {
    type Err = std::convert::Infallible;

    fn from_str(given: &str) -> Result<Self, Self::Err> {
        Ok(if given == "auto" { Self::Auto } else { Self::File(given.into()) })
    }
}

impl fmt::Display for MaskSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(file) => write!(f, "{}", file.display()),
            Self::Auto => f.write_str("auto"),
        }
    }
}

/// A goal as it was given, and as it is compared with.
pub(super) struct Goals {
    pub(super) full: Goal,
    pub(super) working: Goal,
    /// Of the tree, in metres.
    pub(super) height: f64,
    pub(super) name: String,
    /// What about the goal, or about its mask, is not as a fit expects; it has been told.
    pub(super) warnings: Vec<GoalWarning>,
    /// The mask that was made of a photograph.
    pub(super) mask: Option<Bitmap>,
    /// The picture as it came: standard input cannot be read twice.
    pub(super) source: Encoded,
}

impl Goals {
    /// Reads a goal, from standard input if it is `-`; tells what is to be watched out for, and what was
    /// found in it if `verbose`.
    pub(super) fn load(path: &Path, args: &GoalArgs, verbose: bool) -> anyhow::Result<Self> {
        let name = input::stem(path).unwrap_or_default().to_string_lossy().into_owned();
        let options = GoalOptions {
            mask: match &args.mask {
                Some(MaskSource::File(file)) => Some(file.clone()),
                Some(MaskSource::Auto) | None => None,
            },
            polarity: match args.tree {
                options::Tone::Auto => Polarity::Auto,
                options::Tone::Dark => Polarity::DarkTree,
                options::Tone::Light => Polarity::LightTree,
            },
            ground_row: args.frame.map_or(args.ground_row, |frame| Some(frame.ground_row)),
            axis_column: args.frame.map_or(args.axis_column, |frame| Some(frame.axis_column)),
            max_side: None,
            crop: Crop::ToTree,
        };
        let small = GoalOptions { max_side: Some(args.size), ..options.clone() };
        let source = input::picture(path)?;
        let (full, working, how, found) = if matches!(args.mask, Some(MaskSource::Auto)) {
            let found = Mask::from_photo(&Photo::from_encoded(&source)?, &MaskOptions::default())
                .with_context(|| cannot(path))?;
            let how = describe::means(&found);
            let full = Goal::from_ink(found.bitmap.clone(), &options)?;
            (full, Goal::from_ink(found.bitmap.clone(), &small)?, how, Some(found))
        } else {
            let full = Goal::from_encoded(&source, &options)?;
            let how = means(&full);
            (full, Goal::from_encoded(&source, &small)?, how, None)
        };
        let (warnings, mask) = match found {
            Some(found) => (found.warnings, Some(found.bitmap)),
            None => (full.warnings.clone(), None),
        };
        let height = match args.frame {
            Some(frame) => frame.meters_per_pixel * full.height_in_pixels(),
            None => args.height,
        };
        if verbose {
            let (width, height) = full.detection.original_size;
            output::note(format!("goal of {width} × {height} pixels: {how}; {}", places(&full)));
        }
        for warning in &warnings {
            output::note(format!("warning: {}: {warning}", path.display()));
        }
        Ok(Self { full, working, height, name, warnings, mask, source })
    }
}

/// How the tree was told from the paper.
fn means(goal: &Goal) -> String {
    let how = match goal.detection.split {
        Split::Opacity => "the tree is what is opaque".to_owned(),
        Split::Brightness { threshold, dark_tree } => {
            let side = if dark_tree { "up to" } else { "above" };
            format!("the tree is what is {side} brightness {threshold} of 255")
        }
        Split::Color => "the tree is what differs from the paper around it".to_owned(),
        Split::None => "the picture has one bit per pixel".to_owned(),
    };
    how + if goal.detection.masked { ", in the mask" } else { "" }
}
