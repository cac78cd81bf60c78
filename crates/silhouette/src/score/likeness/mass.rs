//! Mass: how much ink is where, blurred.
//!
//! Of the four parts it alone knows left from right and where the tree stands. On its own it would be
//! blurred overlap, which a blob satisfies; its small weight settles what the others leave open.

use super::columns::Columns;
use super::{CELLS, Cells, smooth};
use crate::bitmap::Bitmap;

pub(super) const AMOUNTS: usize = CELLS * CELLS;

/// The share of each cell of side S / 16 that is inked, blurred by one cell.
pub(super) fn amounts(picture: &Bitmap, columns: &mut Columns) -> Cells {
    let side = picture.width().max(picture.height()).max(1) as usize;
    columns.cut(picture.width(), |x| x as usize * CELLS / side);
    let mut counts = [0; AMOUNTS];
    for y in 0..picture.height() {
        let band = y as usize * CELLS / side * CELLS;
        let row = picture.row(y);
        columns.count(|i| row[i], &mut counts[band..band + CELLS]);
    }
    let area = (side as f32 / CELLS as f32) * (side as f32 / CELLS as f32);
    let mut cells = counts.map(|n| n as f32 / area);
    smooth(&mut cells, false);
    cells
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_cell_spreads_to_its_neighbours() {
        let picture = Bitmap::from_fn(64, 64, |x, y| x / 4 == 5 && y / 4 == 0);
        let cells = amounts(&picture, &mut Columns::default());
        assert_eq!(cells[5], 0.25);
        assert_eq!([cells[4], cells[6], cells[CELLS + 5], cells[CELLS + 4]], [0.125, 0.125, 0.125, 0.0625]);
        assert_eq!(cells.iter().filter(|v| **v > 0.0).count(), 6);
    }
}
