//! Rim: where the outline of the ink runs, and whether upright or level.
//!
//! A crown of small leaves is outline all over, a blob only around; a trunk is upright outline, a fir's
//! layers are level. Trees have no left and right of their own: the halves on both sides of the ink's
//! mean column are laid onto each other, which makes one tree a better witness of its species.

use super::columns::Columns;
use super::{CELLS, Cells, smooth};
use crate::bitmap::Bitmap;

pub(super) const AMOUNTS: usize = 2 * CELLS * CELLS;

/// Length of the upright outline, then of the level one, in cells of side S / 16 by height and by
/// distance from the mean column; in parts of S, blurred by one cell. Where the picture's edge cuts
/// ink off is not an outline.
pub(super) fn amounts(picture: &Bitmap, transposed: &Bitmap, columns: &mut Columns) -> [f32; AMOUNTS] {
    let side = picture.width().max(picture.height()).max(1) as usize;
    let middle = mean_column(transposed);
    let cell = |x: f64| ((x - middle).abs() * CELLS as f64 / side as f64) as usize;
    let band = |y: u32| {
        let start = y as usize * CELLS / side * CELLS;
        start..start + CELLS
    };
    let mut counts = [[0; CELLS * CELLS]; 2];
    let [upright, level] = &mut counts;

    // Bit x is the edge between the pixels x − 1 and x.
    columns.cut(picture.width(), |x| cell(f64::from(x)));
    for y in 0..picture.height() {
        let row = picture.row(y);
        let edges = |i: usize| {
            // The first pixel has no left neighbour to differ from.
            let before = if i == 0 { row[0] & 1 } else { row[i - 1] >> 63 };
            row[i] ^ (row[i] << 1 | before)
        };
        columns.count(edges, &mut upright[band(y)]);
    }

    // Bit x is the edge between the pixel x of this row and of the one above.
    columns.cut(picture.width(), |x| cell(f64::from(x) + 0.5));
    for y in 1..picture.height() {
        let (row, above) = (picture.row(y), picture.row(y - 1));
        columns.count(|i| row[i] ^ above[i], &mut level[band(y)]);
    }

    let mut all = [0.0; AMOUNTS];
    for (half, counts) in all.chunks_exact_mut(CELLS * CELLS).zip(counts) {
        let mut cells: Cells = counts.map(|n| n as f32 / side as f32);
        smooth(&mut cells, true);
        half.copy_from_slice(&cells);
    }
    all
}

/// Mean column of the ink in pixels from the left edge; 0 without ink.
fn mean_column(transposed: &Bitmap) -> f64 {
    let (mut ink, mut moment) = (0, 0);
    for x in 0..transposed.height() {
        let column: u64 = transposed.row(x).iter().map(|w| u64::from(w.count_ones())).sum();
        ink += column;
        moment += column * (2 * u64::from(x) + 1);
    }
    if ink == 0 { 0.0 } else { moment as f64 / (2 * ink) as f64 }
}

#[cfg(test)]
mod tests {
    use super::super::transpose::transpose;
    use super::*;

    fn rim(picture: &Bitmap) -> [f32; AMOUNTS] {
        let mut transposed = Bitmap::default();
        transpose(picture, &mut transposed);
        amounts(picture, &transposed, &mut Columns::default())
    }

    #[test]
    fn a_box_has_its_perimeter_wherever_it_stands() {
        let boxed =
            |x0: u32| Bitmap::from_fn(160, 160, |x, y| (x0..x0 + 30).contains(&x) && (60..80).contains(&y));
        for x0 in [65, 21, 100] {
            let found = rim(&boxed(x0));
            let sum = |half: &[f32]| half.iter().sum::<f32>() * 160.0;
            assert!((sum(&found[..AMOUNTS / 2]) - 40.0).abs() < 1e-3, "two sides of 20");
            assert!((sum(&found[AMOUNTS / 2..]) - 60.0).abs() < 1e-3, "two sides of 30");
            assert_eq!(found, rim(&boxed(65)), "moved sideways it is the same");
        }
    }

    #[test]
    fn a_mirror_image_has_the_same_rim() {
        let picture = Bitmap::from_fn(130, 90, |x, y| (x * x + 3 * y * x + y) % 7 < 2 && x > 30);
        let mirrored = Bitmap::from_fn(130, 90, |x, y| picture.get(129 - x, y));
        assert_eq!(rim(&picture), rim(&mirrored));
    }

    #[test]
    fn what_the_edge_cuts_off_is_no_outline() {
        let full = Bitmap::from_fn(128, 64, |_, _| true);
        assert!(rim(&full).iter().all(|v| *v == 0.0));
    }
}
