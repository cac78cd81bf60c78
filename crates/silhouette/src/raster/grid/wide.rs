//! Shapes wider than a word, or across an edge of the picture.

use super::fill::{FROM, SKEW, ceil_half, is_monotone};
use super::{Corner, Grid};
use std::ops::Range;

/// Rows that are filled at a time.
const ROWS: usize = 64;
/// Words across up to which rows are filled one by one; from there on columns are, since the words of a row lie far
/// from each other.
const ROW_BY_ROW: usize = 8;
/// [`SKEW`] in columns, of as many rows as are filled at a time, from any row on.
const SKEWS: [f32; ROWS + SKEW.len()] = {
    let mut skews = [0.0; ROWS + SKEW.len()];
    let mut row = 0;
    while row < skews.len() {
        skews[row] = SKEW[row % SKEW.len()] as f32 / 65536.0;
        row += 1;
    }
    skews
};

impl Grid {
    /// Rows `first..last` of any polygon that reaches from `left` to `right`.
    pub(super) fn fill_wide(
        &mut self,
        corners: &[Corner],
        (left, right): (f32, f32),
        first: usize,
        last: usize,
    ) {
        let (wide, _) = self.extent();
        let from_word = left.clamp(0.0, wide) as usize / 64;
        let to_word = (right.clamp(0.0, wide) as usize / 64 + 1).min(self.words_per_row);
        if from_word >= to_word {
            return;
        }
        let is_monotone = is_monotone(corners);
        let mut start = first;
        while start < last {
            let rows = start..(start + ROWS).min(last);
            if is_monotone {
                self.fill_spans(&Spans::new(corners, wide, rows.clone()), from_word..to_word, rows.clone());
            } else {
                self.flip(corners, from_word..to_word, rows.clone());
            }
            start = rows.end;
        }
    }

    fn fill_spans(&mut self, spans: &Spans, across: Range<usize>, rows: Range<usize>) {
        let spans = spans.from.iter().zip(&spans.to).map(|(&from, &to)| (from as u32, to as u32));
        if across.len() <= ROW_BY_ROW {
            // Rows that are not crossed have none.
            for (row, (from, to)) in rows.zip(spans).filter(|(_, (from, to))| from < to) {
                let (first, last) = (from as usize / 64, to as usize / 64);
                let (start, end) = (FROM[from as usize % 64], !FROM[to as usize % 64]);
                if first == last {
                    self.words[first * self.rows + row] |= start & end;
                } else {
                    self.words[first * self.rows + row] |= start;
                    for word in first + 1..last {
                        self.words[word * self.rows + row] = u64::MAX;
                    }
                    // Maybe the one after the picture's last, of which nothing is inside.
                    self.words[last * self.rows + row] |= end;
                }
            }
        } else {
            for word in across {
                let column = &mut self.words[word * self.rows..][rows.clone()];
                for (samples, (from, to)) in column.iter_mut().zip(spans.clone()) {
                    *samples |= inside(from, to.max(from), word);
                }
            }
        }
    }

    /// Any polygon, edge by edge: each crossing with a row flips all samples to its right, of which only the first
    /// is marked at first.
    fn flip(&mut self, corners: &[Corner], across: Range<usize>, rows: Range<usize>) {
        let (wide, _) = self.extent();
        let (first, count) = (rows.start, rows.len());
        let mut flips = std::mem::take(&mut self.flips);
        flips.clear();
        flips.resize(across.len() * count, 0);
        each_edge(corners, &rows, |edge, rows| {
            for row in rows {
                let column = edge.column(row as f32, SKEWS[row % SKEW.len()], wide) as usize;
                let column = column.max(across.start * 64) - across.start * 64;
                if column < across.len() * 64 {
                    flips[column / 64 * count + row - first] ^= 1 << (column % 64);
                }
            }
        });
        // Whether the last sample of each row is inside, one word before.
        let mut entering = [0; ROWS];
        for (word, flips) in across.zip(flips.chunks_exact(count)) {
            let column = &mut self.words[word * self.rows..][rows.clone()];
            for ((word, &flips), entering) in column.iter_mut().zip(flips).zip(&mut entering) {
                let inside = parities(flips) ^ *entering;
                *word |= inside;
                *entering = 0_u64.wrapping_sub(inside >> 63);
            }
        }
        self.flips = flips;
    }
}

