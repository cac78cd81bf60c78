//! Pictures as flat words in which whole rows are shifted at once.
//!
//! Every row begins with a word of paper, so that a shift by less than 64 pixels reaches only paper, and ink that
//! grows to the right by less meets no other row.

use pleach_silhouette::Bitmap;

/// Longest side of a square that pictures are closed with: ink grows to the right by one pixel less.
pub(super) const MAX_CLOSING: u32 = 64;

/// A picture of ink and paper with a margin; row 0 is its top row.
#[derive(Clone, Debug, Default)]
pub(super) struct Grid {
    /// Words of a row, with the word of paper before it.
    stride: usize,
    rows: usize,
    words: Vec<u64>,
}

/// Most times that holes are looked for from above or from below: mazes have more turns than trees.
const MAX_SWEEPS: usize = 31;

/// What one pass does with a word and a shifted one.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Combine {
    And,
    Or,
}

/// Combines two pictures without a shift within words.
fn combined(to: &mut [u64], one: &[u64], other: &[u64], combine: impl Fn(u64, u64) -> u64) {
    for ((to, one), other) in to.iter_mut().zip(one).zip(other) {
        *to = combine(*one, *other);
    }
}

impl Grid {
    /// Makes it an empty picture of `width` × `rows` pixels; allocates only if it grows.
    pub(super) fn reset(&mut self, width: usize, rows: usize) {
        self.stride = width.div_ceil(64) + 1;
        self.rows = rows;
        self.words.clear();
        // The last word is the paper to the right of the last row.
        self.words.resize(self.stride * rows + 1, 0);
    }

    /// Makes it an empty picture of the size of `other`.
    pub(super) fn reset_like(&mut self, other: &Self) {
        (self.stride, self.rows) = (other.stride, other.rows);
        self.words.clear();
        self.words.resize(other.words.len(), 0);
    }

    pub(super) fn copy_from(&mut self, other: &Self) {
        (self.stride, self.rows) = (other.stride, other.rows);
        self.words.clone_from(&other.words);
    }

    /// The words of row `y`, without paper.
    pub(super) fn row(&self, y: usize) -> &[u64] {
        &self.words[y * self.stride + 1..(y + 1) * self.stride]
    }

    pub(super) fn row_mut(&mut self, y: usize) -> &mut [u64] {
        &mut self.words[y * self.stride + 1..(y + 1) * self.stride]
    }

    /// Copies the columns from `left` on of the rows `top..bottom` of `picture` to the rows from `margin` on.
    pub(super) fn crop(&mut self, picture: &Bitmap, left: u32, top: u32, bottom: u32, margin: usize) {
        let (word, bit) = (left as usize / 64, left % 64);
        for (y, from) in (margin..).zip(top..bottom) {
            let from = &picture.row(from)[word.min(picture.row(from).len())..];
            for (i, to) in self.row_mut(y).iter_mut().enumerate() {
                let low = from.get(i).copied().unwrap_or(0) >> bit;
                let high = if bit == 0 { 0 } else { from.get(i + 1).copied().unwrap_or(0) << (64 - bit) };
                *to = low | high;
            }
        }
    }

    /// Number of inked pixels of these rows.
    pub(super) fn ink_of_rows(&self, rows: std::ops::Range<usize>) -> u64 {
        let words = &self.words[rows.start * self.stride..rows.end.max(rows.start) * self.stride];
        words.iter().map(|word| u64::from(word.count_ones())).sum()
    }

    /// Removes all ink outside of these rows.
    pub(super) fn keep_rows(&mut self, rows: std::ops::Range<usize>) {
        let (from, to) = (rows.start * self.stride, rows.end * self.stride);
        self.words[..from].fill(0);
        self.words[to..].fill(0);
    }

