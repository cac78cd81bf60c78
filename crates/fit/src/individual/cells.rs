//! A goal in coarse cells: where its crown is, and how dense.

use pleach_silhouette::{Bitmap, Frame, View};
use pleach_tree::{DENSEST, HullView};

/// Cells per height of the tree.
pub(super) const CELLS: f64 = 50.0;
/// Most cells from the trunk's foot to either side, and up.
const MAX_REACH: usize = 120;
/// Cells in a row.
const COLUMNS: usize = 2 * MAX_REACH;
/// Steepest view, in radians above the horizon, that shows how high things are.
const LEVEL: f64 = 0.15;
/// Cells with less ink than this count as empty where the dense ones are looked for.
const NO_INK: f64 = 0.02;
/// Part of the cells that have less ink than a dense one.
const DENSE: f64 = 0.9;
/// Ink of a cell in the crown over that of a dense one.
const IN_CROWN: f64 = 0.2;
/// Density of a crown that is as dense as the species' own, so that there can be more.
const EVEN: f64 = 0.67;

/// How densely a goal's crown fills its cells, from the ground up.
#[derive(Clone, Debug)]
pub(super) struct Cells {
    azimuth: f64,
    /// Ink of each cell over that of a dense one, row by row.
    ink: Vec<f64>,
    /// Ink of a dense cell per area.
    dense: f64,
    /// Whether a cell shows the bare trunk.
    is_trunk: Vec<bool>,
}

impl Cells {
    /// The cells of `goal`, where trees of the height `height` stand in `frame` and the bare trunk is `trunk`: place, height
    /// and width over that height. `None` without a crown, or where the view does not show how high things are.
    pub(super) fn new(
        goal: &Bitmap,
        (view, frame): &(View, Frame),
        height: f64,
        trunk: &[[f64; 3]],
    ) -> Option<Self> {
        if view.elevation.abs() > LEVEL {
            return None;
        }
        let mut cells = Self {
            azimuth: view.azimuth,
            ink: Vec::new(),
            dense: 1.0,
            is_trunk: vec![false; COLUMNS * MAX_REACH],
        };
        for &[across, z, width] in trunk {
            let (row, half) = ((z * CELLS) as usize, width / 2.0 + 1.0 / CELLS);
            for column in 0..COLUMNS {
                let to = (column as f64 + 0.5 - MAX_REACH as f64) / CELLS;
                if (to - across).abs() < half && row < MAX_REACH {
                    cells.is_trunk[row * COLUMNS + column] = true;
                }
            }
        }
        let ink = cells.drawn(goal, frame, height);
        let mut some: Vec<f64> = ink.iter().copied().filter(|&ink| ink > NO_INK).collect();
        some.sort_unstable_by(f64::total_cmp);
        let dense = *some.get((some.len() as f64 * DENSE) as usize)?;
        cells.ink = ink.iter().map(|ink| ink / dense).collect();
        cells.dense = dense;
        Some(cells)
    }

    /// How much ink the picture of a tree lacks in each cell, in parts of a dense one; below 0 where it has too much.
    pub(super) fn lacking(&self, picture: &Bitmap, frame: &Frame, height: f64) -> Vec<f64> {
        let grown = self.drawn(picture, frame, height);
        self.ink
            .iter()
            .zip(grown)
            .map(|(wanted, ink)| wanted.min(1.0) - (ink / self.dense).min(1.0))
            .collect()
    }

    /// Ink per area in the cells of a picture, blurred a little.
    fn drawn(&self, picture: &Bitmap, frame: &Frame, height: f64) -> Vec<f64> {
        let mut ink = count(picture, frame, height);
        ink.iter_mut().zip(&self.is_trunk).filter(|(_, is_trunk)| **is_trunk).for_each(|(ink, _)| *ink = 0.0);
        blurred(&ink)
    }

