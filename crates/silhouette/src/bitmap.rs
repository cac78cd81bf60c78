//! One-bit pictures as rows of 64-bit words.

use std::fmt;

/// A picture of ink (1) and paper (0), row by row from the top.
///
/// Pixel x of a row is bit `x % 64` of word `x / 64`; bits beyond the width are 0.
#[derive(Clone, Default, PartialEq, Eq, Hash)]
pub struct Bitmap {
    width: u32,
    height: u32,
    words_per_row: usize,
    words: Vec<u64>,
}

impl Bitmap {
    /// An empty picture of `width` × `height` pixels.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        let words_per_row = (width as usize).div_ceil(64);
        Self { width, height, words_per_row, words: vec![0; words_per_row * height as usize] }
    }

    /// The picture of these [words](Self::words); `None` if their number is not right, or there is ink beyond the
    /// width.
    #[must_use]
    pub fn from_words(width: u32, height: u32, words: Vec<u64>) -> Option<Self> {
        let words_per_row = (width as usize).div_ceil(64);
        let beyond = if width.is_multiple_of(64) { 0 } else { u64::MAX << (width % 64) };
        let is_clean = |row: &[u64]| row.last().is_none_or(|last| last & beyond == 0);
        let fits = words.len() as u64 == words_per_row as u64 * u64::from(height)
            && words.chunks_exact(words_per_row.max(1)).all(is_clean);
        fits.then_some(Self { width, height, words_per_row, words })
    }

    /// Width in pixels.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// Number of pixels.
    #[must_use]
    pub const fn area(&self) -> u64 {
        self.width as u64 * self.height as u64
    }

    /// Makes it an empty picture of another size; allocates only if it grows.
    pub fn reset(&mut self, width: u32, height: u32) {
        self.width = width;
        self.height = height;
        self.words_per_row = (width as usize).div_ceil(64);
        self.words.clear();
        self.words.resize(self.words_per_row * height as usize, 0);
    }

    /// The words of row `y`.
    #[must_use]
    pub fn row(&self, y: u32) -> &[u64] {
        let start = y as usize * self.words_per_row;
        &self.words[start..start + self.words_per_row]
    }

    /// The words of row `y`; a caller that writes them keeps the bits beyond the width at 0.
    pub(crate) fn row_mut(&mut self, y: u32) -> &mut [u64] {
        let start = y as usize * self.words_per_row;
        &mut self.words[start..start + self.words_per_row]
    }

    /// All words, row by row.
    #[must_use]
    pub fn words(&self) -> &[u64] {
        &self.words
    }

    /// Whether there is ink at (x, y); nothing outside.
    #[must_use]
    pub fn get(&self, x: u32, y: u32) -> bool {
        x < self.width && y < self.height && self.row(y)[x as usize / 64] >> (x % 64) & 1 == 1
    }

    /// Sets the pixel (x, y); nothing happens outside.
    pub fn set(&mut self, x: u32, y: u32, ink: bool) {
        if x < self.width && y < self.height {
            let bit = 1_u64 << (x % 64);
            let word = &mut self.row_mut(y)[x as usize / 64];
            *word = if ink { *word | bit } else { *word & !bit };
        }
    }

    /// The picture whose ink is where `ink(x, y)` holds.
    #[must_use]
    pub fn from_fn(width: u32, height: u32, mut ink: impl FnMut(u32, u32) -> bool) -> Self {
        let mut bitmap = Self::new(width, height);
        for y in 0..height {
            for x in 0..width {
                if ink(x, y) {
                    bitmap.set(x, y, true);
                }
            }
        }
        bitmap
    }

    /// Number of inked pixels.
    #[must_use]
    pub fn ink(&self) -> u64 {
        self.words.iter().map(|w| u64::from(w.count_ones())).sum()
    }

    /// Number of pixels in which the two differ.
    ///
    /// # Panics
    /// If the sizes differ, as all that compare two pictures.
    #[must_use]
    pub fn differing(&self, other: &Self) -> u64 {
        self.count_pairs(other, |a, b| a ^ b)
    }

    /// Number of pixels that are ink in both.
    #[must_use]
    pub fn intersection(&self, other: &Self) -> u64 {
        self.count_pairs(other, |a, b| a & b)
    }

    /// Makes ink of what is ink in the other picture, which has the same size.
    pub(crate) fn unite(&mut self, other: &Self) {
        debug_assert_eq!((self.width, self.height), (other.width, other.height), "pictures of one size");
        self.words.iter_mut().zip(&other.words).for_each(|(word, more)| *word |= more);
    }

    /// Takes away the ink that `other`, of the same size, has too.
    pub(crate) fn subtract(&mut self, other: &Self) {
        debug_assert_eq!((self.width, self.height), (other.width, other.height), "pictures of one size");
        self.words.iter_mut().zip(&other.words).for_each(|(word, less)| *word &= !less);
    }

    fn count_pairs(&self, other: &Self, combine: impl Fn(u64, u64) -> u64) -> u64 {
        assert_eq!((self.width, self.height), (other.width, other.height), "pictures of one size");
        let pairs = self.words.iter().zip(&other.words);
        pairs.map(|(&a, &b)| u64::from(combine(a, b).count_ones())).sum()
    }

    /// Inked pixels of each row, left to right: an iterator over x.
    pub fn ink_in_row(&self, y: u32) -> impl Iterator<Item = u32> + '_ {
        self.row(y).iter().enumerate().flat_map(|(i, &word)| {
            let mut rest = word;
            std::iter::from_fn(move || {
                (rest != 0).then(|| {
                    let bit = rest.trailing_zeros();
                    rest &= rest - 1;
                    i as u32 * 64 + bit
                })
            })
        })
    }

    /// First and last column and row with ink, as (left, top, right, bottom); `None` without ink.
    #[must_use]
    pub fn ink_box(&self) -> Option<(u32, u32, u32, u32)> {
        let mut bounds: Option<(u32, u32, u32, u32)> = None;
        for y in 0..self.height {
            let (mut xs, mut last) = (self.ink_in_row(y), None);
            let first = xs.next();
            if let Some(x) = xs.last() {
                last = Some(x);
            }
            if let Some(first) = first {
                let last = last.unwrap_or(first);
                bounds = Some(match bounds {
                    None => (first, y, last, y),
                    Some((l, t, r, _)) => (l.min(first), t, r.max(last), y),
                });
            }
        }
        bounds
    }

    /// Reads a picture of `#` (ink) and `.` (paper), one line per row; blanks at line ends and blank
    /// lines are skipped. For tests and messages.
    #[must_use]
    pub fn from_ascii(text: &str) -> Self {
        let lines: Vec<&str> = text.lines().map(str::trim).filter(|l| !l.is_empty()).collect();
        let width = lines.iter().map(|l| l.len()).max().unwrap_or(0);
        Self::from_fn(width as u32, lines.len() as u32, |x, y| {
            lines[y as usize].as_bytes().get(x as usize) == Some(&b'#')
        })
    }

    /// The picture as `#` and `.`, one line per row.
    #[must_use]
    pub fn to_ascii(&self) -> String {
        let mut text = String::with_capacity((self.width as usize + 1) * self.height as usize);
        for y in 0..self.height {
            text.extend((0..self.width).map(|x| if self.get(x, y) { '#' } else { '.' }));
            text.push('\n');
        }
        text
    }
}