    /// One pass: every word with the word `down` rows below and `right` pixels to the right of it (either may be
    /// negative), which is paper outside of the picture.
    fn pass(&self, right: i32, down: i32, combine: Combine, out: &mut Self) {
        out.reset_shape(self);
        let (words, count) = (&self.words[..], self.words.len());
        let bit = right.rem_euclid(64) as u32;
        let offset = down as isize * self.stride as isize + right.div_euclid(64) as isize;
        // Words whose partner and whose partner's neighbour are in the array.
        let first = (-offset).clamp(0, count as isize) as usize;
        let last = (count as isize - 1 - offset).clamp(0, count as isize) as usize;
        // A step beyond the whole picture has none.
        let (first, last) = if first < last { (first, last) } else { (0, 0) };
        let at = |i: usize| if first < last { (i as isize + offset) as usize } else { 0 };
        let (low, high) = (&words[at(first)..at(last)], &words[at(first) + 1..at(last) + 1]);
        let own = &words[first..last];
        let to = &mut out.words[first..last];
        let (carry, keep) = if bit == 0 { (0, 0) } else { (64 - bit, u64::MAX) };
        match (combine, bit) {
            (Combine::And, 0) => combined(to, own, low, |own, low| own & low),
            (Combine::Or, 0) => combined(to, own, low, |own, low| own | low),
            (Combine::And, _) => {
                for (((to, own), low), high) in to.iter_mut().zip(own).zip(low).zip(high) {
                    *to = own & ((low >> bit) | (high << carry));
                }
            }
            (Combine::Or, _) => {
                for (((to, own), low), high) in to.iter_mut().zip(own).zip(low).zip(high) {
                    *to = own | (low >> bit) | (high << carry);
                }
            }
        }
        // At both ends of the array one or both partners are missing.
        let word = |i: isize| usize::try_from(i).ok().and_then(|i| words.get(i)).copied().unwrap_or(0);
        for i in (0..first).chain(last..count) {
            let partner = i as isize + offset;
            let shifted = (word(partner) >> bit) | ((word(partner + 1) << carry) & keep);
            out.words[i] = match combine {
                Combine::And => words[i] & shifted,
                Combine::Or => words[i] | shifted,
            };
        }
    }

    fn reset_shape(&mut self, other: &Self) {
        (self.stride, self.rows) = (other.stride, other.rows);
        self.words.resize(other.words.len(), 0);
    }

    /// Combines every pixel with the next `count - 1` in steps of (`right`, `down`); `spare` is memory.
    fn chain(&mut self, step: (i32, i32), count: u32, combine: Combine, spare: &mut Self) {
        self.chain_on(step, 1, count, combine, spare);
    }

    /// The same where pixels are combined with the next `reached - 1` already.
    fn chain_on(
        &mut self,
        (right, down): (i32, i32),
        mut reached: u32,
        count: u32,
        combine: Combine,
        spare: &mut Self,
    ) {
        while reached < count {
            let step = reached.min(count - reached) as i32;
            self.pass(right * step, down * step, combine, spare);
            std::mem::swap(self, spare);
            reached += step as u32;
        }
    }

    /// Makes it the ink of `from` where a line of `count` pixels, 2 at least, in steps of (`right`, `down`) begins.
    pub(super) fn erode_line(&mut self, from: &Self, step: (i32, i32), count: u32, spare: &mut Self) {
        from.pass(step.0, step.1, Combine::And, self);
        self.chain_on(step, 2, count, Combine::And, spare);
    }

    /// Ink where a square of `side` pixels fits: its upper left pixel.
    pub(super) fn erode(&mut self, side: u32, spare: &mut Self) {
        self.chain((1, 0), side, Combine::And, spare);
        self.chain((0, 1), side, Combine::And, spare);
    }

    /// The squares of `side` pixels whose lower right pixel is ink.
    fn dilate_back(&mut self, side: u32, spare: &mut Self) {
        self.chain((-1, 0), side, Combine::Or, spare);
        self.chain((0, -1), side, Combine::Or, spare);
    }

    /// Morphological opening: the ink that squares of `side` pixels within it cover (Serra 1982).
    pub(super) fn open(&mut self, side: u32, spare: &mut Self) {
        self.erode(side, spare);
        self.dilate_back(side, spare);
    }

    /// Morphological closing by a square of `side` pixels, at most [`MAX_CLOSING`]; below the ink there must be
    /// as many rows of margin.
    pub(super) fn close(&mut self, side: u32, spare: &mut Self) {
        let side = side.min(MAX_CLOSING);
        self.dilate_back(side, spare);
        self.erode(side, spare);
    }

    /// Closing within columns only: gaps of fewer than `rows` rows are filled.
    pub(super) fn close_columns(&mut self, rows: u32, spare: &mut Self) {
        self.chain((0, -1), rows, Combine::Or, spare);
        self.chain((0, 1), rows, Combine::And, spare);
    }