    /// Densities in 0..=1 of a hull: even, or as the ink is; without the outermost `margin` cells, which twigs fill, or with
    /// as many more.
    pub(super) fn levels(&self, margin: i32, is_even: bool) -> Vec<f64> {
        let depth = self.depths();
        let mut levels = vec![0.0; self.ink.len()];
        for cell in 0..levels.len() {
            // What is narrow keeps its middle.
            let is_ridge = depth[cell] > 0 && self.around(cell).all(|other| depth[other] <= depth[cell]);
            if depth[cell] > margin || is_ridge {
                levels[cell] = EVEN * if is_even { 1.0 } else { self.ink[cell].clamp(IN_CROWN, 1.0) };
            }
        }
        levels
    }

    fn around(&self, cell: usize) -> impl Iterator<Item = usize> {
        let last = self.ink.len();
        [cell.wrapping_sub(1), cell + 1, cell.wrapping_sub(COLUMNS), cell + COLUMNS]
            .into_iter()
            .filter(move |&other| other < last)
    }

    /// Steps from each cell of the crown to the outside of it, and below 0 from the cells outside to the crown.
    fn depths(&self) -> Vec<i32> {
        let is_in = |cell: usize| self.ink[cell] >= IN_CROWN;
        let inwards = self.steps(is_in);
        let outwards = self.steps(|cell| !is_in(cell));
        // The first cell outside has depth 0.
        (0..self.ink.len()).map(|cell| if is_in(cell) { inwards[cell] } else { 1 - outwards[cell] }).collect()
    }

    /// Steps from each cell that is in to one that is not; as many as there are cells where none is out.
    fn steps(&self, is_in: impl Fn(usize) -> bool) -> Vec<i32> {
        let far = self.ink.len() as i32;
        let mut steps: Vec<i32> = (0..self.ink.len()).map(|cell| if is_in(cell) { far } else { 0 }).collect();
        let mut front: Vec<usize> = (0..steps.len()).filter(|&cell| steps[cell] == 0).collect();
        for step in 1..far {
            let mut next = Vec::new();
            for cell in front {
                for other in self.around(cell) {
                    if steps[other] == far {
                        steps[other] = step;
                        next.push(other);
                    }
                }
            }
            if next.is_empty() {
                break;
            }
            front = next;
        }
        steps
    }

    /// The picture of a hull that has these `levels`.
    pub(super) fn view(&self, levels: &[f64]) -> HullView {
        let digit = |level: &f64| (level * f64::from(DENSEST)).round().clamp(0.0, f64::from(DENSEST)) as u8;
        let mut rows: Vec<Vec<u8>> =
            levels.chunks(COLUMNS).map(|row| row.iter().map(digit).collect()).collect();
        let is_empty = |row: &Vec<u8>| row.iter().all(|&cell| cell == 0);
        while rows.pop_if(|row| is_empty(row)).is_some() {}
        let first = rows.iter().filter_map(|row| row.iter().position(|&cell| cell > 0)).min().unwrap_or(0);
        let last = rows.iter().filter_map(|row| row.iter().rposition(|&cell| cell > 0)).max().unwrap_or(0);
        for row in &mut rows {
            row.truncate(last + 1);
            row.drain(..first.min(row.len()));
        }
        let left = (first as f64 - MAX_REACH as f64) / CELLS;
        HullView { azimuth: self.azimuth, cell: 1.0 / CELLS, left, rows }
    }
}

/// Ink per area in cells of a picture where trees of the height `height` stand in `frame`.
fn count(picture: &Bitmap, frame: &Frame, height: f64) -> Vec<f64> {
    let side = height / CELLS / frame.meters_per_pixel;
    let mut ink = vec![0.0; COLUMNS * MAX_REACH];
    for y in 0..picture.height() {
        let row = ((frame.ground_row - f64::from(y) - 0.5) / side).floor();
        if !(0.0..MAX_REACH as f64).contains(&row) {
            continue;
        }
        for x in picture.ink_in_row(y) {
            let column = (f64::from(x) + 0.5 - frame.axis_column) / side + MAX_REACH as f64;
            if (0.0..COLUMNS as f64).contains(&column) {
                ink[row as usize * COLUMNS + column as usize] += 1.0 / (side * side);
            }
        }
    }
    ink
}

