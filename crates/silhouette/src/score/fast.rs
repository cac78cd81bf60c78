//! The scores of the inner loop: many pictures against one goal, without allocating.
//!
//! Pixels are compared by exclusive or and popcount. Masses are compared on a pyramid of square cells
//! of 2, 4, 8, 16 and 32 pixels: with a and b the inked pixels of a cell in the two pictures, the soft
//! overlap of a level is Σ min(a, b) / Σ max(a, b), which is intersection over union where cells are
//! single pixels and forgives shifts of less than a cell above.

use crate::bitmap::Bitmap;

/// Levels of the pyramid.
pub const LEVELS: usize = 5;

/// Sides of the cells of each level, in pixels.
pub const CELLS: [u32; LEVELS] = [2, 4, 8, 16, 32];

/// Inked pixels in the cells of each level.
#[derive(Clone, Debug, Default, PartialEq)]
struct Pyramid {
    levels: [Vec<u16>; LEVELS],
}

impl Pyramid {
    /// Counts the cells of `bitmap`. Cells beyond the right and lower edges are empty.
    fn build(&mut self, bitmap: &Bitmap) {
        // A row of words has 32 cells of 2 pixels each; whole cells of 32 pixels from top to bottom.
        let across = bitmap.row(0).len() * 32;
        let down = bitmap.height().div_ceil(32) as usize * 16;
        let [first, ..] = &mut self.levels;
        first.clear();
        first.resize(across * down, 0);
        for (row, cells) in first.chunks_exact_mut(across).enumerate() {
            let y = 2 * row as u32;
            if y >= bitmap.height() {
                break;
            }
            let below = if y + 1 < bitmap.height() { Some(bitmap.row(y + 1)) } else { None };
            for (i, (&upper, cells)) in bitmap.row(y).iter().zip(cells.chunks_exact_mut(32)).enumerate() {
                let lower = below.map_or(0, |row| row[i]);
                if upper | lower != 0 {
                    count_cells(upper, lower, cells);
                }
            }
        }
        let mut width = across;
        for level in 1..LEVELS {
            let (done, rest) = self.levels.split_at_mut(level);
            halve(&done[level - 1], width, &mut rest[0]);
            width /= 2;
        }
    }
}

/// Counts of the 32 cells of two pixels square in a word and the word below it.
fn count_cells(upper: u64, lower: u64, cells: &mut [u16]) {
    const PAIRS: u64 = 0x5555_5555_5555_5555;
    const FOURS: u64 = 0x3333_3333_3333_3333;
    let pairs = |v: u64| (v & PAIRS) + (v >> 1 & PAIRS);
    let (u, l) = (pairs(upper), pairs(lower));
    // Every other cell, each in four bits.
    let even = (u & FOURS) + (l & FOURS);
    let odd = (u >> 2 & FOURS) + (l >> 2 & FOURS);
    for (i, pair) in cells.chunks_exact_mut(2).enumerate() {
        pair[0] = (even >> (4 * i) & 15) as u16;
        pair[1] = (odd >> (4 * i) & 15) as u16;
    }
}

/// Sums of two by two cells.
fn halve(cells: &[u16], width: usize, out: &mut Vec<u16>) {
    out.clear();
    for rows in cells.chunks_exact(2 * width) {
        let (upper, lower) = rows.split_at(width);
        let pairs = upper.chunks_exact(2).zip(lower.chunks_exact(2));
        out.extend(pairs.map(|(u, l)| u[0] + u[1] + l[0] + l[1]));
    }
}

/// A goal that many pictures are compared with.
#[derive(Clone, Debug)]
pub struct PreparedGoal {
    goal: Bitmap,
    ink: u64,
    pyramid: Pyramid,
}

/// Memory reused from one comparison to the next.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    pyramid: Pyramid,
}

