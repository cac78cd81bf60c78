//! Limbs are lines: the best of straight lines through a place.
//!
//! The mean of a likelihood along short lines in eight directions, of which the highest is taken: the linear
//! structuring elements that vessels and roads are found by (Zana and Klein 2001 among others). A limb keeps its
//! likelihood along one of them; dark specks between leaves do not.

use super::grid::Grid;

/// Directions, as steps in sixteenths of a cell.
const DIRECTIONS: [(i32, i32); 8] =
    [(16, 0), (15, 6), (11, 11), (6, 15), (0, 16), (-6, 15), (-11, 11), (-15, 6)];

/// A line's best direction is better than the mean of all by this much,
const LINE: f32 = 0.2;
/// or that mean is this high, as inside of trunks.
const FULL: f32 = 0.8;

/// For each cell of at least `least`, the highest mean of `values` on lines that reach `reach` cells to both sides,
/// less what it lacks in being a line's: higher than in other directions, or high in all.
pub(super) fn along_lines(grid: &Grid, values: &[f32], reach: i32, least: f32) -> Vec<f32> {
    let (width, height) = (grid.width as i32, grid.height as i32);
    let step = |at: i32, part: i32| at + ((part + 8) >> 4);
    // As places in the list, for cells that are far enough from the edge.
    let offsets: Vec<isize> = DIRECTIONS
        .iter()
        .flat_map(|&(right, down)| {
            (-reach..=reach).map(move |i| (step(0, down * i) * width + step(0, right * i)) as isize)
        })
        .collect();
    let count = (2 * reach + 1) as usize;
    let mut lines = vec![0.0; values.len()];
    for (at, line) in lines.iter_mut().enumerate().filter(|&(at, _)| values[at] >= least) {
        let (x, y) = (at as i32 % width, at as i32 / width);
        let is_far = x >= reach && y >= reach && x + reach < width && y + reach < height;
        let (mut best, mut total) = (0.0_f32, 0.0);
        for (i, &(right, down)) in DIRECTIONS.iter().enumerate() {
            let mut sum = 0.0;
            if is_far {
                for &offset in &offsets[i * count..(i + 1) * count] {
                    sum += values[at.wrapping_add_signed(offset)];
                }
            } else {
                for (u, v) in (-reach..=reach).map(|i| (step(x, right * i), step(y, down * i))) {
                    if (0..width).contains(&u) && (0..height).contains(&v) {
                        sum += values[(v * width + u) as usize];
                    }
                }
            }
            best = best.max(sum);
            total += sum;
        }
        let (best, mean) = (best / count as f32, total / (count * DIRECTIONS.len()) as f32);
        *line = best - (LINE - (best - mean)).clamp(0.0, (FULL - mean).max(0.0));
    }
    lines
}