/// Means over each cell and the eight around it, near ones for more.
fn blurred(ink: &[f64]) -> Vec<f64> {
    let at = |cell: usize, by: i64| {
        cell.checked_add_signed(by as isize).and_then(|cell| ink.get(cell)).copied().unwrap_or(0.0)
    };
    let step = COLUMNS as i64;
    (0..ink.len())
        .map(|cell| {
            let across = |by: i64| (at(cell, by - 1) + 2.0 * at(cell, by) + at(cell, by + 1)) / 4.0;
            (across(-step) + 2.0 * across(0) + across(step)) / 4.0
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A round crown of radius 12 cells at height 30, of pixels as large as cells, on a trunk.
    fn cells(hole: bool) -> Cells {
        let goal = Bitmap::from_fn(100, 50, |x, y| {
            let (across, up) = (f64::from(x) - 49.5, 49.5 - f64::from(y));
            let from_middle = across.hypot(up - 30.0);
            across.abs() < 1.5 && up < 20.0 || from_middle < 12.0 && !(hole && from_middle < 4.0)
        });
        let frame =
            Frame { width: 100, height: 50, meters_per_pixel: 0.2, axis_column: 50.0, ground_row: 50.0 };
        let trunk: Vec<[f64; 3]> = (0..18).map(|row| [0.0, f64::from(row) / CELLS, 3.0 / CELLS]).collect();
        Cells::new(&goal, &(View::FRONT, frame), 10.0, &trunk).unwrap()
    }

    #[test]
    fn a_hull_has_the_crown_without_its_margin() {
        let cells = cells(false);
        let width = |margin| {
            let (left, right) = cells.view(&cells.levels(margin, true)).extent(30.5 / CELLS).unwrap();
            (right - left) * CELLS
        };
        let widths: Vec<f64> = (-2..=5).map(width).collect();
        assert!((23.0..=27.0).contains(&widths[2]), "{widths:?}");
        assert!(widths.windows(2).all(|pair| (pair[0] - pair[1] - 2.0).abs() < 1e-9), "{widths:?}");
        let (base, top) = cells.view(&cells.levels(0, true)).rise().unwrap();
        assert!((base * CELLS - 17.0).abs() <= 1.5 && (top * CELLS - 43.0).abs() <= 1.5, "{base} {top}");
    }

    #[test]
    fn gaps_are_empty_and_the_bare_trunk_is_no_crown() {
        let cells = cells(true);
        let view = cells.view(&cells.levels(0, false));
        assert_eq!((view.density(0.0, 30.5 / CELLS), view.density(0.0, 8.5 / CELLS)), (0, 0));
        assert!(view.density(8.0 / CELLS, 30.5 / CELLS) > 0);
    }

    #[test]
    fn what_is_lacking_is_told_by_cell() {
        let cells = cells(false);
        let frame =
            Frame { width: 100, height: 50, meters_per_pixel: 0.2, axis_column: 50.0, ground_row: 50.0 };
        let left = Bitmap::from_fn(100, 50, |x, y| x < 50 && (8..32).contains(&y));
        let lacking = cells.lacking(&left, &frame, 10.0);
        let at = |across: i64, up: usize| lacking[up * COLUMNS + (MAX_REACH as i64 + across) as usize];
        assert!(at(6, 30) > 0.9 && at(-6, 30).abs() < 0.1 && at(-40, 30) < -0.9);
    }

    #[test]
    fn views_from_above_show_no_heights() {
        let frame = Frame { width: 9, height: 9, meters_per_pixel: 1.0, axis_column: 4.5, ground_row: 9.0 };
        let goal = Bitmap::from_fn(9, 9, |_, _| true);
        assert!(Cells::new(&goal, &(View::degrees(0.0, 30.0), frame), 9.0, &[]).is_none());
        assert!(Cells::new(&Bitmap::new(9, 9), &(View::FRONT, frame), 9.0, &[]).is_none());
    }
}
