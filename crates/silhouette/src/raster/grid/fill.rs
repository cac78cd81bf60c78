//! Polygons into samples, a word for each row.

use super::{Corner, Grid};
use glam::{Vec4, Vec4Swizzles as _};

/// Columns that the narrow path holds in one word.
const NARROW: f32 = 63.0;
/// Columns of quadrilaterals whose edges cannot leave the word.
const SLIM: f32 = 61.0;
/// Rows that it does at a time: few for leaves, whose masks then need little clearing, or many.
const LOW: usize = 16;
const HIGH: usize = 64;
/// How far the samples of a row lie to the right of the middle of their columns, in 65,536ths of a
/// column: other places in each row, so that upright edges are seen eight times as finely. The mean is
/// 0.
pub(in crate::raster) const SKEW: [i32; 8] =
    [-28_672, 4_096, -12_288, 20_480, -20_480, 12_288, -4_096, 28_672];

/// [`SKEW`] of as many rows as are filled at once, from any row on.
const SKEWS: [i32; HIGH + SKEW.len()] = {
    let mut skews = [0; HIGH + SKEW.len()];
    let mut row = 0;
    while row < skews.len() {
        skews[row] = SKEW[row % SKEW.len()];
        row += 1;
    }
    skews
};
/// Words beyond the last column that may be written to, beside a column.
pub(super) const ROOM: usize = HIGH;

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
            if corners.len() <= 4 && right - left < SLIM && last - first <= HIGH && is_monotone(corners) {
                if last - first <= LOW {
                    self.fill_monotone::<LOW>(corners, origin, first, last);
                } else {
                    self.fill_monotone::<HIGH>(corners, origin, first, last);
                }
                return;
            }
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

    /// Whether a shape from `top` to `bottom` may cover samples: most of a crown of tiny leaves lies between their rows.
    #[inline]
    pub(crate) fn has_row(top: f32, bottom: f32) -> bool {
        // More than its corners may be off by rounding, wherever in a picture they are.
        const MARGIN: f32 = 0.01;
        // Further down than any picture goes.
        const FAR: f32 = 1e6;
        ceil_half((top - MARGIN).min(FAR)) < ceil_half((bottom + MARGIN).min(FAR))
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
        let band = Band::new(origin, first, last);
        let mut before = corners[corners.len() - 1];
        for some in corners.chunks(4) {
            band.edges(before, some).flip(&mut rows, skews(first));
            before = some[some.len() - 1];
        }
        self.write(&rows, origin, first, if ROWS == LOW { ROWS } else { last - first });
    }

    /// [`Grid::fill_narrow`] of up to four corners that no row leaves and enters again, and whose edges cannot leave
    /// the word: what is inside lies between the first and the last crossing, which are found for eight rows at a time.
    #[inline]
    fn fill_monotone<const ROWS: usize>(
        &mut self,
        corners: &[Corner],
        origin: u32,
        first: usize,
        last: usize,
    ) {
        let (mut enters, mut leaves) = ([64_i16; ROWS], [0_i16; ROWS]);
        let reached = (last - first).div_ceil(STEP) * STEP;
        let edges = Band::new(origin, first, last).edges(corners[corners.len() - 1], corners);
        edges.cross(&mut enters[..reached], &mut leaves[..reached], skews(first));
        let mut rows = [0_u64; ROWS];
        for ((row, &enter), &leave) in rows.iter_mut().zip(&enters[..reached]).zip(&leaves[..reached]) {
            *row = FROM[enter as usize % FROM.len()] & !FROM[leave as usize % FROM.len()];
        }
        self.write(&rows, origin, first, if ROWS == LOW { ROWS } else { last - first });
    }

    /// Sets the samples of `rows`, the first of which is row `first`, from column `origin` on. All of few rows are
    /// written, empty ones too, since how many there are is not to be guessed; beyond the last word there is room.
    #[inline]
    fn write<const ROWS: usize>(&mut self, rows: &[u64; ROWS], origin: u32, first: usize, count: usize) {
        let (word, shift) = (origin as usize / 64, origin % 64);
        let place = word * self.rows + first;
        for (word, bits) in self.words[place..][..count].iter_mut().zip(rows) {
            *word |= bits << shift;
        }
        for (word, bits) in self.words[place + self.rows..][..count].iter_mut().zip(rows) {
            *word |= bits >> 1 >> (63 - shift);
        }
    }
}

/// Set from a column on; from 64 on, none.
pub(super) const FROM: [u64; 128] = {
    let mut masks = [0; 128];
    let mut column = 0;
    while column < 64 {
        masks[column] = u64::MAX << column;
        column += 1;
    }
    masks
};

/// [`SKEW`] of the rows from `first` on.
#[inline]
fn skews(first: usize) -> &'static [i32; HIGH] {
    let skews = SKEWS[first % SKEW.len()..].first_chunk();
    skews.unwrap_or(&[0; HIGH])
}

/// Rows of samples that are filled at once.
struct Band {
    /// Half a column left of the first.
    origin: f32,
    /// The first row, and how many there are.
    first: f32,
    count: f32,
}

impl Band {
    const fn new(origin: u32, first: usize, last: usize) -> Self {
        Self { origin: origin as f32 - 0.5, first: first as f32, count: (last - first) as f32 }
    }

