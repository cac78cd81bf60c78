//! A stem followed upwards, row by row, through a picture.

use super::grid::{Grid, Run};

/// One row of a stem.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sample {
    /// Rows above the ground.
    pub(super) height: usize,
    /// Middle of the stem, in columns.
    pub(super) center: f64,
    /// Width along the row, in columns: as seen, or as expected where an edge is hidden.
    pub(super) width: f64,
    /// Edges that are seen: 2, 1, or 0 where the place is expected from the rows below.
    pub(super) edges: u8,
    /// The whole run of ink in which the stem lies; empty where there is paper.
    pub(super) run: Run,
}

/// A run is the stem's own up to this many times the expected width, and [`SLACK`] columns.
const WIDE: f64 = 1.35;
const SLACK: f64 = 1.5;
/// A run narrower than this part of the expected width is a twig, and the stem is lost.
const NARROW: f64 = 0.4;
/// Part of a row's width that the expected width takes up.
const ADAPTS: f64 = 0.15;
/// The direction is that of the rows seen last, of this part of the height.
const MEMORY: f64 = 0.07;
/// Rows, as a part of the height, for which a stem may be hidden or missing before it is given up.
const HIDDEN: f64 = 0.06;
const MISSING: f64 = 0.015;

/// The rows of a tree in a grid: which row is how far above the ground.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Rows {
    /// Row of the grid below the lowest ink.
    pub(super) ground: usize,
    /// Rows with the tree.
    pub(super) count: usize,
}

impl Rows {
    /// Row of the grid that lies `height` rows above the ground, which is less than `count`.
    pub(super) const fn row(self, height: usize) -> usize {
        self.ground - 1 - height
    }

    /// This part of the height in rows.
    pub(super) fn part(self, part: f64) -> usize {
        (self.count as f64 * part).round() as usize
    }
}

/// Slope of the centers over the heights, and the center where `height` is; `None` for fewer than two heights.
pub(super) fn line(samples: impl Iterator<Item = (f64, f64)>) -> Option<(f64, f64)> {
    let (mut n, mut sx, mut sy, mut sxx, mut sxy) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (x, y) in samples {
        n += 1.0;
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
    }
    let spread = n * sxx - sx * sx;
    if spread <= 0.0 {
        return None;
    }
    let slope = (n * sxy - sx * sy) / spread;
    Some((slope, (sy - slope * sx) / n))
}

/// Follows the stem whose run in the row at `start` is `first` upwards, up to the height `end` at most.
///
/// Rows in which branches or foliage hide one edge are understood from the other, and rows in which both are
/// hidden are passed over if the stem comes out of them again.
pub(super) fn trace(grid: &Grid, rows: Rows, start: usize, first: Run, end: usize, out: &mut Vec<Sample>) {
    out.clear();
    let mut width = first.width() as f64;
    let memory = rows.part(MEMORY).clamp(5, 48);
    let (hidden, missing) = (rows.part(HIDDEN).max(3), rows.part(MISSING).max(1));
    out.push(Sample { height: start, center: first.center(), width, edges: 2, run: first });
    let (mut unseen, mut absent) = (0, 0);
    let mut last = first;
    for height in start + 1..end.min(rows.count) {
        let (slope, expected) = expect(out, height, memory);
        let y = rows.row(height);
        // Before there is a direction, what touches the run below is the stem.
        let found =
            grid.run_at(y, expected.floor() as i64).or_else(|| beside(grid, y, expected, width, last));
        let wide = WIDE * width + SLACK + 0.5 * slope.abs();
        let Some(run) = found.filter(|run| run.width() as f64 >= NARROW * width) else {
            absent += 1;
            unseen += 1;
            if absent > missing || unseen > hidden {
                break;
            }
            out.push(Sample { height, center: expected, width, edges: 0, run: Run::default() });
            continue;
        };
        absent = 0;
        last = run;
        let slack = 0.25 * width + 1.0;
        let sample = if run.width() as f64 <= wide {
            let seen = run.width() as f64;
            width += ADAPTS * (seen - width);
            unseen = 0;
            Sample { height, center: run.center(), width: seen, edges: 2, run }
        } else if (run.left as f64 - (expected - width / 2.0)).abs() <= slack {
            unseen += 1;
            Sample { height, center: run.left as f64 + width / 2.0, width, edges: 1, run }
        } else if (run.right as f64 - (expected + width / 2.0)).abs() <= slack {
            unseen += 1;
            Sample { height, center: run.right as f64 - width / 2.0, width, edges: 1, run }
        } else {
            unseen += 1;
            Sample { height, center: expected, width, edges: 0, run }
        };
        out.push(sample);
        if unseen > hidden {
            break;
        }
    }
    // What was expected above the last row that is seen is no part of the stem; its runs are kept for forks.
}

/// Slope and center that the rows seen last give for `height`.
fn expect(samples: &[Sample], height: usize, memory: usize) -> (f64, f64) {
    let recent = &samples[samples.len().saturating_sub(memory)..];
    let seen = recent.iter().filter(|sample| sample.edges > 0);
    let last = recent.iter().rev().find(|sample| sample.edges > 0).map_or(0.0, |sample| sample.center);
    let found = line(seen.map(|sample| (sample.height as f64 - height as f64, sample.center)));
    match found {
        Some(found) if recent.len() > 3 => found,
        _ => (0.0, last),
    }
}

/// The run near `expected` where that lies in paper: within half a width, and touching the one below.
fn beside(grid: &Grid, y: usize, expected: f64, width: f64, last: Run) -> Option<Run> {
    let from = (expected - 0.5 * width - 1.0).max(0.0) as usize;
    let run = match grid.run_at(y, from as i64) {
        Some(run) => run,
        None => grid.next_run(y, from)?,
    };
    (run.touches(last) && (run.left as f64) <= expected + 0.5 * width + 1.0).then_some(run)
}

/// Number of samples up to the last one of which an edge is seen.
pub(super) fn visible(samples: &[Sample]) -> usize {
    samples.iter().rposition(|sample| sample.edges == 2).map_or(0, |last| last + 1)
}
