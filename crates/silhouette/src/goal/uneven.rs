//! A second look at pictures in which brightness finds a doubtful tree: drawings on paper in uneven light.

use super::ink::{Polarity, Split};
use super::source::Encoded;
use super::warning::GoalWarning;
use super::{Goal, GoalOptions};
use crate::mask::{Background, Mask, MaskOptions, Photo};

/// What differs from the paper is taken for the tree if its mask is at least this likely a good one.
const CONFIDENT: f64 = 0.7;

/// The goal as a photograph before one smooth background, if what was found by brightness is doubtful and
/// that is less so. Photographs are left to `--mask auto`, which tries more.
pub(super) fn by_color(source: &Encoded, goal: &Goal, options: &GoalOptions) -> Option<Goal> {
    let is_choice = options.mask.is_some() || options.polarity != Polarity::Auto;
    let doubts = doubts(&goal.warnings);
    if is_choice
        || !matches!(goal.detection.split, Split::Brightness { .. })
        || goal.warnings.contains(&GoalWarning::Photograph)
        || doubts == 0
    {
        return None;
    }
    let photo = Photo::from_encoded(source).ok()?;
    let plain = MaskOptions { background: Background::Plain, ..MaskOptions::default() };
    let mask = Mask::from_photo(&photo, &plain).ok()?;
    if mask.confidence < CONFIDENT || self::doubts(&mask.warnings) >= doubts {
        return None;
    }
    let confidence = mask.confidence;
    let mut found = Goal::from_ink(mask.bitmap, options).ok()?;
    found.detection.split = Split::Color;
    let mut warnings = mask.warnings;
    let at = warnings.iter().take_while(|w| comes_first(w)).count();
    warnings.insert(at, GoalWarning::ByColor { confidence });
    found.warnings = warnings;
    Some(found)
}

/// How many warnings speak against the ink rather than against the picture.
fn doubts(warnings: &[GoalWarning]) -> usize {
    use GoalWarning::{MostlyInk, Noise, Solid, TouchesFrame};
    let is_doubt =
        |w: &&GoalWarning| matches!(w, Noise { .. } | MostlyInk { .. } | Solid { .. } | TouchesFrame(_));
    warnings.iter().filter(is_doubt).count()
}

const fn comes_first(warning: &GoalWarning) -> bool {
    use GoalWarning::{AlphaIgnored, Frame, SeveralPictures, TransparentTree};
    matches!(warning, SeveralPictures | Frame(_) | AlphaIgnored { .. } | TransparentTree)
}