    /// The edges that lead from `before` to the first of `corners`, from there to the next, and so on: one to four.
    #[inline(always)]
    fn edges(&self, before: Corner, corners: &[Corner]) -> Edges {
        // An edge from a corner to itself crosses no row.
        let corner = |k: usize| corners[k.min(corners.len() - 1)];
        let [a, b, c, d] = [corner(0), corner(1), corner(2), corner(3)];
        let (qx, qy) = (Vec4::new(a[0], b[0], c[0], d[0]), Vec4::new(a[1], b[1], c[1], d[1]));
        let (px, py) = (qx.xxyz().with_x(before[0]), qy.xxyz().with_x(before[1]));
        let (from, to) = (self.row_of(py.min(qy)), self.row_of(py.max(qy)));
        let start = Vec4::from_array(from.map(|row| row as f32));
        let slope = (qx - px) / (qy - py);
        let x = px - self.origin + (start + 0.5 + self.first - py) * slope;
        // An edge steeper than the clamp crosses a single row.
        let slope = fixed(slope.max(Vec4::splat(-63.0)).min(Vec4::splat(63.0)));
        Edges { from, to, x: fixed(x.max(Vec4::ZERO).min(Vec4::splat(63.0))), slope }
    }

    /// The first rows, 0 to `count`, whose samples are at or below `y`.
    #[inline(always)]
    fn row_of(&self, y: Vec4) -> [i32; 4] {
        let y = (y - self.first).max(Vec4::ZERO).min(Vec4::splat(self.count));
        let [a, b, c, d] = fixed(y + (0.5 - 1.0 / 65536.0));
        [a >> 16, b >> 16, c >> 16, d >> 16]
    }
}

/// Four edges of a polygon: the rows that each crosses, where it crosses the first of them and how far it goes from one
/// to the next, in 65,536ths of a column.
struct Edges {
    from: [i32; 4],
    to: [i32; 4],
    x: [i32; 4],
    slope: [i32; 4],
}

impl Edges {
    /// Flips what is to the right of each edge.
    #[inline(always)]
    fn flip(&self, rows: &mut [u64], skews: &[i32; HIGH]) {
        for k in 0..4 {
            let range = self.from[k] as usize..self.to[k] as usize;
            let Some(rows) = rows.get_mut(range.clone()) else { continue };
            let (mut x, slope) = (self.x[k], self.slope[k]);
            for (row, skew) in rows.iter_mut().zip(&skews[range]) {
                // First sample at or right of the crossing.
                let column = (x - skew).max(0) >> 16;
                *row ^= u64::MAX << (column & 63);
                x = x.wrapping_add(slope).clamp(0, 63 << 16);
            }
        }
    }

    /// Moves where each row enters a shape and where it leaves it, so far as the edges cross it.
    #[inline(always)]
    fn cross(&self, enters: &mut [i16], leaves: &mut [i16], skews: &[i32; HIGH]) {
        for k in 0..4 {
            let (from, to, slope) = (self.from[k] as i16, self.to[k] as i16, self.slope[k]);
            // Where the edge, made longer, crosses each of the first rows.
            let start = self.x[k].wrapping_sub(slope.wrapping_mul(self.from[k]));
            let mut at: [i32; STEP] =
                std::array::from_fn(|j| start.wrapping_add(slope.wrapping_mul(j as i32)));
            let mut number: [i16; STEP] = std::array::from_fn(|j| j as i16);
            let steps = enters.chunks_exact_mut(STEP).zip(leaves.chunks_exact_mut(STEP));
            for ((enters, leaves), skews) in steps.zip(skews.chunks_exact(STEP)) {
                // In step, without branches, for the compiler to turn into vectors.
                for j in 0..STEP {
                    let column = (at[j].wrapping_sub(skews[j]).max(0) >> 16) as i16;
                    let crosses = number[j] >= from && number[j] < to;
                    enters[j] = enters[j].min(if crosses { column } else { 64 });
                    leaves[j] = leaves[j].max(if crosses { column } else { 0 });
                    at[j] = at[j].wrapping_add(slope.wrapping_mul(STEP as i32));
                    number[j] += STEP as i16;
                }
            }
        }
    }
}

/// Whether a closed outline goes down once and up once, so that no row crosses it more than twice.
#[inline]
pub(super) fn is_monotone(corners: &[Corner]) -> bool {
    let mut before = corners[corners.len() - 1][1];
    let went_down = corners.len() > 1 && before > corners[corners.len() - 2][1];
    let (mut goes_down, mut turns) = (went_down, 0);
    for &[_, y] in corners {
        let down = y > before;
        turns += u32::from(down != goes_down);
        (before, goes_down) = (y, down);
    }
    turns <= 2
}

/// Rows whose crossings are found at a time.
const STEP: usize = 8;

/// Left, right, top and bottom of `corners`; `None` unless all are finite.
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
    (sum[0] + sum[1] + sum[2] + sum[3])
        .is_finite()
        .then(|| [low[0].min(low[2]), high[0].max(high[2]), low[1].min(low[3]), high[1].max(high[3])])
}

/// The first row (or column) whose samples, which lie in its middle, are at or beyond `v`: the
/// ceiling of v − 1/2. For |v| below 2³⁰; without the call that the ceiling itself would be.
#[inline]
pub(super) fn ceil_half(v: f32) -> i32 {
    let v = v - 0.5;
    let whole = v as i32;
    whole + i32::from(whole as f32 != v && v > 0.0)
}

/// Numbers from −64 to below 64, times 65,536 as integers.
///
/// Numbers from 128 to 256 have their last bit at 2⁻¹⁶, so that adding 192 leaves the fixed-point
/// number in the low bits: two instructions, where a checked conversion takes ten.
#[inline(always)]
fn fixed(v: Vec4) -> [i32; 4] {
    const SHIFT: f32 = 192.0;
    let whole = |v: f32| v.to_bits().wrapping_sub(SHIFT.to_bits()) as i32;
    let [a, b, c, d] = (v + SHIFT).to_array();
    [whole(a), whole(b), whole(c), whole(d)]
}
