//! A part of a photograph at a small size, and fields over it.

use super::oklab::{Converter, Oklab};
use super::photo::Photo;
use super::pixel_box::PixelBox;
use crate::bitmap::Bitmap;

/// Mean colours of the cells of a grid over a part of a photograph.
pub(super) struct Reduced {
    /// The part of the photograph, in its pixels.
    pub(super) part: PixelBox,
    /// Cells across and down.
    pub(super) width: u32,
    pub(super) height: u32,
    /// Row by row from the top.
    pub(super) colors: Vec<Oklab>,
}

impl Reduced {
    /// The part with at most `side` cells along its longer side; a cell has one pixel or more.
    pub(super) fn new(photo: &Photo, converter: &Converter, part: PixelBox, side: u32) -> Self {
        let longer = part.width.max(part.height);
        let cells = |of: u32| {
            if longer <= side { of } else { (u64::from(of) * u64::from(side)).div_ceil(longer.into()) as u32 }
        };
        let (width, height) = (cells(part.width).max(1), cells(part.height).max(1));
        let mut colors = Vec::with_capacity(width as usize * height as usize);
        let mut sums = vec![[0_u64; 4]; width as usize];
        for y in 0..height {
            sums.fill([0; 4]);
            for row in bounds(y, height, part.height) {
                for (x, sum) in sums.iter_mut().enumerate() {
                    for column in bounds(x as u32, width, part.width) {
                        let rgb = photo.rgb(part.x + column, part.y + row);
                        sum.iter_mut().zip(rgb).for_each(|(s, v)| *s += u64::from(v));
                        sum[3] += 1;
                    }
                }
            }
            let mean = |&[r, g, b, count]: &[u64; 4]| [r, g, b].map(|s| ((s + count / 2) / count) as u8);
            colors.extend(sums.iter().map(|sum| converter.oklab(mean(sum))));
        }
        Self { part, width, height, colors }
    }

    /// The same of half as many cells across and down.
    pub(super) fn halved(&self) -> Self {
        let (width, height) = (self.width.div_ceil(2), self.height.div_ceil(2));
        let mut colors = Vec::with_capacity(width as usize * height as usize);
        for y in 0..height {
            for x in 0..width {
                let (mut sum, mut count) = ([0.0; 3], 0.0);
                for y in 2 * y..(2 * y + 2).min(self.height) {
                    for x in 2 * x..(2 * x + 2).min(self.width) {
                        sum.iter_mut().zip(self.colors[self.index(x, y)]).for_each(|(s, c)| *s += c);
                        count += 1.0;
                    }
                }
                colors.push(sum.map(|s| s / count));
            }
        }
        Self { part: self.part, width, height, colors }
    }

    pub(super) const fn index(&self, x: u32, y: u32) -> usize {
        y as usize * self.width as usize + x as usize
    }

    /// The photograph's pixel in the middle of a cell.
    pub(super) fn middle(&self, x: u32, y: u32) -> (u32, u32) {
        let middle = |at: u32, of: u32, side: u32| {
            ((2 * u64::from(at) + 1) * u64::from(side) / (2 * u64::from(of))) as u32
        };
        (
            self.part.x + middle(x, self.width, self.part.width),
            self.part.y + middle(y, self.height, self.part.height),
        )
    }

    /// The cells that hold ink of a picture of the photograph's size.
    pub(super) fn cells_with(&self, ink: &Bitmap) -> Vec<bool> {
        let mut found = vec![false; self.colors.len()];
        let cell = |at: u32, of: u32, side: u32| {
            // The last cell whose first pixel is not beyond.
            ((u64::from(at) * u64::from(of) + u64::from(of) - 1) / u64::from(side)).min(u64::from(of) - 1)
                as u32
        };
        for y in self.part.y..self.part.y + self.part.height {
            let row = cell(y - self.part.y, self.height, self.part.height);
            for x in ink.ink_in_row(y) {
                if x >= self.part.x && x - self.part.x < self.part.width {
                    found[self.index(cell(x - self.part.x, self.width, self.part.width), row)] = true;
                }
            }
        }
        found
    }

