//! What the library says is odd about a picture, with what this program has for it.

use pleach_silhouette::goal::GoalWarning;
use pleach_silhouette::mask::MaskError;

/// A warning, with the options that help.
pub(super) fn warning(warning: &GoalWarning) -> String {
    match options(warning) {
        Some(options) => format!("{warning}; {options}"),
        None => warning.to_string(),
    }
}

const fn options(warning: &GoalWarning) -> Option<&'static str> {
    Some(match warning {
        GoalWarning::Photograph => {
            "--mask auto finds the tree by its colour, and --mask FILE takes a mask of your own"
        }
        GoalWarning::ByColor { .. } => {
            "`pleach mask --background plain` shows that mask, and `pleach fit --tree dark` or `--tree light` splits \
             by brightness all the same"
        }
        GoalWarning::SeveralPieces { .. } => "`pleach mask --seed-point X,Y` takes the piece at a point",
        GoalWarning::Ground { .. } => {
            "crop the picture there, or paint the strip in the colour of the background"
        }
        GoalWarning::Solid { .. } | GoalWarning::MostlyInk { .. } => {
            "`pleach fit` has --tree dark and --tree light"
        }
        GoalWarning::DoubtfulMask { .. } => {
            "`pleach mask PHOTO -o mask.png --overlay look.png` shows it, and --box, --seed-point and --background say \
             where the tree is"
        }
        _ => return None,
    })
}

/// An error of a mask, with the options that help.
pub(super) fn mask_error(error: MaskError) -> anyhow::Error {
    match error {
        MaskError::NoTree { .. } => {
            anyhow::anyhow!("{error}. --box, --background and --seed-point say where it is")
        }
        _ => error.into(),
    }
}
