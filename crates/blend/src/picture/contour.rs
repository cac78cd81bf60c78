//! Lines on a grid of samples: of equal value, and between unlike neighbours.

use std::collections::BTreeMap;

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

/// Pieces of the lines between samples that differ, each with the `weight` of the two.
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

/// The same samples with `times` as many columns and rows between them, on smooth curves through them
/// (Catmull and Rom's, straight on where a sample is missing). Corners of iso-lines then are not seen.
pub(super) fn refined(grid: &Grid<f64>, times: usize) -> Grid<f64> {
    let rows = grid.cells.len() / grid.columns;
    let (columns, fine_rows) = ((grid.columns - 1) * times + 1, (rows.max(1) - 1) * times + 1);
    let place = |fine: usize, count: usize| {
        let whole = (fine / times).min(count.saturating_sub(2));
        (whole, (fine - whole * times) as f64 / times as f64)
    };
    let cells = (0..fine_rows * columns).map(|i| {
        let (column, across) = place(i % columns, grid.columns);
        let (row, down) = place(i / columns, rows);
        let along = |row: Option<usize>| {
            let row = row.filter(|row| *row < rows)?;
            let at = |column: Option<usize>| {
                column.filter(|c| *c < grid.columns).and_then(|c| grid.at(c, row).copied())
            };
            curve(column.checked_sub(1), Some(column), Some(column + 1), Some(column + 2), at, across)
        };
        curve(row.checked_sub(1), Some(row), Some(row + 1), Some(row + 2), along, down)
    });
    let cells = cells.collect();
    Grid { columns, cells }
}

/// The value at `part` of the way from the second to the third of four neighbours. On one of the two it
/// is the sample itself, whatever is missing around it.
fn curve<T>(before: T, from: T, to: T, after: T, at: impl Fn(T) -> Option<f64>, part: f64) -> Option<f64> {
    if part == 0.0 {
        return at(from);
    }
    if part == 1.0 {
        return at(to);
    }
    let (b, c) = (at(from)?, at(to)?);
    let (a, d) = (at(before).unwrap_or(2.0 * b - c), at(after).unwrap_or(2.0 * c - b));
    let (slope, bend, twist) = (c - a, 2.0 * a - 5.0 * b + 4.0 * c - d, 3.0 * (b - c) + d - a);
    Some(b + 0.5 * part * (slope + part * (bend + part * twist)))
}

/// Pieces that meet, as lines through many points.
pub(super) fn joined(pieces: &[Piece]) -> Vec<Vec<(f64, f64)>> {
    // Neighbouring squares compute the point that they share from either side.
    let key = |p: (f64, f64)| ((p.0 * 1e6).round() as i64, (p.1 * 1e6).round() as i64);
    let mut meeting: BTreeMap<(i64, i64), Vec<usize>> = BTreeMap::new();
    for (i, piece) in pieces.iter().enumerate() {
        piece.iter().for_each(|&end| meeting.entry(key(end)).or_default().push(i));
    }
    let mut taken = vec![false; pieces.len()];
    let follow = |line: &mut Vec<(f64, f64)>, taken: &mut Vec<bool>| {
        while let Some(&end) = line.last() {
            let Some(&next) = meeting[&key(end)].iter().find(|&&i| !taken[i]) else { break };
            taken[next] = true;
            let [a, b] = pieces[next];
            line.push(if key(a) == key(end) { b } else { a });
        }
    };
    let mut lines = Vec::new();
    for i in 0..pieces.len() {
        if std::mem::replace(&mut taken[i], true) {
            continue;
        }
        let mut line = pieces[i].to_vec();
        follow(&mut line, &mut taken);
        line.reverse();
        follow(&mut line, &mut taken);
        lines.push(line);
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_that_meet_are_one_line() {
        let p = |x: f64| (x, 1.0);
        let lines = joined(&[[p(1.0), p(2.0)], [p(5.0), p(6.0)], [p(3.0), p(2.0)], [p(0.0), p(1.0)]]);
        assert_eq!(lines, [vec![p(3.0), p(2.0), p(1.0), p(0.0)], vec![p(6.0), p(5.0)]]);
        // A ring ends where it begins.
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)];
        let ring: Vec<Piece> = (0..3).map(|i| [corners[i], corners[(i + 1) % 3]]).collect();
        let lines = joined(&ring);
        assert_eq!((lines.len(), lines[0].len(), lines[0][0]), (1, 4, lines[0][3]));
    }

    #[test]
    fn a_refined_grid_keeps_its_samples_and_bends_between_them() {
        let sample = |x: f64, y: f64| x * x + 3.0 * y;
        let mut cells: Vec<Option<f64>> =
            (0..30).map(|i| Some(sample(f64::from(i % 6), f64::from(i / 6)))).collect();
        let fine = refined(&Grid { columns: 6, cells: cells.clone() }, 4);
        assert_eq!((fine.columns, fine.cells.len()), (21, 21 * 17));
        for (i, cell) in cells.iter().enumerate() {
            assert_eq!(fine.at(4 * (i % 6), 4 * (i / 6)).copied(), *cell, "{i}");
        }
        let coarse = Grid { columns: 6, cells: cells.clone() };
        let [few, many] = [&coarse, &fine].map(|grid| isoline(grid, 6.2).len());
        assert!(many > 2 * few, "{few} pieces, {many} when refined");
        // A parabola's middle is not the mean of its ends: Catmull and Rom's curve hits it.
        let middle = *fine.at(10, 6).unwrap();
        assert!((middle - sample(2.5, 1.5)).abs() < 1e-12, "{middle}");
        // Missing samples stay missing, and no others become so.
        cells[8] = None;
        let fine = refined(&Grid { columns: 6, cells }, 4);
        assert!(fine.at(8, 4).is_none() && fine.at(9, 4).is_none() && fine.at(8, 5).is_none());
        assert!(fine.at(4, 4).is_some() && fine.at(12, 4).is_some() && fine.at(14, 9).is_some());
    }

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
