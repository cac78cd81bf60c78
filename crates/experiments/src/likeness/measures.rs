//! The measures that are compared, of a picture and a goal.

use pleach_silhouette::Bitmap;
use pleach_silhouette::score::likeness::{Descriptor, Scratch};
use pleach_silhouette::score::{Blurred, Likeness};

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

/// Blur of `blurred_iou`, as a part of the height.
const BLUR: f64 = 1.0 / 16.0;

/// A picture, and what the measures need to know of it.
#[derive(Clone)]
pub(super) struct Seen {
    pub(super) bitmap: Bitmap,
    descriptor: Descriptor,
    blurred: Blurred,
}

impl Seen {
    pub(super) fn new(bitmap: Bitmap) -> Self {
        Self {
            descriptor: Descriptor::new(&bitmap, &mut Scratch::default()),
            blurred: Blurred::new(&bitmap, BLUR * f64::from(bitmap.height())),
            bitmap,
        }
    }
}

/// Every measure of two pictures of one size; all are the same both ways.
pub(super) fn compare(a: &Seen, b: &Seen) -> Values {
    let likeness = a.descriptor.compare(&b.descriptor);
    let both = a.bitmap.intersection(&b.bitmap);
    let inks = a.bitmap.ink() + b.bitmap.ink();
    let share = |part: u64, whole: u64| if whole == 0 { 1.0 } else { part as f64 / whole as f64 };
    let mut values = [0.0; MEASURES.len()];
    values[..5].copy_from_slice(&[
        likeness.value(),
        share(both, inks - both),
        share(2 * both, inks),
        1.0 - share(inks - 2 * both, a.bitmap.area()),
        a.blurred.iou(&b.blurred),
    ]);
    for (i, part) in likeness.parts().into_iter().enumerate() {
        values[5 + i] = likeness.without(i);
        values[5 + Likeness::PARTS.len() + i] = part;
    }
    values
}
