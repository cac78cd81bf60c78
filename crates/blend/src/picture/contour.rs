//! Lines on a grid of samples: of equal value, and between unlike neighbours.

/// Samples on a grid, row by row; `None` where there is nothing to sample.
#[derive(Clone, Debug)]
pub(super) struct Grid<T> {
    pub(super) columns: usize,
    pub(super) cells: Vec<Option<T>>,
}

/// A piece of line in grid coordinates: sample (i, j) is at (i, j).
pub(super) type Piece = [(f64, f64); 2];

impl<T> Grid<T> {
    fn at(&self, column: usize, row: usize) -> Option<&T> {
        self.cells[row * self.columns + column].as_ref()
    }

    /// Calls `each` with the corners of every square whose four samples are there: (0, 0), (1, 0),
    /// (1, 1), (0, 1) from its origin.
    fn squares<'a>(&'a self, mut each: impl FnMut((f64, f64), [&'a T; 4])) {
        let rows = self.cells.len() / self.columns;
        for row in 1..rows {
            for column in 1..self.columns {
                let corners = [(column - 1, row - 1), (column, row - 1), (column, row), (column - 1, row)];
                if let [Some(a), Some(b), Some(c), Some(d)] = corners.map(|(i, j)| self.at(i, j)) {
                    each(((column - 1) as f64, (row - 1) as f64), [a, b, c, d]);
                }
            }
        }
    }
}

/// Corners of a unit square, in the order of [`Grid::squares`].
const CORNERS: [(f64, f64); 4] = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];

/// Pieces of the lines where the samples pass through `level`: marching squares, with straight lines
/// between samples.
pub(super) fn isoline(grid: &Grid<f64>, level: f64) -> Vec<Piece> {
    let mut pieces = Vec::new();
    grid.squares(|origin, values| {
        let mut crossings = Vec::new();
        for i in 0..4 {
            let j = (i + 1) % 4;
            let (a, b) = (*values[i], *values[j]);
            if (a < level) != (b < level) {
                let part = (level - a) / (b - a);
                let (p, q) = (CORNERS[i], CORNERS[j]);
                crossings.push((origin.0 + p.0 + part * (q.0 - p.0), origin.1 + p.1 + part * (q.1 - p.1)));
            }
        }
        pieces.extend(crossings.chunks_exact(2).map(|pair| [pair[0], pair[1]]));
    });
    pieces
}

/// Pieces of the lines between samples that differ, each with what `weight` says of the two.
pub(super) fn boundaries<T>(grid: &Grid<T>, weight: impl Fn(&T, &T) -> f64) -> Vec<(Piece, f64)> {
    let mut pieces = Vec::new();
    grid.squares(|origin, samples| {
        let mut crossings = Vec::new();
        for i in 0..4 {
            let j = (i + 1) % 4;
            let weight = weight(samples[i], samples[j]);
            if weight > 0.0 {
                let middle = ((CORNERS[i].0 + CORNERS[j].0) / 2.0, (CORNERS[i].1 + CORNERS[j].1) / 2.0);
                crossings.push(((origin.0 + middle.0, origin.1 + middle.1), weight));
            }
        }
        match crossings.as_slice() {
            [(a, v), (b, w)] => pieces.push(([*a, *b], f64::max(*v, *w))),
            _ => {
                let middle = (origin.0 + 0.5, origin.1 + 0.5);
                pieces.extend(crossings.iter().map(|(a, w)| ([*a, middle], *w)));
            }
        }
    });
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_isoline_of_a_slope_is_straight() {
        let cells = (0..12).map(|i| Some(f64::from(i % 4))).collect();
        let pieces = isoline(&Grid { columns: 4, cells }, 1.25);
        assert_eq!(pieces.len(), 2);
        assert!(pieces.iter().flatten().all(|p| (p.0 - 1.25).abs() < 1e-12));
    }

    #[test]
    fn boundaries_run_between_unlike_samples_and_stop_at_holes() {
        let mut cells: Vec<Option<bool>> = (0..12).map(|i| Some(i % 4 >= 2)).collect();
        let differ = |a: &bool, b: &bool| if a == b { 0.0 } else { 1.0 };
        let pieces = boundaries(&Grid { columns: 4, cells: cells.clone() }, differ);
        assert_eq!(pieces, [([(1.5, 0.0), (1.5, 1.0)], 1.0), ([(1.5, 1.0), (1.5, 2.0)], 1.0)]);
        cells[1] = None;
        assert_eq!(boundaries(&Grid { columns: 4, cells }, differ).len(), 1);
    }
}
