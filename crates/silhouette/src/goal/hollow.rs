//! Whether a silhouette is only its outline.

use crate::bitmap::Bitmap;
use crate::pieces;

/// Longer side, in cells, of the picture that is looked at: lines whose ends come this near are closed.
const CELLS: u32 = 256;
/// From this part of a shape on its largest hole makes it hollow. Among goals the largest is 0.16, between two
/// limbs of a bare maple.
const HOLLOW: f64 = 0.35;

/// Part of a shape, its holes filled, that is its largest hole, in 0..=1, if that is most of an outline drawing.
pub(super) fn hollow(ink: &Bitmap) -> Option<f64> {
    let cell = ink.width().max(ink.height()).div_ceil(CELLS).max(1);
    // A margin of two cells, so that what is around the shape is in one piece.
    let (width, height) = (ink.width().div_ceil(cell) + 4, ink.height().div_ceil(cell) + 4);
    let mut cells = Bitmap::new(width, height);
    for y in 0..ink.height() {
        for x in ink.ink_in_row(y) {
            cells.set(x / cell + 2, y / cell + 2, true);
        }
    }
    let closed = pieces::widened(&cells, 1);
    let paper = Bitmap::from_fn(width, height, |x, y| !closed.get(x, y));
    let around = pieces::piece(&paper, &paper, Some((0, 0)))?;
    let holes = Bitmap::from_fn(width, height, |x, y| paper.get(x, y) && !around.get(x, y));
    let largest = pieces::piece(&holes, &holes, None)?.ink() as f64;
    let share = largest / (closed.ink() + holes.ink()) as f64;
    (share >= HOLLOW).then_some(share)
}
