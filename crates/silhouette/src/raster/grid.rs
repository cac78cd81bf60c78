//! The sub-sample grid: eight samples across and a few down per pixel, one bit each.
//!
//! Shapes set the samples whose centres they cover, which keeps the mean coverage of anything, be it
//! however thin. A pixel is black where at least half its samples are.
//!
//! Each byte of a row is a pixel: counting its bits, and comparing with a half, is done for eight pixels
//! at once in the bytes of a word.

mod fill;
mod wide;

use crate::bitmap::Bitmap;
pub(super) use fill::SKEW;
use std::ops::Range;

/// Samples across each pixel, one byte of them.
pub(crate) const ACROSS: u32 = 8;

/// Columns of words: a word is eight pixels across, and those below it follow it in memory, so that small shapes stay
/// within a line or two of the cache.
#[derive(Clone, Debug, Default)]
pub(crate) struct Grid {
    /// Pixels across and down.
    width: u32,
    height: u32,
    /// Samples down each pixel.
    down: u32,
    words_per_row: usize,
    /// Rows of samples.
    rows: usize,
    /// A column more than there are, and some, so that shapes at the edge need no thought.
    words: Vec<u64>,
    /// Where rows of a wide shape change between outside and inside; kept for its memory.
    flips: Vec<u64>,
}

/// A corner of a polygon in samples: x to the right, y down.
pub(crate) type Corner = [f32; 2];

impl Grid {
    /// Clears the grid for a picture of this size with `down` samples down each pixel.
    pub(crate) fn reset(&mut self, width: u32, height: u32, down: u32) {
        self.width = width;
        self.height = height;
        self.down = down;
        self.words_per_row = (width as usize * ACROSS as usize).div_ceil(64);
        self.rows = (height * down) as usize;
        self.words.clear();
        self.words.resize((self.words_per_row + 1) * self.rows + fill::ROOM, 0);
    }

    /// Sets the samples of `other`, of the same size.
    pub(super) fn unite(&mut self, other: &Self) {
        debug_assert_eq!(self.words.len(), other.words.len(), "grids of one size");
        self.words.iter_mut().zip(&other.words).for_each(|(word, more)| *word |= more);
    }

    /// Pixels across and down, and samples down each pixel.
    pub(super) const fn size(&self) -> (u32, u32, u32) {
        (self.width, self.height, self.down)
    }

    /// Samples of a pixel, at most 128.
    pub(crate) const fn samples(&self) -> u8 {
        (ACROSS * self.down) as u8
    }

    /// Samples across and down the whole grid.
    fn extent(&self) -> (f32, f32) {
        ((self.width * ACROSS) as f32, (self.height * self.down) as f32)
    }

    /// Reduces the samples to pixels: black from half of them on, ties alternately.
    pub(crate) fn resolve(&self, out: &mut Bitmap) {
        out.reset(self.width, self.height);
        let half = Half::new(self.down);
        for word in 0..self.words_per_row {
            self.resolve_column(word, half, out);
        }
        mask_beyond(out);
    }

    /// Samples of ink in each pixel, row by row, 0 to `8 · down`.
    pub(crate) fn coverage(&self, out: &mut Vec<u8>) {
        out.clear();
        for y in 0..self.height {
            let row = (0..self.words_per_row).flat_map(|word| counts(self.pixels(word, y)).to_le_bytes());
            out.extend(row.take(self.width as usize));
        }
    }

    /// Moves the samples of a box, in words and rows of samples, to the end of `out`, row by row; the grid has none
    /// there after.
    pub(super) fn take(&mut self, across: Range<usize>, down: Range<usize>, out: &mut Vec<u64>) {
        for row in down {
            out.extend(across.clone().map(|word| std::mem::take(&mut self.words[word * self.rows + row])));
        }
    }

    /// Sets the words of a row of samples from `first` on.
    pub(super) fn set_line(&mut self, row: usize, first: usize, line: &[u64]) {
        for (word, &samples) in (first..).zip(line) {
            self.words[word * self.rows + row] = samples;
        }
    }

    /// Sets all samples of the pixels of row `y` that are black already: no more can be seen of them.
    pub(super) fn saturate(&mut self, y: u32, across: Range<usize>, half: Half) {
        for word in across {
            half.saturate(y, self.pixels_mut(word, y));
        }
    }