/// How a picture overlaps a goal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overlaps {
    /// Pixels in which they differ.
    pub differing: u64,
    /// Pixels inked in both.
    pub intersection: u64,
    /// Pixels inked in either.
    pub union: u64,
    /// Soft overlap on cells of [`CELLS`] pixels, each in 0..=1; 1 where both are empty.
    pub pyramid: [f64; LEVELS],
}

impl Overlaps {
    /// Intersection over union, in 0..=1; 1 where both are empty.
    #[must_use]
    pub fn iou(&self) -> f64 {
        share(self.intersection, self.union)
    }
}

fn share(part: u64, whole: u64) -> f64 {
    if whole == 0 { 1.0 } else { part as f64 / whole as f64 }
}

impl PreparedGoal {
    /// Counts the goal's cells once.
    #[must_use]
    pub fn new(goal: &Bitmap) -> Self {
        let mut pyramid = Pyramid::default();
        pyramid.build(goal);
        Self { goal: goal.clone(), ink: goal.ink(), pyramid }
    }

    /// The goal itself.
    #[must_use]
    pub const fn goal(&self) -> &Bitmap {
        &self.goal
    }

    /// Compares `picture`, of the goal's size, with the goal.
    ///
    /// # Panics
    /// If the sizes differ.
    #[must_use]
    pub fn overlaps(&self, picture: &Bitmap, scratch: &mut Scratch) -> Overlaps {
        let intersection = self.goal.intersection(picture);
        let total = self.ink + picture.ink();
        scratch.pyramid.build(picture);
        let mut pyramid = [1.0; LEVELS];
        let levels = self.pyramid.levels.iter().zip(&scratch.pyramid.levels);
        for (overlap, (goal, picture)) in pyramid.iter_mut().zip(levels) {
            let least: u64 = goal
                .chunks(64)
                .zip(picture.chunks(64))
                // Sums of 64 cells of at most 1,024 pixels fit into 32 bits many times over.
                .map(|(a, b)| u64::from(a.iter().zip(b).map(|(&a, &b)| u32::from(a.min(b))).sum::<u32>()))
                .sum();
            // min + max = a + b, cell by cell.
            *overlap = share(least, total - least);
        }
        Overlaps { differing: total - 2 * intersection, intersection, union: total - intersection, pyramid }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn slow(a: &Bitmap, b: &Bitmap, cell: u32) -> f64 {
        let count = |m: &Bitmap, cx: u32, cy: u32| {
            let pixels = (0..cell * cell).map(|i| (cx * cell + i % cell, cy * cell + i / cell));
            pixels.filter(|&(x, y)| m.get(x, y)).count()
        };
        let (mut least, mut most) = (0, 0);
        for cy in 0..a.height().div_ceil(cell) {
            for cx in 0..a.width().div_ceil(cell) {
                let (n, m) = (count(a, cx, cy), count(b, cx, cy));
                least += n.min(m);
                most += n.max(m);
            }
        }
        least as f64 / most as f64
    }

    #[test]
    fn the_pyramid_agrees_with_counting() {
        for (width, height) in [(256, 256), (70, 33), (5, 90), (128, 1)] {
            let draw = |k: u32| Bitmap::from_fn(width, height, |x, y| (x * 7 + y * 13 + x * y * k) % 5 < 2);
            let (a, b) = (draw(1), draw(3));
            let found = PreparedGoal::new(&a).overlaps(&b, &mut Scratch::default());
            for (cell, overlap) in CELLS.into_iter().zip(found.pyramid) {
                assert!((overlap - slow(&a, &b, cell)).abs() < 1e-12, "{width} × {height}, cells of {cell}");
            }
            assert_eq!(found.differing, a.differing(&b));
            assert_eq!(found.intersection, a.intersection(&b));
            assert!((found.iou() - slow(&a, &b, 1)).abs() < 1e-12);
        }
    }

    #[test]
    fn empty_pictures_agree() {
        let empty = Bitmap::new(40, 40);
        let found = PreparedGoal::new(&empty).overlaps(&empty, &mut Scratch::default());
        assert_eq!((found.iou(), found.pyramid), (1.0, [1.0; LEVELS]));
    }
}
