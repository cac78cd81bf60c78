//! Boxes for a graph cut where nobody drags one.

use super::photo::Photo;
use super::pixel_box::PixelBox;
use crate::bitmap::Bitmap;

/// The middle of a picture is all but this part of each of its sides.
const MARGIN: f64 = 0.06;
/// A box around a doubtful mask is wider than that by this part of the picture's longer side.
const WIDER: f64 = 0.04;
/// Masks whose box is less than this part of the picture are no hint.
const MIN_PART: f64 = 0.05;

/// Of the evidence for a mask from a guessed box, this part is reported where the colours alone show a tree, too, with
/// a confidence of [`CLEAR`] or more.
const SEEN: f64 = 0.65;
const CLEAR: f64 = 0.5;
/// Where they show one less clearly, no more than this part of their confidence is reported, and this part of the
/// evidence is what the mask is chosen by: it is doubtful, but other doubtful masks may be worse.
const UNCLEAR: f64 = 0.6;
const UNSEEN: f64 = 0.28;
/// Width of a box's rim, as a part of its longer side.
const RIM: f64 = 0.005;

/// What people put their tree into.
pub(super) fn middle(photo: &Photo) -> PixelBox {
    let gap = |side: u32| (MARGIN * f64::from(side)) as u32;
    let (x, y) = (gap(photo.width()), gap(photo.height()));
    PixelBox { x, y, width: photo.width() - 2 * x, height: photo.height() - 2 * y }
}

/// A box around a mask that may have lost a part of the tree.
pub(super) fn around(ink: &Bitmap, photo: &Photo) -> Option<PixelBox> {
    let (left, top, right, bottom) = ink.ink_box()?;
    let found = PixelBox { x: left, y: top, width: right + 1 - left, height: bottom + 1 - top };
    let part = f64::from(found.width) * f64::from(found.height) / (ink.area().max(1) as f64);
    let wider = (WIDER * f64::from(photo.width().max(photo.height()))) as u32;
    (part >= MIN_PART).then(|| found.widened(wider, photo))
}

/// What a mask from a guessed box is chosen by, and the confidence that is reported, given its own and that of the mask
/// by colours alone.
///
/// A box that was guessed too small, or around something else, cuts through that: what reaches its sides speaks against
/// the mask as what reaches the picture's does. And a tree of its surroundings' colours is cut out firmly wherever the
/// middle of the box happens to be: only if it has colours of its own is a firm cut a good one.
pub(super) fn score(own: f64, ink: &Bitmap, region: &PixelBox, by_colors: f64) -> (f64, f64) {
    let evidence = own * (1.0 - 2.0 * rim(ink, region)).max(0.0);
    if by_colors >= CLEAR {
        return (SEEN * evidence, SEEN * evidence);
    }
    (UNSEEN * evidence, UNSEEN.min(UNCLEAR * by_colors) * evidence)
}

/// Part of a box's left, upper and right side that a mask reaches.
fn rim(ink: &Bitmap, region: &PixelBox) -> f64 {
    let gap = (RIM * f64::from(region.width.max(region.height))).ceil() as u32;
    let (right, foot) = (region.x + region.width, region.y + region.height);
    let has = |columns: std::ops::Range<u32>, rows: std::ops::Range<u32>| {
        u32::from(rows.into_iter().any(|y| columns.clone().any(|x| ink.get(x, y))))
    };
    let left = region.x..(region.x + gap).min(right);
    let end = right.saturating_sub(gap).max(region.x)..right;
    let top = region.y..(region.y + gap).min(foot);
    let sides: u32 = (region.y..foot).map(|y| has(left.clone(), y..y + 1) + has(end.clone(), y..y + 1)).sum();
    let above: u32 = (region.x..right).map(|x| has(x..x + 1, top.clone())).sum();
    f64::from(sides + above) / f64::from((2 * region.height + region.width).max(1))
}