    /// Fills what paper does not reach from outside, by rows and columns; `outside` is memory.
    pub(super) fn fill_holes(&mut self, outside: &mut Self) {
        outside.reset_like(self);
        let (rows, stride) = (self.rows, self.stride);
        // Paper above the first row is outside. Beside a row it is too. The word of paper before a row of `outside`
        // says whether the row has changed since the next row in the other direction was last flooded.
        for y in 0..rows {
            outside.words[y * stride] = u64::from(self.flood_row(outside, y, y.checked_sub(1)));
        }
        let mut is_down = false;
        for _ in 0..MAX_SWEEPS {
            let mut is_changing = false;
            let mut is_new = false;
            for i in 1..rows {
                let (y, from) = if is_down { (i, i - 1) } else { (rows - 1 - i, rows - i) };
                // In the row before, changes of this sweep and of the last one are news.
                let is_news = is_new || outside.words[from * stride] != 0;
                outside.words[from * stride] = u64::from(is_new);
                is_new = is_news && self.flood_row(outside, y, Some(from));
                is_changing |= is_new;
            }
            if !is_changing {
                break;
            }
            if let Some(last) = rows.checked_sub(1) {
                let row = if is_down { last } else { 0 };
                outside.words[row * stride] = u64::from(is_new);
            }
            is_down = !is_down;
        }
        for (own, outside) in self.words.iter_mut().zip(&outside.words) {
            *own = !outside;
        }
        self.words.iter_mut().step_by(stride).for_each(|word| *word = 0);
        if let Some(last) = self.words.last_mut() {
            *last = 0;
        }
    }

    /// Spreads `outside` in row `y` over the paper of this picture, from itself, from the row `from` and from both
    /// ends; whether there is more than before.
    fn flood_row(&self, outside: &mut Self, y: usize, from: Option<usize>) -> bool {
        let (start, end) = (y * self.stride + 1, (y + 1) * self.stride);
        let mut is_new = false;
        // To the right: paper as a number, to which seeds are added, carries through its runs of ones.
        let mut carry = true;
        for i in start..end {
            let paper = !self.words[i];
            let above = from.map_or(u64::MAX, |from| outside.words[from * self.stride + 1 + (i - start)]);
            let seeds = (outside.words[i] | above) & paper;
            let (sum, first) = paper.overflowing_add(seeds);
            let (sum, second) = sum.overflowing_add(u64::from(carry));
            carry = first || second;
            let found = paper & (!sum | seeds);
            is_new |= found != outside.words[i];
            outside.words[i] = found;
        }
        if (start..end).all(|i| outside.words[i] == !self.words[i]) {
            return is_new;
        }
        let mut carry = true;
        for i in (start..end).rev() {
            let paper = (!self.words[i]).reverse_bits();
            let seeds = outside.words[i].reverse_bits();
            let (sum, first) = paper.overflowing_add(seeds);
            let (sum, second) = sum.overflowing_add(u64::from(carry));
            carry = first || second;
            let found = (paper & (!sum | seeds)).reverse_bits();
            is_new |= found != outside.words[i];
            outside.words[i] = found;
        }
        is_new
    }

    /// Removes the ink of `other`.
    pub(super) fn remove(&mut self, other: &Self) {
        for (own, other) in self.words.iter_mut().zip(&other.words) {
            *own &= !other;
        }
    }

    /// Number of edges between ink and paper: (between columns, between rows).
    pub(super) fn edges(&self) -> (u64, u64) {
        let mut across = 0;
        let mut last = 0;
        for &word in &self.words {
            across += u64::from((word ^ ((word << 1) | (last >> 63))).count_ones());
            last = word;
        }
        let pairs = self.words.iter().zip(&self.words[self.stride.min(self.words.len())..]);
        let down: u64 = pairs.map(|(a, b)| u64::from((a ^ b).count_ones())).sum();
        (across, down)
    }

    /// Number of pixels of ink without ink in the three pixels above them, and in those below.
    pub(super) fn ends(&self) -> (u64, u64) {
        let spread = |row: &[u64], i: usize| {
            let (before, after) =
                (if i > 0 { row[i - 1] >> 63 } else { 0 }, row.get(i + 1).map_or(0, |w| w << 63));
            row[i] | (row[i] << 1) | before | (row[i] >> 1) | after
        };
        let (mut up, mut down) = (0, 0);
        for y in 1..self.rows.saturating_sub(1) {
            let (above, own, below) = (self.row(y - 1), self.row(y), self.row(y + 1));
            for (i, word) in own.iter().enumerate() {
                up += u64::from((word & !spread(above, i)).count_ones());
                down += u64::from((word & !spread(below, i)).count_ones());
            }
        }
        (up, down)
    }

