//! Descriptions of goals and masks, in the same words for `fit` and `mask`.

use pleach_silhouette::goal::{Goal, Origin};
use pleach_silhouette::mask::{Mask, Segmentation};
use std::path::Path;

/// How much is tree, and where it stands.
pub(super) fn places(goal: &Goal) -> String {
    let origin = |origin: Origin| match origin {
        Origin::Detected => "detected",
        Origin::Snapped => "detected and snapped to the picture's edge or middle",
        Origin::Given => "given",
    };
    // Of the file, whatever part of it is compared.
    let frame = goal.original_frame(&goal.frame(1.0));
    let top_row = frame.ground_row - 1.0 / frame.meters_per_pixel;
    let ink = 100.0 * goal.bitmap.ink() as f64 / goal.bitmap.area() as f64;
    format!(
        "{ink:.1} % ink\nground at row {:.1} ({}), trunk at column {:.1} ({}), top at row {:.1}",
        frame.ground_row,
        origin(goal.detection.ground),
        frame.axis_column,
        origin(goal.detection.axis),
        top_row,
    )
}

/// What could not be done.
pub(super) fn cannot(photo: &Path) -> String {
    format!("cannot make a mask of {}", photo.display())
}

/// How the tree was separated from the background.
pub(super) fn means(mask: &Mask) -> String {
    match mask.segmentation {
        Segmentation::Opacity => "the picture has an alpha channel: the tree is what is opaque".to_owned(),
        Segmentation::TwoTones => {
            "the picture has two tones: the tree is the one that its edge does not have".to_owned()
        }
        Segmentation::Colors => format!(
            "the tree is what has other colours than the picture's edges\n\
             {} other pixels dropped, {} in small holes filled",
            mask.dropped, mask.filled
        ),
        Segmentation::Cut { region } => format!(
            "the tree is what a graph cut finds in the box of {} × {} pixels at {},{}\n\
             {} other pixels dropped, {} in small holes filled",
            region.width, region.height, region.x, region.y, mask.dropped, mask.filled
        ),
        Segmentation::Color { threshold, horizon } => {
            let behind = horizon.map_or_else(
                || "one background".to_owned(),
                |h| format!("sky down to row {:.0}, ground below", (h.left + h.right) / 2.0),
            );
            format!(
                "{behind}; the tree is what is more than {threshold:.1} spreads away in colour\n\
                 {} other pixels dropped, {} in small holes filled",
                mask.dropped, mask.filled
            )
        }
    }
}
