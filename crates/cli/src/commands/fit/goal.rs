//! What is said of the picture that is fitted to.

use crate::commands::advice;
use crate::commands::describe::{self, places};
use crate::output;
use pleach::GoalPair;
use pleach_silhouette::Goal;
use pleach_silhouette::goal::Split;
use std::path::Path;

/// Says what is to be watched out for in the goal at `path`, and what was found in it if `verbose`.
pub(super) fn say(path: &Path, goal: &GoalPair, verbose: bool) {
    if verbose {
        let (width, height) = goal.full.detection.original_size;
        let how = goal.mask.as_ref().map_or_else(|| means(&goal.full), describe::means);
        output::note(format!("goal of {width} × {height} pixels: {how}; {}", places(&goal.full)));
    }
    for warning in &goal.warnings {
        output::note(format!("warning: {}: {}", path.display(), advice::warning(warning)));
    }
}

/// How the tree was separated from the background.
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