    /// Mean of the values within some cells of each in both directions.
    pub(super) fn box_mean(&self, values: &[f32], reach: u32) -> Vec<f32> {
        let (width, height, reach) = (self.width as usize, self.height as usize, reach as usize);
        let mut across = vec![0.0; values.len()];
        let mut sums = vec![0.0_f64; width.max(height) + 1];
        for (row, out) in values.chunks_exact(width).zip(across.chunks_exact_mut(width)) {
            row.iter().enumerate().for_each(|(i, v)| sums[i + 1] = sums[i] + f64::from(*v));
            for (i, out) in out.iter_mut().enumerate() {
                let (first, end) = (i.saturating_sub(reach), (i + reach + 1).min(width));
                *out = ((sums[end] - sums[first]) / (end - first) as f64) as f32;
            }
        }
        let mut out = vec![0.0; values.len()];
        for x in 0..width {
            (0..height).for_each(|y| sums[y + 1] = sums[y] + f64::from(across[y * width + x]));
            for y in 0..height {
                let (first, end) = (y.saturating_sub(reach), (y + reach + 1).min(height));
                out[y * width + x] = ((sums[end] - sums[first]) / (end - first) as f64) as f32;
            }
        }
        out
    }

    /// Where the columns (or rows) of the photograph lie among the cells.
    pub(super) fn columns(&self) -> Vec<Between> {
        (0..self.part.width).map(|x| Between::new(x, self.width, self.part.width)).collect()
    }

    pub(super) fn row(&self, y: u32) -> Between {
        Between::new(y, self.height, self.part.height)
    }
}

/// A field at the size of the photograph, a row at a time: between the four cells around each pixel.
pub(super) struct Stretched<'a> {
    field: &'a [f32],
    columns: &'a [Between],
    width: usize,
    /// The rows of cells above and below, and their values at all columns.
    sources: [(Option<usize>, Vec<f32>); 2],
    values: Vec<f32>,
}

impl<'a> Stretched<'a> {
    pub(super) fn new(small: &Reduced, field: &'a [f32], columns: &'a [Between]) -> Self {
        let empty = || vec![0.0; columns.len()];
        Self {
            field,
            columns,
            width: small.width as usize,
            sources: [(None, empty()), (None, empty())],
            values: empty(),
        }
    }

    /// The field along a row of the part of the photograph.
    pub(super) fn row(&mut self, row: &Between) -> &[f32] {
        for ((source, values), wanted) in self.sources.iter_mut().zip([row.first, row.second]) {
            // Several rows of pixels lie between the same rows of cells.
            if *source != Some(wanted) {
                let cells = &self.field[wanted * self.width..];
                for (value, column) in values.iter_mut().zip(self.columns) {
                    let (a, b) = (cells[column.first], cells[column.second]);
                    *value = a + column.share * (b - a);
                }
                *source = Some(wanted);
            }
        }
        let [(_, above), (_, below)] = &self.sources;
        for ((value, above), below) in self.values.iter_mut().zip(above).zip(below) {
            *value = above + row.share * (below - above);
        }
        &self.values
    }
}

/// The two cells next to a pixel, and how far it is from the first to the second.
pub(super) struct Between {
    first: usize,
    second: usize,
    share: f32,
}

impl Between {
    fn new(at: u32, of: u32, side: u32) -> Self {
        let place = ((f64::from(at) + 0.5) * f64::from(of) / f64::from(side) - 0.5).max(0.0);
        let first = (place as u32).min(of - 1);
        Self {
            first: first as usize,
            second: (first + 1).min(of - 1) as usize,
            share: (place - f64::from(first)).min(1.0) as f32,
        }
    }
}

/// The pixels of cell `at` of `of` over a side.
fn bounds(at: u32, of: u32, side: u32) -> std::ops::Range<u32> {
    let first = (u64::from(at) * u64::from(side) / u64::from(of)) as u32;
    let end = (u64::from(at + 1) * u64::from(side) / u64::from(of)) as u32;
    first..end.max(first + 1)
}