    /// Number of inked pixels of these rows to the left of `column`.
    pub(super) fn ink_left_of(&self, rows: std::ops::Range<usize>, column: i64) -> u64 {
        let width = (self.stride as i64 - 1) * 64;
        let column = column.clamp(0, width) as usize;
        let (whole, part) = (column / 64, column % 64);
        let mask = (1_u64 << part) - 1;
        let mut count = 0;
        for y in rows {
            let row = self.row(y);
            count += row[..whole].iter().map(|word| u64::from(word.count_ones())).sum::<u64>();
            count += row.get(whole).map_or(0, |word| u64::from((word & mask).count_ones()));
        }
        count
    }

    /// Inked pixels of row `y` in the columns `from..to`.
    pub(super) fn ink_between(&self, y: usize, from: i64, to: i64) -> u32 {
        let row = self.row(y);
        let (from, to) =
            (from.clamp(0, row.len() as i64 * 64) as usize, to.clamp(0, row.len() as i64 * 64) as usize);
        if from >= to {
            return 0;
        }
        let mut count = 0;
        for (i, &word) in row.iter().enumerate().take((to - 1) / 64 + 1).skip(from / 64) {
            let mut word = word;
            if i == from / 64 {
                word &= u64::MAX << (from % 64);
            }
            if i == (to - 1) / 64 {
                word &= u64::MAX >> (63 - (to - 1) % 64);
            }
            count += word.count_ones();
        }
        count
    }

    /// The first and the last column of ink of row `y`, the last excluded; `None` without ink.
    pub(super) fn extent(&self, y: usize) -> Option<(usize, usize)> {
        let row = self.row(y);
        let first = row.iter().position(|&word| word != 0)?;
        let last = row.iter().rposition(|&word| word != 0)?;
        let left = first * 64 + row[first].trailing_zeros() as usize;
        Some((left, last * 64 + 64 - row[last].leading_zeros() as usize))
    }

    /// The run of ink of row `y` that holds column `x`.
    pub(super) fn run_at(&self, y: usize, x: i64) -> Option<Run> {
        let row = self.row(y);
        let x = usize::try_from(x).ok().filter(|&x| x < row.len() * 64)?;
        if row[x / 64] >> (x % 64) & 1 == 0 {
            return None;
        }
        let mut i = x / 64;
        // Paper to the left of `x`.
        let mut paper = !row[i] & !(u64::MAX << (x % 64));
        let left = loop {
            if paper != 0 {
                break i * 64 + 64 - paper.leading_zeros() as usize;
            }
            if i == 0 {
                break 0;
            }
            i -= 1;
            paper = !row[i];
        };
        Some(Run { left, right: self.run_end(y, x) })
    }

    /// Where the run that holds the inked column `x` ends.
    fn run_end(&self, y: usize, x: usize) -> usize {
        let row = self.row(y);
        let mut i = x / 64;
        let mut paper = !row[i] & (u64::MAX << (x % 64));
        while paper == 0 {
            i += 1;
            if i == row.len() {
                return i * 64;
            }
            paper = !row[i];
        }
        i * 64 + paper.trailing_zeros() as usize
    }

    /// The first run of row `y` that begins at or after column `x`, or that holds it.
    pub(super) fn next_run(&self, y: usize, x: usize) -> Option<Run> {
        let row = self.row(y);
        let mut i = x / 64;
        let mut ink = row.get(i).copied()? & (u64::MAX << (x % 64));
        while ink == 0 {
            i += 1;
            ink = row.get(i).copied()?;
        }
        let left = i * 64 + ink.trailing_zeros() as usize;
        Some(Run { left, right: self.run_end(y, left) })
    }

    /// The runs of row `y`.
    pub(super) fn runs(&self, y: usize) -> impl Iterator<Item = Run> + '_ {
        let mut x = 0;
        std::iter::from_fn(move || {
            let run = self.next_run(y, x)?;
            x = run.right;
            Some(run)
        })
    }
}

/// Ink of a row without a gap: columns `left..right`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Run {
    pub(super) left: usize,
    pub(super) right: usize,
}

impl Run {
    pub(super) const fn width(self) -> usize {
        self.right - self.left
    }

    pub(super) fn center(self) -> f64 {
        (self.left + self.right) as f64 / 2.0
    }

    /// Whether the two touch if they are in neighbouring rows, corners included.
    pub(super) const fn touches(self, other: Self) -> bool {
        self.left <= other.right && other.left <= self.right
    }
}
