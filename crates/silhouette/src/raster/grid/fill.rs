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
        let (wide, high) = self.extent();
        let Some([left, right, top, bottom]) = bounds(corners) else { return };
        if !(right > 0.0 && left < wide && bottom > 0.0 && top < high) {
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
        let has = |word: usize, mask: u64| {
            let column = &self.words[word * self.rows..][first..last];
            column.iter().fold(mask, |both, row| both & row) == mask
        };
        has(word, low) && (high == 0 || has(word + 1, high))
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
        let (word, shift) = (origin as usize / 64, origin % 64);
        let place = word * self.rows + first;
        for (word, bits) in self.words[place..][..count].iter_mut().zip(&rows) {
            *word |= bits << shift;
        }
        // What lies beyond the last word is no part of the picture.
        if shift > 0
            && let Some(next) = self.words.get_mut(place + self.rows..place + self.rows + count)
        {
            for (word, bits) in next.iter_mut().zip(&rows) {
                *word |= bits >> (64 - shift);
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
                    flips[column / 64 * (last - first) + row - first] ^= 1 << (column % 64);
                }
            }
            p = q;
        }
        // Whether the last sample of each row is inside, one word before.
        let mut entering = std::mem::take(&mut self.entering);
        entering.clear();
        entering.resize(last - first, 0);
        for (word, flips) in (from_word..to_word).zip(flips.chunks_exact(last - first)) {
            let column = &mut self.words[word * self.rows..][first..last];
            for ((word, &flips), entering) in column.iter_mut().zip(flips).zip(&mut entering) {
                let inside = parities(flips) ^ *entering;
                *word |= inside;
                *entering = 0_u64.wrapping_sub(inside >> 63);
            }
        }
        self.entering = entering;
        self.flips = flips;
    }
}

/// Left, right, top and bottom of `corners`; none unless all are finite.
#[inline]
fn bounds(corners: &[Corner]) -> Option<[f32; 4]> {
    // Two corners at a time, which are the four lanes of a register.
    let (mut low, mut high, mut sum) = ([f32::INFINITY; 4], [f32::NEG_INFINITY; 4], [0.0; 4]);
    let mut add = |pair: [f32; 4]| {
        for (k, v) in pair.into_iter().enumerate() {
            low[k] = if v < low[k] { v } else { low[k] };
            high[k] = if v > high[k] { v } else { high[k] };
            sum[k] += v;
        }
    };
    let pairs = corners.chunks_exact(2);
    let odd = pairs.remainder();
    pairs.for_each(|pair| add([pair[0][0], pair[0][1], pair[1][0], pair[1][1]]));
    if let [[x, y]] = *odd {
        add([x, y, x, y]);
    }
    // A sum is finite only where every number is.
    (sum[0] + sum[1] + sum[2] + sum[3]).is_finite().then(|| {
        [low[0].min(low[2]), high[0].max(high[2]), low[1].min(low[3]), high[1].max(high[3])]
    })
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