impl fmt::Debug for Bitmap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Bitmap {} × {}, {} ink", self.width, self.height, self.ink())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ascii_goes_there_and_back() {
        let text = "#..#\n.##.\n....\n";
        let bitmap = Bitmap::from_ascii(text);
        assert_eq!(bitmap.to_ascii(), text);
        assert_eq!(bitmap.ink(), 4);
        assert_eq!(bitmap.ink_box(), Some((0, 0, 3, 1)));
        assert_eq!(Bitmap::new(5, 5).ink_box(), None);
    }

    #[test]
    fn words_make_a_picture_only_if_they_are_one() {
        let picture = Bitmap::from_fn(70, 3, |x, y| (x + y) % 3 == 0);
        assert_eq!(Bitmap::from_words(70, 3, picture.words().to_vec()), Some(picture.clone()));
        assert_eq!(Bitmap::from_words(70, 2, picture.words().to_vec()), None);
        assert_eq!(Bitmap::from_words(70, 1, vec![0, 1 << 6]), None);
        assert_eq!(Bitmap::from_words(0, 5, Vec::new()), Some(Bitmap::new(0, 5)));
    }

    #[test]
    fn pairs_are_counted_across_words() {
        let a = Bitmap::from_fn(130, 3, |x, _| x >= 60);
        let b = Bitmap::from_fn(130, 3, |x, _| x < 70);
        assert_eq!(a.intersection(&b), 30);
        assert_eq!(a.differing(&b), 3 * 120);
        assert_eq!(a.ink_in_row(1).count(), 70);
        assert_eq!(a.ink_in_row(1).next(), Some(60));
    }
}
