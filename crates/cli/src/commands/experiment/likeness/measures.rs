//! The measures that are compared, of a picture and a goal.

use pleach_silhouette::Bitmap;
use pleach_silhouette::score::{Likeness, blurred_iou};

/// Names of the measures; likeness first, then the others, then likeness without each part, then each
/// part alone.
pub(super) const MEASURES: [&str; 13] = [
    "likeness",
    "iou",
    "dice",
    "pixel_accuracy",
    "blurred_iou",
    "without mass",
    "without rim",
    "without strokes",
    "without gaps",
    "mass",
    "rim",
    "strokes",
    "gaps",
];

/// A value for each of [`MEASURES`], each in 0..=1 and 1 for equal pictures.
pub(super) type Values = [f64; MEASURES.len()];

/// Every measure of two pictures of one size. `blurred_iou` is blurred by 1/16 of the height.
pub(super) fn of(a: &Bitmap, b: &Bitmap) -> Values {
    let likeness = Likeness::of(a, b);
    let both = a.intersection(b);
    let inks = a.ink() + b.ink();
    let share = |part: u64, whole: u64| if whole == 0 { 1.0 } else { part as f64 / whole as f64 };
    let mut values = [0.0; MEASURES.len()];
    values[..5].copy_from_slice(&[
        likeness.value(),
        share(both, inks - both),
        share(2 * both, inks),
        1.0 - share(a.differing(b), a.area()),
        blurred_iou(a, b, f64::from(a.height()) / 16.0),
    ]);
    for (i, part) in likeness.parts().into_iter().enumerate() {
        values[5 + i] = likeness.without(i);
        values[5 + Likeness::PARTS.len() + i] = part;
    }
    values
}