    /// Pixels of the picture.
    pub(super) const fn area(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// Sets all samples of the pixels that are black already, and marks them in `black`.
    pub(super) fn sweep(&mut self, black: &mut Bitmap) {
        black.reset(self.width, self.height);
        let half = Half::new(self.down);
        for word in 0..self.words_per_row {
            let column = self.words[word * self.rows..][..self.rows].chunks_exact_mut(self.down as usize);
            for (y, samples) in (0..self.height).zip(column) {
                let pixels = half.saturate(y, samples);
                if pixels != 0 {
                    black.row_mut(y)[word / 8] |= pixels << (word % 8 * 8);
                }
            }
        }
        mask_beyond(black);
    }

    /// Writes the pixels of a part of row `y` to `out`, a row of pixels, and clears their samples.
    pub(super) fn resolve_and_clear(&mut self, y: u32, across: Range<usize>, half: Half, out: &mut [u64]) {
        for word in across {
            let shift = word % 8 * 8;
            let samples = self.pixels_mut(word, y);
            let black = half.black(y, counts(samples));
            out[word / 8] = out[word / 8] & !(0xff << shift) | black << shift;
            samples.fill(0);
        }
    }

    /// Writes eight columns of pixels to `out`, which has none there.
    fn resolve_column(&self, word: usize, half: Half, out: &mut Bitmap) {
        let column = self.words[word * self.rows..][..self.rows].chunks_exact(self.down as usize);
        for (y, samples) in (0..self.height).zip(column) {
            out.row_mut(y)[word / 8] |= half.black(y, counts(samples)) << (word % 8 * 8);
        }
    }

    /// The samples of eight pixels of row `y`.
    fn pixels(&self, word: usize, y: u32) -> &[u64] {
        &self.words[word * self.rows + (y * self.down) as usize..][..self.down as usize]
    }

    fn pixels_mut(&mut self, word: usize, y: u32) -> &mut [u64] {
        &mut self.words[word * self.rows + (y * self.down) as usize..][..self.down as usize]
    }
}

/// Finds black pixels by the counts of their samples.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Half([u64; 2]);

impl Half {
    /// Half of the samples of a pixel with `down` rows of them.
    pub(super) fn new(down: u32) -> Self {
        // Adding this to a byte carries into its top bit where it is at least half of the samples, or
        // more than half for every other pixel: ties go to ink and paper alternately: with so few
        // samples they are many, and thin twigs would come out thicker by a twentieth.
        let half = u64::from(0x80 - (ACROSS * down / 2)) * LOW_BITS;
        Self([half - EVERY_OTHER, half - (EVERY_OTHER << 8)])
    }

    /// Which of eight pixels of row `y` are black, whose samples are counted in the bytes of `counts`.
    #[inline]
    pub(super) fn black(self, y: u32, counts: u64) -> u64 {
        let black = (counts + self.0[y as usize % 2]) & HIGH_BITS;
        // Gathers the eight top bits into one byte.
        (black >> 7).wrapping_mul(0x0102_0408_1020_4080) >> 56
    }

