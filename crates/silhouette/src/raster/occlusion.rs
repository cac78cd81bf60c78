//! Pixels that are black already: what lies behind them needs no more than a look.

use super::grid::{ACROSS, Grid};
use crate::bitmap::Bitmap;
use std::sync::{Arc, Mutex, PoisonError};

/// The black pixels of a picture that is being drawn, as far as they have been looked for.
#[derive(Clone, Debug, Default)]
pub(super) struct Occlusion {
    black: Bitmap,
    /// Whether they have been looked for in this picture.
    is_known: bool,
    /// Shapes that were drawn since then.
    drawn: usize,
    /// What other threads know of the same picture.
    told: Option<Arc<Mutex<Bitmap>>>,
}

impl Occlusion {
    /// Nothing is known of a new picture.
    pub(super) fn reset(&mut self) {
        (self.is_known, self.drawn) = (false, 0);
    }

    /// So many shapes were drawn.
    pub(super) fn add(&mut self, drawn: usize) {
        self.drawn += drawn;
    }

    /// Whether black pixels have been looked for.
    pub(super) const fn is_known(&self) -> bool {
        self.is_known
    }

    /// Looks for black pixels if one shape for each `pixels_for_a_shape` was drawn since it was done last.
    pub(super) fn look(&mut self, grid: &mut Grid, pixels_for_a_shape: usize) {
        if self.drawn * pixels_for_a_shape > grid.area() {
            grid.sweep(&mut self.black);
            (self.is_known, self.drawn) = (true, 0);
            if let Some(told) = &self.told {
                let mut all = told.lock().unwrap_or_else(PoisonError::into_inner);
                all.unite(&self.black);
                self.black.clone_from(&all);
            }
        }
    }

    /// From now on this and all copies tell each other what they find in a picture of this size.
    pub(super) fn share(&mut self, (width, height): (u32, u32)) {
        let black = if self.is_known { self.black.clone() } else { Bitmap::new(width, height) };
        self.told = Some(Arc::new(Mutex::new(black)));
    }

    /// Ends what [`Self::share`] began.
    pub(super) fn end_sharing(&mut self) {
        self.told = None;
    }

    /// Whether all pixels of a box are known to be black; never of one that is wider than 63 pixels or across an edge.
    /// The box is in samples, of which there are 1 / `row` down each pixel.
    #[inline]
    pub(super) fn hides(&self, [left, right]: [f32; 2], [top, bottom]: [f32; 2], row: f32) -> bool {
        const COLUMN: f32 = 1.0 / ACROSS as f32;
        self.is_known && is_black(&self.black, [left * COLUMN, right * COLUMN], [top * row, bottom * row])
    }
}

/// Whether all pixels of a box are black; never of one that is wider than 63 pixels or across an edge.
#[inline]
fn is_black(black: &Bitmap, [left, right]: [f32; 2], [top, bottom]: [f32; 2]) -> bool {
    let (width, height) = (black.width() as f32, black.height() as f32);
    // Also false where a number is none.
    if !(left >= 0.0 && right < width && top >= 0.0 && bottom < height && right - left < 63.0) {
        return false;
    }
    let (first, last) = (left as usize, right as usize);
    let (word, shift) = (first / 64, first % 64);
    let mask = u64::MAX >> (63 - (last - first));
    let (low, high) = (mask << shift, if shift == 0 { 0 } else { mask >> (64 - shift) });
    (top as u32..=bottom as u32).all(|y| {
        let row = black.row(y);
        row[word] & low == low && (high == 0 || row[word + 1] & high == high)
    })
}
