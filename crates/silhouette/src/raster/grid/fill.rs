//! Polygons into samples: narrow ones a word for each row, wide ones edge by edge.

use super::{Corner, Grid};

/// Columns that the narrow path holds in one word.
const NARROW: f32 = 63.0;
/// Rows that it does at a time: few for leaves, whose masks then need little clearing, or many.
const LOW: usize = 16;
const HIGH: usize = 64;
/// How far the samples of a row lie to the right of the middle of their columns, in 65,536ths of a
/// column: other places in each row, so that upright edges are seen eight times as finely. The mean is
/// 0.
const SKEW: [i32; 8] = [-28_672, 4_096, -12_288, 20_480, -20_480, 12_288, -4_096, 28_672];

impl Grid {
    /// Fills a polygon, convex or not (even-odd). Corners that are not finite draw nothing.
    #[inline]
    pub(crate) fn fill(&mut self, corners: &[Corner]) {
        let (mut left, mut right) = (f32::INFINITY, f32::NEG_INFINITY);
        let (mut top, mut bottom) = (f32::INFINITY, f32::NEG_INFINITY);
        let mut sum = 0.0;
        for &[x, y] in corners {
            left = if x < left { x } else { left };
            right = if x > right { x } else { right };
            top = if y < top { y } else { top };
            bottom = if y > bottom { y } else { bottom };
            sum += x + y;
        }
        let (wide, high) = self.extent();
        // A sum is finite only where every corner is.
        if !(sum.is_finite() && right > 0.0 && left < wide && bottom > 0.0 && top < high) {
            return;
        }
        let first = ceil_half(top).max(0);
        let last = ceil_half(bottom.min(high));
        if first >= last {
            return;
        }
        let (first, last) = (first as usize, last as usize);
        if right - left < NARROW && left >= 0.0 && right <= wide {
            let origin = left as u32;
            let mut start = first;
            while last - start > LOW {
                let end = (start + HIGH).min(last);
                self.fill_narrow::<HIGH>(corners, origin, start, end);
                start = end;
                if start == last {
                    return;
                }
            }
            self.fill_narrow::<LOW>(corners, origin, start, last);
        } else {
            self.fill_wide(corners, (left, right), first, last);
        }
    }

    /// Whether every sample of the box from `left`, `top` to `right`, `bottom` is set, so that nothing
    /// inside it needs drawing. Boxes wider than a word or across an edge of the grid count as not.
    #[inline]
    pub(crate) fn is_covered(&self, left: f32, right: f32, top: f32, bottom: f32) -> bool {
        let (wide, high) = self.extent();
        // Also false where a number is none.
        if !(left >= 0.0 && right <= wide && top >= 0.0 && bottom <= high && right - left < NARROW) {
            return false;
        }
        let (origin, end) = (left as usize, (right as usize + 1).min(wide as usize));
        let (first, last) = (top as usize, (bottom as usize + 1).min(high as usize));
        let (word, shift) = (origin / 64, origin % 64);
        let mask = u64::MAX >> (64 - (end - origin));
        let (low, high) = (mask << shift, if shift == 0 { 0 } else { mask >> (64 - shift) });
        let stride = self.words_per_row;
        self.words[first * stride..last * stride]
            .chunks_exact(stride)
            .all(|line| line[word] & low == low && (high == 0 || line[word + 1] & high == high))
    }