    /// Sets all samples of those of eight pixels of row `y` that are black already; returns which they are.
    #[inline]
    fn saturate(self, y: u32, samples: &mut [u64]) -> u64 {
        // Most of a picture is paper, and need not be counted.
        if samples.iter().fold(0, |all, row| all | row) == 0 {
            return 0;
        }
        let black = self.black(y, counts(samples));
        if black != 0 {
            let full = spread(black);
            samples.iter_mut().for_each(|row| *row |= full);
        }
        black
    }
}

/// A byte of ones for each bit of a byte.
#[inline]
fn spread(byte: u64) -> u64 {
    // A copy of the byte in each byte, then bit k of byte k alone, moved to its top and from there down to all eight.
    let bits = byte.wrapping_mul(LOW_BITS) & 0x8040_2010_0804_0201;
    let tops = (bits + (HIGH_BITS - LOW_BITS)) & HIGH_BITS;
    (tops >> 7).wrapping_mul(0xff)
}

const EVERY_OTHER: u64 = 0x0001_0001_0001_0001;
const LOW_BITS: u64 = 0x0101_0101_0101_0101;
const HIGH_BITS: u64 = 0x8080_8080_8080_8080;

/// Set samples in each of eight pixels, whose rows these are, in the bytes of a word.
fn counts(samples: &[u64]) -> u64 {
    samples.iter().map(|&row| count(row)).sum()
}

/// Set samples of one row in each of eight pixels, in the bytes of a word.
#[inline]
pub(super) fn count(v: u64) -> u64 {
    let v = v - (v >> 1 & 0x5555_5555_5555_5555);
    let v = (v & 0x3333_3333_3333_3333) + (v >> 2 & 0x3333_3333_3333_3333);
    (v + (v >> 4)) & 0x0f0f_0f0f_0f0f_0f0f
}

/// Clears the bits beyond the width.
fn mask_beyond(bitmap: &mut Bitmap) {
    let beyond = bitmap.width() % 64;
    if beyond != 0 {
        for y in 0..bitmap.height() {
            if let Some(last) = bitmap.row_mut(y).last_mut() {
                *last &= (1 << beyond) - 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(width: u32, height: u32, polygons: &[&[Corner]]) -> Bitmap {
        let mut grid = Grid::default();
        grid.reset(width, height, 4);
        for polygon in polygons {
            let corners: Vec<Corner> = polygon.iter().map(|c| [c[0] * 8.0, c[1] * 4.0]).collect();
            grid.fill(&corners);
        }
        let mut bitmap = Bitmap::default();
        grid.resolve(&mut bitmap);
        bitmap
    }

    #[test]
    fn narrow_and_wide_agree_with_a_point_test() {
        // A star-like polygon, small and large, inside and across the edges.
        let inside = |corners: &[Corner], x: f32, y: f32| {
            let mut inside = false;
            let mut p = corners[corners.len() - 1];
            for &q in corners {
                if (p[1] <= y) != (q[1] <= y) && x >= p[0] + (y - p[1]) * (q[0] - p[0]) / (q[1] - p[1]) {
                    inside = !inside;
                }
                p = q;
            }
            inside
        };
        for size in [0.7_f32, 2.0, 3.5, 9.0, 30.0] {
            for (cx, cy) in [(10.3, 9.7), (1.2, 2.0), (19.0, 19.5), (10.0, -1.0)] {
                let corners: Vec<Corner> = (0..9)
                    .map(|i| {
                        let angle = i as f32 * std::f32::consts::TAU / 9.0;
                        let r = size * if i % 2 == 0 { 1.0 } else { 0.45 };
                        [cx + r * angle.cos(), cy + r * angle.sin()]
                    })
                    .collect();
                let bitmap = drawn(20, 20, &[&corners]);
                let expected = Bitmap::from_fn(20, 20, |px, py| {
                    let hits = (0..32)
                        .filter(|k| {
                            let (x, y) = (
                                px as f32 + (k % 8) as f32 / 8.0 + 0.0625,
                                py as f32 + (k / 8) as f32 / 4.0 + 0.125,
                            );
                            inside(&corners, x, y)
                        })
                        .count();
                    hits > 16 || (hits == 16 && (px + py) % 2 == 1)
                });
                let off = bitmap.differing(&expected);
                assert!(
                    off <= 1,
                    "size {size} at {cx}, {cy}: {off} pixels\n{}\n{}",
                    bitmap.to_ascii(),
                    expected.to_ascii()
                );
            }
        }
    }

    #[test]
    fn thin_shapes_keep_their_coverage_in_the_mean() {
        let mut grid = Grid::default();
        grid.reset(64, 64, 4);
        // Hundreds of slivers a twentieth of a pixel wide at odd angles.
        let mut area = 0.0;
        for i in 0..400 {
            let (x, y, angle) = (4.0 + (i % 20) as f32 * 2.9, 4.0 + (i / 20) as f32 * 2.7, i as f32 * 0.37);
            let (dx, dy) = (angle.cos(), angle.sin());
            let (nx, ny) = (-dy * 0.025, dx * 0.025);
            let corner = |s: f32, n: f32| [(x + dx * s + nx * n) * 8.0, (y + dy * s + ny * n) * 4.0];
            grid.fill(&[corner(0.0, 1.0), corner(2.0, 1.0), corner(2.0, -1.0), corner(0.0, -1.0)]);
            area += 2.0 * 0.05;
        }
        let mut coverage = Vec::new();
        grid.coverage(&mut coverage);
        let drawn = coverage.iter().map(|&c| f32::from(c)).sum::<f32>() / 32.0;
        assert!((drawn / area - 1.0).abs() < 0.1, "{drawn} of {area}");
    }

    #[test]
    fn in_a_covered_box_nothing_is_left_to_draw() {
        let mut grid = Grid::default();
        grid.reset(40, 40, 4);
        grid.fill(&[[70.0, 31.0], [251.5, 40.0], [203.0, 131.0], [61.0, 120.0]]);
        let mut covered = 0;
        for i in 0..4000_u16 {
            let [x, y] = [f32::from(i % 79) * 4.13 - 3.0, f32::from(i % 83) * 2.01 - 3.0];
            let (w, h) = (f32::from(i % 61) + 0.3, f32::from(i % 13) + 0.7);
            if grid.is_covered(x, x + w, y, y + h) {
                covered += 1;
                let mut after = grid.clone();
                after.fill(&[[x, y], [x + w, y], [x + w, y + h], [x, y + h]]);
                assert!(after.words == grid.words, "box {x} {y}, {w} by {h}");
            }
        }
        assert!((400..2000).contains(&covered), "{covered}");
        assert!(!grid.is_covered(f32::NAN, 100.0, 60.0, 61.0) && !grid.is_covered(-1.0, 1.0, 60.0, 61.0));
    }

    #[test]
    fn quadrilaterals_and_other_shapes_are_filled_alike() {
        // A corner twice is no corner, but makes a pentagon, which is filled edge by edge.
        for i in 0..20_000_u32 {
            let unit = |k: u32| (f64::from(i * 8 + k) * 0.618_034).fract() as f32;
            let (left, top) = (10.0 + 200.0 * unit(0), 20.0 * unit(1) - 4.0);
            let [a, b, c, d]: [Corner; 4] = std::array::from_fn(|k| {
                let k = k as u32 * 2 + 2;
                [left + 60.0 * unit(k), top + 14.0 * unit(k + 1)]
            });
            let mut grids = [Grid::default(), Grid::default()];
            grids.iter_mut().for_each(|grid| grid.reset(40, 8, 4));
            grids[0].fill(&[a, b, c, d]);
            grids[1].fill(&[a, b, c, d, d]);
            assert!(grids[0].words == grids[1].words, "shape {i}: {a:?} {b:?} {c:?} {d:?}");
        }
    }

    #[test]
    fn wide_shapes_are_filled_alike_by_spans_and_by_flips() {
        // Lines from a corner up and down, and back, cover nothing, but make a shape that is filled by flips.
        let mut wide = 0;
        for i in 0..2000_u32 {
            let unit = |k: u32| (f64::from(i * 16 + k) * 0.618_034).fract() as f32;
            let (reach, high) = ([90.0, 400.0, 900.0][i as usize % 3], 30.0 + 200.0 * unit(9));
            let (left, top) = (700.0 * unit(0) - 100.0, 200.0 * unit(1) - 40.0);
            let corner = |k: u32| [left + reach * unit(k), top + high * unit(k + 1)];
            let [a, b, c] = [corner(2), corner(4), corner(6)];
            // Pushed in or out.
            let dent = [a[0].midpoint(b[0]) + reach * (unit(10) - 0.5), a[1].midpoint(b[1])];
            let corners = [a, dent, b, c];
            let ends = |over: fn(f32, f32) -> f32| corners.iter().map(|c| c[0]).reduce(over).unwrap();
            let (from, to) = (ends(f32::min), ends(f32::max));
            if to - from < 64.0 && from >= 0.0 && to <= 800.0 {
                continue;
            }
            let [up, down] = [[c[0], c[1] - 300.0], [c[0], c[1] + 300.0]];
            let mut grids = [Grid::default(), Grid::default()];
            grids.iter_mut().for_each(|grid| grid.reset(100, 64, 4));
            grids[0].fill(&corners);
            grids[1].fill(&[a, dent, b, c, up, c, down, c]);
            assert!(grids[0].words == grids[1].words, "shape {i}: {corners:?}");
            let ink: u32 = grids[0].words.iter().map(|word| word.count_ones()).sum();
            wide += u32::from(ink > 2000);
        }
        assert!(wide > 500, "{wide}");
    }

    #[test]
    fn shapes_without_a_row_draw_nothing() {
        let mut without = 0;
        for i in 0..4000_u16 {
            let (top, high) = (f32::from(i % 97) * 0.37 - 3.0, f32::from(i % 41) * 0.05);
            let mut grid = Grid::default();
            grid.reset(8, 8, 4);
            grid.fill(&[[3.0, top], [40.0, top], [40.0, top + high], [3.0, top + high]]);
            let is_empty = grid.words.iter().all(|&word| word == 0);
            if !Grid::has_row(top, top + high) {
                without += 1;
                assert!(is_empty, "from {top} to {}", top + high);
            }
        }
        assert!(without > 800, "{without}");
        assert!(Grid::has_row(-1e30, 1e30) && !Grid::has_row(1e30, 1e31) && !Grid::has_row(f32::NAN, 1.0));
    }

    #[test]
    fn nonsense_draws_nothing() {
        let bitmap = drawn(
            8,
            8,
            &[
                &[[f32::NAN, 1.0], [4.0, 4.0], [1.0, 6.0]],
                &[[1.0, f32::INFINITY], [4.0, 4.0], [1.0, 6.0]],
                &[[20.0, 20.0], [30.0, 20.0], [25.0, 30.0]],
                &[[1.0, 1.0], [1.0, 1.0], [1.0, 1.0]],
            ],
        );
        assert_eq!(bitmap.ink(), 0);
    }
}
