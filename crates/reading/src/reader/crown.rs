//! The outline of the tree, height by height, and the gaps within it.

use super::grid::Grid;
use super::trace::Rows;
use crate::reading::{CROWN_HEIGHTS, GAP_HEIGHTS, GAP_SIZES, Reading};

/// Gaps narrower than this part of the height are closed.
const CLOSING: f64 = 0.03;
/// Pieces of foliage are told apart by a square of this part of the height.
const CLUMP: f64 = 0.02;
/// A clump is at least this part of the crown.
const SMALLEST_CLUMP: f64 = 0.002;

/// Side in rows of the square that gaps are closed with.
pub(super) fn closing(rows: Rows) -> u32 {
    rows.part(CLOSING).max(2) as u32
}

/// Widths of gaps, in parts of the height, that bound the sizes of [`Reading::gap_sizes`].
const GAP_BOUNDS: [f64; GAP_SIZES - 1] = [0.01, 0.02, 0.04];

/// Reads the outline off `closed`, the tree with its gaps closed; `origin` is the column of the foot.
pub(super) fn outline(closed: &Grid, rows: Rows, origin: f64, reading: &mut Reading) {
    let scale = 1.0 / rows.count as f64;
    reading.crown.left.clear();
    reading.crown.right.clear();
    for i in 0..CROWN_HEIGHTS {
        let at = (i * (rows.count - 1) + (CROWN_HEIGHTS - 1) / 2) / (CROWN_HEIGHTS - 1);
        let (left, right) = closed.extent(rows.row(at)).map_or((0.0, 0.0), |(left, right)| {
            ((origin - left as f64) * scale, (right as f64 - origin) * scale)
        });
        reading.crown.left.push(left);
        reading.crown.right.push(right);
    }
}

/// Height in rows, of those from `bare` on, where the tree is widest, over a band of 3 % of the height; its width in
/// columns; and the part of the area that lies to the right of `origin` more than to the left.
pub(super) fn shape(closed: &Grid, rows: Rows, bare: usize, origin: f64) -> (f64, f64, f64) {
    let band = rows.part(0.03).max(1);
    let width = |height: usize| closed.extent(rows.row(height)).map_or(0, |(left, right)| right - left);
    let (mut sum, mut best, mut at) = (0, 0, bare);
    for height in bare..rows.count {
        sum += width(height);
        if height >= bare + band {
            sum -= width(height - band);
        }
        if sum > best {
            (best, at) = (sum, height);
        }
    }
    let crown = rows.ground - rows.count..rows.ground - bare;
    let left = closed.ink_left_of(crown.clone(), origin.round() as i64);
    let right = closed.ink_of_rows(crown) - left;
    let asymmetry = (right as f64 - left as f64) / ((right + left) as f64).max(1.0);
    (at as f64 + 0.5 - (band as f64 - 1.0) / 2.0, best as f64 / band as f64, asymmetry)
}

/// Gaps: their part of the crown, their course by height and their sizes. `gaps` is the closed crown, and becomes
/// what of it is paper.
pub(super) fn gaps(
    ink: &Grid,
    gaps: &mut Grid,
    spare: [&mut Grid; 2],
    rows: Rows,
    bare: usize,
    reading: &mut Reading,
) {
    let [opened, spare] = spare;
    let crown = rows.row(rows.count - 1)..rows.row(bare.min(rows.count - 1)) + 1;
    gaps.keep_rows(crown.clone());
    let area = gaps.ink_of_rows(crown.clone());
    let share = |part: u64, whole: u64| if whole == 0 { 0.0 } else { part as f64 / whole as f64 };
    reading.gap_by_height.clear();
    for i in 0..GAP_HEIGHTS {
        let height = |i: usize| i * rows.count / GAP_HEIGHTS;
        let band = rows.ground - height(i + 1)..rows.ground - height(i);
        let band = band.start.max(crown.start)..band.end.min(crown.end).max(band.start.max(crown.start));
        let whole = gaps.ink_of_rows(band.clone());
        reading.gap_by_height.push(share(whole - ink.ink_of_rows(band.clone()).min(whole), whole));
    }
    gaps.remove(ink);
    let paper = gaps.ink_of_rows(crown.clone());
    reading.gap_share = Some(share(paper, area));
    reading.gap_sizes.clear();
    opened.copy_from(gaps);
    let mut before = paper;
    for bound in GAP_BOUNDS {
        let side = (rows.part(bound).max(1) + 1) as u32;
        opened.open(side, spare);
        let left = opened.ink_of_rows(crown.clone());
        reading.gap_sizes.push(share(before.saturating_sub(left), area));
        before = left;
    }
    reading.gap_sizes.push(share(before, area));
}

/// Number of pieces of foliage: of the crown's ink, opened by a square of 2 % of the height.
pub(super) fn clumps(
    opened: &mut Grid,
    spare: &mut Grid,
    rows: Rows,
    bare: usize,
    pieces: &mut Pieces,
) -> u32 {
    let crown = rows.row(rows.count - 1)..rows.row(bare.min(rows.count - 1)) + 1;
    opened.keep_rows(crown.clone());
    opened.open(rows.part(CLUMP).max(2) as u32, spare);
    let least = (SMALLEST_CLUMP * opened.ink_of_rows(crown.clone()) as f64).ceil() as u64;
    pieces.count(opened, crown, least.max(4))
}

/// Memory for counting pieces.
#[derive(Clone, Debug, Default)]
pub(super) struct Pieces {
    /// Of each run: its parent in the forest of runs, and the ink of those below it.
    forest: Vec<(usize, u64)>,
    last: Vec<(super::grid::Run, usize)>,
    now: Vec<(super::grid::Run, usize)>,
}

impl Pieces {
    fn root(&mut self, mut i: usize) -> usize {
        while self.forest[i].0 != i {
            self.forest[i].0 = self.forest[self.forest[i].0].0;
            i = self.forest[i].0;
        }
        i
    }

    /// Number of connected pieces of at least `least` pixels.
    fn count(&mut self, grid: &Grid, rows: std::ops::Range<usize>, least: u64) -> u32 {
        self.forest.clear();
        self.last.clear();
        for y in rows {
            self.now.clear();
            let mut first = 0;
            for run in grid.runs(y) {
                let node = self.forest.len();
                self.forest.push((node, run.width() as u64));
                while first < self.last.len() && self.last[first].0.right < run.left {
                    first += 1;
                }
                let mut i = first;
                while i < self.last.len() && self.last[i].0.touches(run) {
                    let (a, b) = (self.root(self.last[i].1), self.root(node));
                    if a != b {
                        let ink = self.forest[b].1;
                        self.forest[a].1 += ink;
                        self.forest[b].0 = a;
                    }
                    i += 1;
                }
                self.now.push((run, node));
            }
            std::mem::swap(&mut self.last, &mut self.now);
        }
        let large = |(i, &(parent, ink)): (usize, &(usize, u64))| i == parent && ink >= least;
        self.forest.iter().enumerate().filter(|&entry| large(entry)).count() as u32
    }
}
