//! Which cell a column of pixels belongs to, as masks of words.

use super::CELLS;

/// Columns within one word of a row that belong to the same cell.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    word: usize,
    mask: u64,
    cell: usize,
}

/// The columns of a picture cut into cells; counting a row's bits by cell is a few masks and popcounts.
#[derive(Clone, Debug, Default)]
pub(super) struct Columns {
    pieces: Vec<Piece>,
}

impl Columns {
    /// Cuts `width` columns so that column x belongs to the cell `cell(x)`, at most the last one.
    pub(super) fn cut(&mut self, width: u32, cell: impl Fn(u32) -> usize) {
        self.pieces.clear();
        for x in 0..width {
            let (word, bit) = (x as usize / 64, 1 << (x % 64));
            let cell = cell(x).min(CELLS - 1);
            match self.pieces.last_mut() {
                Some(last) if last.word == word && last.cell == cell => last.mask |= bit,
                _ => self.pieces.push(Piece { word, mask: bit, cell }),
            }
        }
    }

    /// Adds the bits of a row to the cells of its band; `word` gives the words of the row.
    pub(super) fn count(&self, word: impl Fn(usize) -> u64, counts: &mut [u32]) {
        for piece in &self.pieces {
            counts[piece.cell] += (word(piece.word) & piece.mask).count_ones();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_bit_is_counted_once_in_its_cell() {
        let mut columns = Columns::default();
        columns.cut(150, |x| (x as usize).abs_diff(40) / 9);
        let row = [0xdead_beef_0123_4567, u64::MAX, 0b1011];
        let mut counts = [0; CELLS];
        columns.count(|i| row[i], &mut counts);
        let mut expected = [0; CELLS];
        for x in (0..150).filter(|x| row[x / 64] >> (x % 64) & 1 == 1) {
            expected[(x.abs_diff(40) / 9).min(CELLS - 1)] += 1;
        }
        assert_eq!(counts, expected);
    }
}
