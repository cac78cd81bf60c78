//! What is said and written of further pictures of the goal's tree.

use super::drawing::write_overlay;
use super::run_folder::Claim;
use pleach::{FurtherPicture, ViewReport};

/// From which scale and offset on a report says them: what is registered is within some pixels, and of no interest.
const WORTH_SAYING: f64 = 0.02;

/// A line of the report on a picture; `what` says whether it was fitted.
pub(super) fn line(what: &str, view: &ViewReport) -> String {
    let mut placed = String::new();
    if view.azimuth_found {
        placed += &format!(", from {:.1}°", view.azimuth);
    }
    if (view.scale - 1.0).abs() > WORTH_SAYING || view.offset.iter().any(|part| part.abs() > WORTH_SAYING) {
        let [right, down] = view.offset.map(|part| 100.0 * part);
        placed += &format!(", scale {:.3}, {right:+.1} % right, {down:+.1} % down", view.scale);
    }
    format!(
        "{what} {}: likeness {:.3}, IoU {:.3} (best single ellipse {:.3}){placed}\n",
        view.file, view.scores.likeness, view.scores.iou, view.scores.best_ellipse_iou
    )
}

/// Writes what was fitted over each picture as `NAME-1.png`, `NAME-2.png` …
pub(super) fn write_overlays(
    claim: &Claim,
    name: &str,
    pictures: &[FurtherPicture],
    views: &[ViewReport],
) -> anyhow::Result<()> {
    for (number, (picture, view)) in pictures.iter().zip(views).enumerate() {
        let file = claim.file(&format!("{name}-{}.png", number + 1));
        write_overlay(&file, &view.silhouette, &picture.goal.full.bitmap)?;
    }
    Ok(())
}
