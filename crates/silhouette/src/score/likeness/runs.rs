//! Strokes and gaps: the runs of ink in rows and columns, and the runs of paper between them.
//!
//! A run is all ink, or all paper, from one side to the other along a row or a column (the runs of
//! Galloway 1975, *Texture analysis using gray level run lengths*). Runs of ink are as long as trunks,
//! branches and leaves are thick, runs of paper between ink as gaps are wide; a blob has long runs and
//! no gaps, and a rough rim gives it away in neither. Amounts are per unit of ink, so that a small tree
//! of a species has about those of a large one.

use super::LANES;
use crate::bitmap::Bitmap;
use pleach_plant::math;

/// Lengths that are distinguished: 1, 2, 4, … 128 parts in 256 of S. What lies between two counts for
/// both, in proportion on a logarithmic scale: a run that grows by a pixel moves little.
const LENGTHS: usize = 8;

/// In rows, in columns, and room for what is the same in all pictures, see [`COMMON`].
pub(super) const AMOUNTS: usize = (2 * LENGTHS + 1).next_multiple_of(LANES);

/// Added to the gaps of both pictures, in units of ink: without it the first pinhole in a solid crown
/// would cost the whole part, since no fraction of something is nothing.
const COMMON: f32 = 0.1;

/// Runs by their length in pixels.
#[derive(Clone, Debug, Default)]
pub(super) struct Counts {
    ink: Vec<u32>,
    paper: Vec<u32>,
}

impl Counts {
    /// Strokes and gaps of a picture: ink in runs of ink and paper in runs between ink, by length,
    /// along rows and then along columns, in units of the picture's ink.
    pub(super) fn amounts(&mut self, picture: &Bitmap, transposed: &Bitmap) -> [[f32; AMOUNTS]; 2] {
        let side = picture.width().max(picture.height()) as usize;
        let per_ink = 1.0 / picture.ink().max(1) as f32;
        let (mut strokes, mut gaps) = ([0.0; AMOUNTS], [0.0; AMOUNTS]);
        for (i, lines) in [picture, transposed].into_iter().enumerate() {
            self.count(lines, side);
            let part = i * LENGTHS..(i + 1) * LENGTHS;
            spread(&self.ink, per_ink, &mut strokes[part.clone()]);
            spread(&self.paper, per_ink, &mut gaps[part]);
        }
        gaps[2 * LENGTHS] = COMMON;
        [strokes, gaps]
    }

    /// Counts the runs of each row of `lines`.
    fn count(&mut self, lines: &Bitmap, side: usize) {
        for counts in [&mut self.ink, &mut self.paper] {
            counts.clear();
            counts.resize(side + 1, 0);
        }
        for y in 0..lines.height() {
            let (mut start, mut in_ink, mut before) = (0, false, 0);
            let mut any = false;
            let mut edge = |x: usize| {
                if in_ink {
                    self.ink[x - start] += 1;
                } else if any {
                    self.paper[x - start] += 1;
                }
                (start, in_ink, any) = (x, !in_ink, true);
            };
            for (i, &word) in lines.row(y).iter().enumerate() {
                let mut edges = word ^ (word << 1 | before);
                before = word >> 63;
                while edges != 0 {
                    edge(64 * i + edges.trailing_zeros() as usize);
                    edges &= edges - 1;
                }
            }
            // A run that fills the last word to its end has found no edge there.
            if before == 1 {
                edge(lines.width() as usize);
            }
        }
    }
}

/// Adds runs, each with its length times `unit`, to the amounts of the two nearest of [`LENGTHS`].
fn spread(counts: &[u32], unit: f32, amounts: &mut [f32]) {
    let side = counts.len() - 1;
    let last = LENGTHS - 1;
    for (length, &n) in counts.iter().enumerate().filter(|(_, n)| **n > 0) {
        let scale = math::log2f(256.0 * length as f32 / side as f32).clamp(0.0, last as f32);
        let (below, part) = (scale as usize, scale.fract());
        let amount = n as f32 * length as f32 * unit;
        amounts[below] += amount * (1.0 - part);
        amounts[(below + 1).min(last)] += amount * part;
    }
}

#[cfg(test)]
mod tests {
    use super::super::transpose::transpose;
    use super::*;

    fn runs(picture: &Bitmap) -> [[f32; AMOUNTS]; 2] {
        let mut transposed = Bitmap::default();
        transpose(picture, &mut transposed);
        Counts::default().amounts(picture, &transposed)
    }

    #[test]
    fn runs_are_as_long_as_they_look() {
        let mut counts = Counts::default();
        let line = Bitmap::from_fn(192, 1, |x, _| matches!(x, 3 | 10..=14 | 60..=70 | 120..=191));
        counts.count(&line, 192);
        let found = |counts: &[u32]| {
            counts.iter().enumerate().flat_map(|(l, n)| vec![l; *n as usize]).collect::<Vec<_>>()
        };
        assert_eq!(found(&counts.ink), [1, 5, 11, 72]);
        assert_eq!(found(&counts.paper), [6, 45, 49]);
        counts.count(&Bitmap::from_fn(70, 2, |x, y| x > 60 || y == 0), 70);
        assert_eq!(found(&counts.ink), [9, 70]);
        assert_eq!(found(&counts.paper), [0; 0]);
    }

    #[test]
    fn a_grid_of_bars_has_their_width_and_their_gaps() {
        // Bars four pixels wide and twelve apart, upright, as high as the picture.
        let [strokes, gaps] = runs(&Bitmap::from_fn(256, 256, |x, _| x % 16 < 4));
        let one = |at: usize| std::array::from_fn::<f32, LENGTHS, _>(|i| f32::from(u8::from(i == at)));
        assert_eq!(strokes[..LENGTHS], one(2), "rows: four pixels");
        assert_eq!(strokes[LENGTHS..2 * LENGTHS], one(LENGTHS - 1), "columns: all of it");
        // Between 8 and 16 pixels, nearer to 16: log₂ 12 is 3.585. Three times the ink, but for one gap.
        let total = 3.0 * 15.0 / 16.0;
        assert!((gaps[3] - 0.415 * total).abs() < 1e-3 && (gaps[4] - 0.585 * total).abs() < 1e-3, "{gaps:?}");
        assert_eq!(
            gaps[LENGTHS..],
            [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, COMMON, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
        );
    }

    #[test]
    fn the_same_drawing_at_twice_the_size_has_the_same_runs() {
        let small = Bitmap::from_fn(128, 128, |x, y| (x / 6 + y / 9) % 3 == 0 && x + y > 60);
        let large = Bitmap::from_fn(256, 256, |x, y| small.get(x / 2, y / 2));
        for (a, b) in runs(&small).as_flattened().iter().zip(runs(&large).as_flattened()) {
            assert!((a - b).abs() < 1e-5, "{a} {b}");
        }
    }
}
