//! The grain of a crown: which way its texture runs, from curtains of hanging twigs to level layers.
//!
//! Leaves break twigs into dots, so that fine strokes say little of a leafy crown. Seen from a little farther away the
//! dots close up again. So the crown is drawn in cells of 1/128 of the height and blurred by about one cell; the
//! directions of its edges, weighted by the square of their steepness, are the structure tensor of the picture (Bigün
//! and Granlund 1987).

use super::grid::Grid;
use super::trace::Rows;
use std::ops::Range;

/// Cells per height of the tree.
const CELLS: usize = 128;
/// Empty cells on all sides of the crown.
const MARGIN: usize = 3;

/// Which way the texture of a crown runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Grain {
    /// From -1, all level, to 1, all upright.
    pub(super) upright: f64,
    /// From -1, all at 45° down and away from the axis, to 1, all at 45° up and away from it.
    pub(super) rising: f64,
}

/// Memory of [`grain`].
#[derive(Clone, Debug, Default)]
pub(super) struct Cells {
    ink: Vec<i32>,
    spare: Vec<i32>,
}

/// Reads the grain of the ink above the height `bare`; `origin` is the column of the axis, `width` the columns of the
/// picture. `None` without ink.
pub(super) fn grain(
    ink: &Grid,
    cells: &mut Cells,
    rows: Rows,
    bare: usize,
    (width, origin): (usize, f64),
) -> Option<Grain> {
    let side = (rows.count / CELLS).max(1);
    let crown = rows.row(rows.count - 1)..rows.row(bare.min(rows.count - 1)) + 1;
    let across = width.div_ceil(side) + 2 * MARGIN;
    let down = crown.len().div_ceil(side) + 2 * MARGIN;
    cells.ink.clear();
    cells.ink.resize(across * down, 0);
    count(ink, crown, side, across, &mut cells.ink);
    cells.spare.resize(across * down, 0);
    for _ in 0..2 {
        sum_of_three(&cells.ink, &mut cells.spare, 1);
        sum_of_three(&cells.spare, &mut cells.ink, across);
    }
    let axis = (origin / side as f64).round().max(0.0) as usize + MARGIN;
    tensor(&cells.ink, across, axis.min(across))
}

/// Adds the ink of the rows `crown` to cells of `side` pixels.
fn count(ink: &Grid, crown: Range<usize>, side: usize, across: usize, cells: &mut [i32]) {
    for (number, y) in crown.enumerate() {
        let to = &mut cells[(number / side + MARGIN) * across + MARGIN..];
        for (word, bits) in ink.row(y).iter().enumerate() {
            let mut left = *bits;
            while left != 0 {
                let x = 64 * word + left.trailing_zeros() as usize;
                // The rest of the run of ink in this cell at once.
                let run = (!(left >> (x % 64))).trailing_zeros() as usize;
                let run = run.min(side - x % side);
                to[x / side] += run as i32;
                left &= if x % 64 + run < 64 { u64::MAX << (x % 64 + run) } else { 0 };
            }
        }
    }
}

/// The sums of each cell and the ones `step` before and after it; the first and last `step` cells are empty.
fn sum_of_three(cells: &[i32], to: &mut [i32], step: usize) {
    let last = cells.len() - step;
    to[..step].fill(0);
    to[last..].fill(0);
    let (before, after) = (&cells[..last - step], &cells[2 * step..]);
    for (((to, own), before), after) in
        to[step..last].iter_mut().zip(&cells[step..last]).zip(before).zip(after)
    {
        *to = before + own + after;
    }
}

/// The grain of blurred cells whose axis is at column `axis`.
fn tensor(cells: &[i32], across: usize, axis: usize) -> Option<Grain> {
    let (mut across_sum, mut down_sum, mut rising) = (0i64, 0i64, 0i64);
    let rows = cells.len() / across;
    for y in 1..rows - 1 {
        let (above, own, below) =
            (&cells[(y - 1) * across..], &cells[y * across..], &cells[(y + 1) * across..]);
        let mut sums = |columns: Range<usize>| {
            let (mut products, mut xx, mut yy) = (0i64, 0i64, 0i64);
            for x in columns {
                let (right, down) = (i64::from(own[x + 1] - own[x - 1]), i64::from(below[x] - above[x]));
                xx += right * right;
                yy += down * down;
                products += right * down;
            }
            across_sum += xx;
            down_sum += yy;
            products
        };
        let middle = axis.clamp(1, across - 1);
        // An edge that falls to the right and down is that of a stroke that rises to the right.
        rising -= sums(1..middle);
        rising += sums(middle..across - 1);
    }
    let all = (across_sum + down_sum) as f64;
    (all > 0.0)
        .then(|| Grain { upright: (across_sum - down_sum) as f64 / all, rising: 2.0 * rising as f64 / all })
}

#[cfg(test)]
mod tests {
    use crate::Reading;
    use pleach_silhouette::Bitmap;

    /// The grain of a crown of strokes on a stem; a stroke is where `(a · |x| + b · y) mod 16` is below 5.
    fn grain(a: i64, b: i64) -> (f64, f64) {
        let picture = Bitmap::from_fn(256, 256, |x, y| {
            let (across, down) = (i64::from(x) - 128, i64::from(y));
            let crown = down < 200 && across.abs() < 110 && (a * across.abs() + b * down).rem_euclid(16) < 5;
            crown || across.abs() < 4
        });
        let reading = Reading::from_silhouette(&picture);
        (reading.grain_upright.unwrap(), reading.grain_rising.unwrap())
    }

    #[test]
    fn strokes_are_told_apart_by_the_way_they_run() {
        let cases =
            [((1, 0), (1.0, 0.0)), ((0, 1), (-1.0, 0.0)), ((1, 1), (0.0, 1.0)), ((-1, 1), (0.0, -1.0))];
        for ((a, b), (upright, rising)) in cases {
            let found = grain(a, b);
            assert!(
                (found.0 - upright).abs() < 0.25 && (found.1 - rising).abs() < 0.25,
                "{a} {b}: {found:?}"
            );
        }
    }

    #[test]
    fn the_grain_of_a_picture_does_not_depend_on_its_size() {
        let strokes = |scale: u32| {
            let picture = Bitmap::from_fn(128 * scale, 128 * scale, |x, y| {
                let (x, y) = (x / scale, y / scale);
                x.abs_diff(64) < 3 || y < 100 && (x + 2 * y) % 9 < 4
            });
            let reading = Reading::from_silhouette(&picture);
            (reading.grain_upright.unwrap(), reading.grain_rising.unwrap())
        };
        assert_eq!(strokes(1), strokes(2));
        assert_eq!(strokes(1), strokes(3));
    }
}