/// Samples `from..to` of a row, so far as they are in a word.
#[inline(always)]
fn inside(from: u32, to: u32, word: usize) -> u64 {
    let of_word = |column: u32| FROM[column.saturating_sub(word as u32 * 64).min(64) as usize];
    of_word(from) ^ of_word(to)
}

/// Where each of some rows enters a polygon and where it leaves, in samples; where it is not crossed it enters later
/// than it leaves.
struct Spans {
    from: [f32; ROWS],
    to: [f32; ROWS],
}

impl Spans {
    /// Of a polygon that no row leaves and enters again.
    fn new(corners: &[Corner], wide: f32, rows: Range<usize>) -> Self {
        let mut spans = Self { from: [f32::INFINITY; ROWS], to: [0.0; ROWS] };
        let skews = &SKEWS[rows.start % SKEW.len()..];
        each_edge(corners, &rows, |edge, crossed| {
            let places = crossed.start - rows.start..crossed.end - rows.start;
            let spans = spans.from[places.clone()].iter_mut().zip(&mut spans.to[places.clone()]);
            // In step, as far as the compiler will.
            for (((from, to), &skew), row) in spans.zip(&skews[places]).zip(crossed.start as u32..) {
                let column = edge.column(row as i32 as f32, skew, wide);
                *from = if column < *from { column } else { *from };
                *to = if column > *to { column } else { *to };
            }
        });
        spans
    }
}

/// An edge of a polygon.
struct Edge {
    p: Corner,
    q: Corner,
}

impl Edge {
    /// The first sample of `row` at or right of the edge, a whole number from 0 to `wide`.
    #[inline(always)]
    fn column(&self, row: f32, skew: f32, wide: f32) -> f32 {
        /// Adding and subtracting this rounds to the nearest integer.
        const ROUNDER: f32 = 8_388_608.0;
        let Self { p, q } = self;
        let x = p[0] + (row + 0.5 - p[1]) * (q[0] - p[0]) / (q[1] - p[1]);
        let x = (x - skew).max(0.0).min(wide) - 0.5;
        let nearest = (x + ROUNDER) - ROUNDER;
        nearest + if nearest < x { 1.0 } else { 0.0 }
    }
}

/// Calls `each` for the edges that cross any of `rows`, with the rows that they cross.
#[inline(always)]
fn each_edge(corners: &[Corner], rows: &Range<usize>, mut each: impl FnMut(&Edge, Range<usize>)) {
    let (first, last) = (rows.start, rows.end);
    let mut p = corners[corners.len() - 1];
    for &q in corners {
        let (upper, lower) = if p[1] < q[1] { (p[1], q[1]) } else { (q[1], p[1]) };
        // Rows whose samples are at or below the upper end and above the lower one.
        let start = ceil_half(upper.clamp(first as f32, last as f32 + 1.0)) as usize;
        let end = ceil_half(lower.min(last as f32)).max(0) as usize;
        let (start, end) = (start.max(first), end.min(last));
        if start < end {
            each(&Edge { p, q }, start..end);
        }
        p = q;
    }
}

/// Of each bit whether an odd number is set of it and those below.
#[inline]
const fn parities(bits: u64) -> u64 {
    let bits = bits ^ bits << 1;
    let bits = bits ^ bits << 2;
    let bits = bits ^ bits << 4;
    let bits = bits ^ bits << 8;
    let bits = bits ^ bits << 16;
    bits ^ bits << 32
}