    /// Rows `first..last`, at most `ROWS`, of a polygon at most a word wide and inside the grid from
    /// left to right. `origin` is the column of samples that it starts in.
    ///
    /// Each crossing of an edge with a row flips all samples to its right; what is left set after
    /// the last edge is the inside.
    #[inline]
    fn fill_narrow<const ROWS: usize>(&mut self, corners: &[Corner], origin: u32, first: usize, last: usize) {
        let mut rows = [0_u64; ROWS];
        let (base_x, base_y) = (origin as f32 - 0.5, first as f32);
        let count = last - first;
        // The first row whose samples are at or below `y`, 0 to `count`.
        let row_of = |y: f32| {
            let y = (y - base_y).clamp(0.0, count as f32);
            ((fixed(y + (0.5 - 1.0 / 65536.0)) >> 16) as usize).min(count)
        };
        let mut p = corners[corners.len() - 1];
        let mut p_row = row_of(p[1]);
        for &q in corners {
            let q_row = row_of(q[1]);
            let (from, to) = if p_row < q_row { (p_row, q_row) } else { (q_row, p_row) };
            if from < to {
                let slope = (q[0] - p[0]) / (q[1] - p[1]);
                let x = p[0] - base_x + (from as f32 + 0.5 + base_y - p[1]) * slope;
                // An edge steeper than the clamp crosses a single row.
                let (mut x, slope) = (fixed(x.clamp(0.0, 63.0)), fixed(slope.clamp(-63.0, 63.0)));
                for (row, i) in rows[from..to].iter_mut().zip(first + from..) {
                    // First sample at or right of the crossing.
                    let column = (x - SKEW[i % SKEW.len()]).max(0) >> 16;
                    *row ^= u64::MAX << (column & 63);
                    x = x.wrapping_add(slope).clamp(0, 63 << 16);
                }
            }
            (p, p_row) = (q, q_row);
        }
        let stride = self.words_per_row;
        let (word, shift) = (origin as usize / 64, origin % 64);
        let rows = &rows[..count];
        let lines = self.words[first * stride..last * stride].chunks_exact_mut(stride);
        if shift == 0 {
            for (line, bits) in lines.zip(rows) {
                line[word] |= bits;
            }
        } else if word + 1 < stride {
            for (line, bits) in lines.zip(rows) {
                let pair = &mut line[word..word + 2];
                pair[0] |= bits << shift;
                pair[1] |= bits >> (64 - shift);
            }
        } else {
            for (line, bits) in lines.zip(rows) {
                line[word] |= bits << shift;
            }
        }
    }

    /// Any polygon, edge by edge: each crossing with a row flips all samples to its right, of which only the first
    /// is marked at first.
    fn fill_wide(&mut self, corners: &[Corner], (left, right): (f32, f32), first: usize, last: usize) {
        let (wide, _) = self.extent();
        let from_word = left.clamp(0.0, wide) as usize / 64;
        let to_word = (right.clamp(0.0, wide) as usize / 64 + 1).min(self.words_per_row);
        if from_word >= to_word {
            return;
        }
        let across = to_word - from_word;
        let mut flips = std::mem::take(&mut self.flips);
        flips.clear();
        flips.resize(across * (last - first), 0);
        let mut p = corners[corners.len() - 1];
        for &q in corners {
            let (upper, lower) = if p[1] < q[1] { (p[1], q[1]) } else { (q[1], p[1]) };
            // Rows whose samples are at or below the upper end and above the lower one.
            let start = ceil_half(upper.clamp(first as f32, last as f32 + 1.0)) as usize;
            let end = ceil_half(lower.min(last as f32)).max(0) as usize;
            for row in start.max(first)..end.min(last) {
                let x = p[0] + (row as f32 + 0.5 - p[1]) * (q[0] - p[0]) / (q[1] - p[1]);
                let skew = SKEW[row % SKEW.len()] as f32 / 65536.0;
                // First sample at or right of the crossing.
                let column = ceil_half((x - skew).clamp(0.0, wide)) as usize;
                let column = column.max(from_word * 64) - from_word * 64;
                if column < across * 64 {
                    flips[(row - first) * across + column / 64] ^= 1 << (column % 64);
                }
            }
            p = q;
        }
        let lines = self.words[first * self.words_per_row..].chunks_exact_mut(self.words_per_row);
        for (line, flips) in lines.zip(flips.chunks_exact(across)) {
            let mut is_inside = 0;
            for (word, &flips) in line[from_word..to_word].iter_mut().zip(flips) {
                let inside = parities(flips) ^ is_inside;
                *word |= inside;
                is_inside = 0_u64.wrapping_sub(inside >> 63);
            }
        }
        self.flips = flips;
    }
}

/// The first row (or column) whose samples, which lie in its middle, are at or beyond `v`: the
/// ceiling of v − 1/2. For |v| below 2³⁰; without the call that the ceiling itself would be.
#[inline]
fn ceil_half(v: f32) -> i32 {
    let v = v - 0.5;
    let whole = v as i32;
    whole + i32::from(whole as f32 != v && v > 0.0)
}

/// `v`, from −64 to below 64, times 65,536 as an integer.
///
/// Numbers from 128 to 256 have their last bit at 2⁻¹⁶, so that adding 192 leaves the fixed-point
/// number in the low bits: two instructions, where a checked conversion takes ten.
#[inline]
fn fixed(v: f32) -> i32 {
    const SHIFT: f32 = 192.0;
    (v + SHIFT).to_bits().wrapping_sub(SHIFT.to_bits()) as i32
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
