//! The tree in a picture of at most some hundred pixels a side.

use super::oklab::{self, Oklab};
use super::statistics::quantile;
use pleach_silhouette::Bitmap;
use pleach_silhouette::mask::Photo;

/// Longest side of the reduced picture. Limbs of one pixel there are a 500th of the tree.
const MAX_SIDE: u32 = 512;
/// Pixels less opaque than this have the background's colours in them.
const OPAQUE: u8 = 128;

/// A cell of the reduced picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Cell {
    /// Not tree.
    #[default]
    Outside,
    /// Tree of which every pixel touches what is not tree, and may have its colours.
    Edge,
    /// Tree.
    Inside,
}

/// The part of a photograph that a mask's tree fills, reduced.
pub(super) struct Grid {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) cells: Vec<Cell>,
    pub(super) colors: Vec<Oklab>,
    /// Median colour of what is not tree, where the photograph shows it.
    pub(super) background: Option<Oklab>,
    left: u32,
    top: u32,
    factor: u32,
}

impl Grid {
    /// `None` where there is no tree. Photograph and mask are of one size.
    pub(super) fn new(photo: &Photo, tree: &Bitmap) -> Option<Self> {
        let (left, top, right, bottom) = tree.ink_box()?;
        let [across, down] = [right.max(left) - left + 1, bottom.max(top) - top + 1];
        let factor = across.max(down).div_ceil(MAX_SIDE).max(1);
        let (width, height) = (across.div_ceil(factor) as usize, down.div_ceil(factor) as usize);
        let mut grid = Self {
            width,
            height,
            cells: vec![Cell::Outside; width * height],
            colors: vec![[0.0; 3]; width * height],
            background: background(photo, tree),
            left,
            top,
            factor,
        };
        grid.fill(photo, tree);
        Some(grid)
    }

    fn fill(&mut self, photo: &Photo, tree: &Bitmap) {
        let linear = oklab::linear_table();
        let is_tree = |x: u32, y: u32| x < tree.width() && y < tree.height() && tree.get(x, y);
        let (width, factor) = (self.width, self.factor);
        for at in 0..self.cells.len() {
            let (left, top) =
                (self.left + (at % width) as u32 * factor, self.top + (at / width) as u32 * factor);
            // Sums of light and counts, of pixels at the edge and of those inside.
            let (mut light, mut count) = ([[0.0_f32; 3]; 2], [0_u32; 2]);
            for (x, y) in (0..factor * factor).map(|i| (left + i % factor, top + i / factor)) {
                if !is_tree(x, y) {
                    continue;
                }
                let [r, g, b, opacity] = photo.pixels()[y as usize * photo.width() as usize + x as usize];
                if opacity < OPAQUE {
                    continue;
                }
                // At the picture's own edge the tree goes on.
                let goes_on = |x: u32, y: u32| x >= tree.width() || y >= tree.height() || tree.get(x, y);
                let inside = goes_on(x.wrapping_sub(1), y)
                    && goes_on(x + 1, y)
                    && goes_on(x, y.wrapping_sub(1))
                    && goes_on(x, y + 1);
                let kind = usize::from(inside);
                count[kind] += 1;
                for (sum, value) in light[kind].iter_mut().zip([r, g, b]) {
                    *sum += linear[usize::from(value)];
                }
            }
            // A cell is tree where a third of it is: thin twigs stay.
            if 3 * (count[0] + count[1]) < factor * factor || count == [0, 0] {
                continue;
            }
            let kind = usize::from(count[1] > 0);
            self.cells[at] = if kind == 1 { Cell::Inside } else { Cell::Edge };
            self.colors[at] = oklab::from_linear(light[kind].map(|sum| sum / count[kind] as f32));
        }
    }

    /// Whether a cell is tree.
    pub(super) fn is_tree(&self, at: usize) -> bool {
        self.cells[at] != Cell::Outside
    }

    /// The cells of row `y`.
    pub(super) const fn row(&self, y: usize) -> std::ops::Range<usize> {
        y * self.width..(y + 1) * self.width
    }

    /// The cells beside `at`, of eight those that the grid has.
    pub(super) fn around(&self, at: usize) -> impl Iterator<Item = usize> + use<> {
        let (width, height) = (self.width, self.height);
        let (x, y) = (at % width, at / width);
        let rows = y.saturating_sub(1)..(y + 2).min(height);
        rows.flat_map(move |v| (x.saturating_sub(1)..(x + 2).min(width)).map(move |u| v * width + u))
            .filter(move |&next| next != at)
    }

    /// Steps to the nearest cell that is not tree, at most `far`; the grid's edge is not one.
    pub(super) fn depths(&self, far: u16) -> Vec<u16> {
        let mut depths: Vec<u16> =
            self.cells.iter().map(|&cell| if cell == Cell::Outside { 0 } else { far }).collect();
        let width = self.width;
        let step =
            |depths: &mut Vec<u16>, at: usize, from: usize| depths[at] = depths[at].min(depths[from] + 1);
        for at in 0..depths.len() {
            if at % width > 0 {
                step(&mut depths, at, at - 1);
            }
            if at >= width {
                step(&mut depths, at, at - width);
            }
        }
        for at in (0..depths.len()).rev() {
            if at % width + 1 < width {
                step(&mut depths, at, at + 1);
            }
            if at + width < depths.len() {
                step(&mut depths, at, at + width);
            }
        }
        depths
    }

    /// The pixels of `tree` whose cell is `chosen`.
    pub(super) fn layer(&self, tree: &Bitmap, chosen: impl Fn(usize) -> bool) -> Bitmap {
        let mut layer = Bitmap::new(tree.width(), tree.height());
        for y in 0..self.height * self.factor as usize {
            let v = self.top + y as u32;
            if v >= tree.height() {
                break;
            }
            for u in tree.ink_in_row(v) {
                let x = (u - self.left) / self.factor;
                if chosen(y / self.factor as usize * self.width + x as usize) {
                    layer.set(u, v, true);
                }
            }
        }
        layer
    }
}

/// The median colour of opaque pixels outside of `tree`; of every ninth in each direction.
fn background(photo: &Photo, tree: &Bitmap) -> Option<Oklab> {
    let linear = oklab::linear_table();
    let mut values: [Vec<f32>; 3] = Default::default();
    for y in (0..photo.height()).step_by(9) {
        for x in (0..photo.width()).step_by(9).filter(|&x| !tree.get(x, y)) {
            let [r, g, b, opacity] = photo.pixels()[y as usize * photo.width() as usize + x as usize];
            if opacity >= OPAQUE {
                let color = oklab::from_linear([r, g, b].map(|v| linear[usize::from(v)]));
                values.iter_mut().zip(color).for_each(|(list, value)| list.push(value));
            }
        }
    }
    let [lightness, a, b] = values.each_mut().map(|list| quantile(list, 0.5));
    Some([lightness?, a?, b?])
}
