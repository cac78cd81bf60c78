//! Pictures of trees whose parts come and go one by one.
//!
//! A [`Layer`] is what one part covers. A [`Stack`] counts for every sample how many layers cover it, so that a
//! layer is taken out and another put in its place at the price of the two, however many there are. Counts
//! are bit-sliced: plane k holds bit k of the counts of 64 samples in a word, and adding a layer is the
//! addition of one bit with carry, 64 samples at a time.

use super::grid::{Half, count};
use super::{ACROSS, Detail, Rasterizer, Scene};
use crate::bitmap::Bitmap;
use crate::view::{Camera, Frame, View};
use glam::DVec3;
use pleach_plant::math;
use pleach_plant::{Leaf, Parts, Tree};
use std::ops::Range;

/// What a part of a tree covers: the samples in a box of a picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layer {
    /// Words of each row of samples; a word is eight pixels across.
    across: Range<usize>,
    /// Rows of pixels.
    rows: Range<u32>,
    /// Samples down each pixel.
    down: u32,
    words: Vec<u64>,
}

impl Layer {
    /// The words of a row of samples, which may lie outside.
    #[inline]
    fn line(&self, row: usize) -> &[u64] {
        let first = self.rows.start as usize * self.down as usize;
        let end = self.rows.end as usize * self.down as usize;
        if (first..end).contains(&row) {
            let width = self.across.len();
            &self.words[(row - first) * width..][..width]
        } else {
            &[]
        }
    }

    /// Whether it covers nothing.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.words.iter().all(|&word| word == 0)
    }
}

/// Draws layers of one picture; keeps its memory.
#[derive(Clone, Debug)]
pub struct LayerPainter {
    rasterizer: Rasterizer,
    camera: Camera,
    frame: Frame,
    down: u32,
}

impl LayerPainter {
    /// Draws layers of the picture in `frame` from `view` as a rasteriser at `detail` draws whole trees. (At
    /// [`Detail::Full`] it does not look for leaves that are thinner than a twelfth of a pixel.)
    #[must_use]
    pub fn new(view: &View, frame: &Frame, detail: Detail) -> Self {
        let mut rasterizer = Rasterizer::with_detail(detail);
        let down = detail.down(f32::INFINITY);
        rasterizer.sheet.grid.reset(frame.width, frame.height, down);
        Self { rasterizer, camera: Camera::new(view, frame), frame: *frame, down }
    }

    /// Draws `parts` of `tree` into `out`.
    pub fn draw(&mut self, tree: &Tree, parts: Parts, out: &mut Layer) {
        (out.across, out.rows) = self.extent(tree, parts);
        out.down = self.down;
        out.words.clear();
        self.rasterizer.sample_onto(&Scene::new(tree, &self.camera, self.down, parts));
        let samples = (out.rows.start * self.down) as usize..(out.rows.end * self.down) as usize;
        self.rasterizer.sheet.grid.take(out.across.clone(), samples, &mut out.words);
    }

    /// Rewrites `picture`, which is that of `stack`, where it would be another one with `parts` of `tree` in the place
    /// of the layer `old`.
    ///
    /// Quicker than to draw a layer for [`Stack::exchanged`]: what lies behind pixels that are black without it is
    /// not drawn.
    pub fn exchanged(&mut self, tree: &Tree, parts: Parts, stack: &Stack, old: &Layer, picture: &mut Bitmap) {
        let (words, rows) = self.extent(tree, parts);
        let across = join(words, old.across.clone());
        let rows = join(rows, old.rows.clone());
        let mut rest = vec![0; across.len()];
        for y in rows.clone() {
            for row in (y * self.down) as usize..((y + 1) * self.down) as usize {
                stack.without(old, row, &across, &mut rest);
                self.rasterizer.sheet.grid.set_line(row, across.start, &rest);
            }
            self.rasterizer.sheet.grid.saturate(y, across.clone(), stack.half);
        }
        self.rasterizer.sample_onto(&Scene::new(tree, &self.camera, self.down, parts));
        for y in rows {
            self.rasterizer.sheet.grid.resolve_and_clear(y, across.clone(), stack.half, picture.row_mut(y));
        }
    }

    /// Words of samples across and rows of pixels outside which `parts` of `tree` cover nothing.
    fn extent(&self, tree: &Tree, parts: Parts) -> (Range<usize>, Range<u32>) {
        let Frame { width, height, .. } = self.frame;
        // A word has eight pixels, as a pixel has eight samples across.
        let words =
            |columns: Range<u32>| (columns.start / ACROSS) as usize..columns.end.div_ceil(ACROSS) as usize;
        if !self.camera.is_orthographic() {
            return (words(0..width), 0..height);
        }
        let mut extent =
            Extent { camera: &self.camera, low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };
        for stem in tree.stems.iter().filter(|stem| parts.has_stem(stem.kind)) {
            let knots = tree.knots_of(stem);
            let widest = knots.iter().map(|knot| knot.radius).fold(0.0, f64::max);
            for knot in knots {
                for point in [knot.point, knot.handle_in, knot.handle_out] {
                    extent.add(point, widest);
                }
            }
        }
        if parts.contains(Parts::LEAVES) {
            let reaches: Vec<f32> = tree.leaf_shapes.iter().map(|shape| reach(shape.corners())).collect();
            extent.leaves(&tree.leaves, |leaf| reaches[usize::from(leaf.shape)]);
        }
        if parts.contains(Parts::BLOSSOMS) {
            let far = |v: &[f32; 3]| v.iter().map(|x| x * x).sum::<f32>().sqrt();
            let reaches: Vec<f32> = tree
                .blossom_shapes
                .iter()
                .map(|s| s.faces().vertices.iter().map(far).fold(0.0, f32::max))
                .collect();
            extent.leaves(&tree.blossoms, |blossom| reaches[usize::from(blossom.shape)]);
        }
        if parts.contains(Parts::BLOBS) {
            tree.blob_vertices.iter().for_each(|vertex| extent.add(vertex.as_dvec3(), 0.0));
        }
        // A pixel to each side for what is rounded on the way to samples.
        let pixels = |axis: usize, size: u32| {
            let at = |v: f64| v.clamp(0.0, f64::from(size)) as u32;
            let (first, end) = (at(extent.low[axis] - 1.0), at(extent.high[axis] + 2.0));
            first..end.max(first)
        };
        (words(pixels(0, width)), pixels(1, height))
    }
}

/// How far the corners of a unit shape are from its foot.
fn reach(corners: &[[f32; 2]]) -> f32 {
    corners.iter().map(|[x, y]| math::hypotf(*x, *y)).fold(0.0, f32::max)
}

/// A box of a picture, in pixels, that grows.
struct Extent<'a> {
    camera: &'a Camera,
    low: [f64; 2],
    high: [f64; 2],
}

impl Extent<'_> {
    /// What is at most `radius` metres from `point`.
    fn add(&mut self, point: DVec3, radius: f64) {
        let (x, y) = self.camera.project(point, 1.0);
        let radius = radius * self.camera.pixels_per_meter();
        for (axis, v) in [x, y].into_iter().enumerate() {
            self.low[axis] = self.low[axis].min(v - radius);
            self.high[axis] = self.high[axis].max(v + radius);
        }
    }

    /// Leaves or blossoms whose unit shapes reach so far.
    fn leaves(&mut self, leaves: &[Leaf], reach: impl Fn(&Leaf) -> f32) {
        for leaf in leaves {
            let size = leaf.along.length().max(leaf.across.length());
            self.add(leaf.position.as_dvec3(), f64::from(reach(leaf) * size));
        }
    }
}

/// A picture of layers that lie over each other.
#[derive(Clone, Debug, Default)]
pub struct Stack {
    width: u32,
    height: u32,
    down: u32,
    words_per_row: usize,
    half: Half,
    /// Bit k of the number of layers over each sample in plane k.
    planes: Vec<Vec<u64>>,
    /// Samples under at least one layer, and under at least two.
    any: Vec<u64>,
    twice: Vec<u64>,
}

impl Stack {
    /// An empty picture for layers that are drawn in `frame` at `detail`.
    #[must_use]
    pub fn new(frame: &Frame, detail: Detail) -> Self {
        let Frame { width, height, .. } = *frame;
        let down = detail.down(f32::INFINITY);
        let words_per_row = (width as usize * ACROSS as usize).div_ceil(64);
        let words = words_per_row * (height * down) as usize;
        let (any, twice) = (vec![0; words], vec![0; words]);
        Self { width, height, down, words_per_row, half: Half::new(down), planes: Vec::new(), any, twice }
    }

    /// Lays `layer` on.
    pub fn add(&mut self, layer: &Layer) {
        self.each_word(layer, |stack, place, mut carry| {
            let mut plane = 0;
            while carry != 0 {
                if plane == stack.planes.len() {
                    stack.planes.push(vec![0; stack.any.len()]);
                }
                let word = &mut stack.planes[plane][place];
                (*word, carry) = (*word ^ carry, *word & carry);
                plane += 1;
            }
        });
    }

    /// Takes `layer` out, which has been laid on.
    pub fn remove(&mut self, layer: &Layer) {
        self.each_word(layer, |stack, place, mut borrow| {
            for plane in &mut stack.planes {
                let word = &mut plane[place];
                (*word, borrow) = (*word ^ borrow, !*word & borrow);
            }
            debug_assert_eq!(borrow, 0, "what is taken out has been laid on");
        });
    }

    fn each_word(&mut self, layer: &Layer, mut change: impl FnMut(&mut Self, usize, u64)) {
        let samples = layer.rows.start * self.down..layer.rows.end * self.down;
        for row in samples {
            let first = row as usize * self.words_per_row + layer.across.start;
            for (place, &word) in (first..).zip(layer.line(row as usize)) {
                if word == 0 {
                    continue;
                }
                change(self, place, word);
                let above = self.planes.iter().skip(1).fold(0, |above, plane| above | plane[place]);
                self.twice[place] = above;
                self.any[place] = above | self.planes.first().map_or(0, |plane| plane[place]);
            }
        }
    }

    /// The picture.
    pub fn picture(&self, out: &mut Bitmap) {
        out.reset(self.width, self.height);
        self.rewrite(0..self.words_per_row, 0..self.height, &Layer::default(), &Layer::default(), out);
    }

    /// Rewrites `picture`, which is that of the stack, where it would be another one with `new` in the place of
    /// `old`, which has been laid on.
    pub fn exchanged(&self, old: &Layer, new: &Layer, picture: &mut Bitmap) {
        let across = join(old.across.clone(), new.across.clone());
        self.rewrite(across, join(old.rows.clone(), new.rows.clone()), old, new, picture);
    }

    /// The samples of a row without the layer `old`.
    fn without(&self, old: &Layer, row: usize, across: &Range<usize>, out: &mut [u64]) {
        let line = row * self.words_per_row;
        let any = &self.any[line..][across.clone()];
        let twice = &self.twice[line..][across.clone()];
        let gone = Line::new(old, row, across);
        for (i, ((word, any), twice)) in out.iter_mut().zip(any).zip(twice).enumerate() {
            let gone = gone.word(i);
            *word = (any & !gone) | (twice & gone);
        }
    }

    fn rewrite(&self, across: Range<usize>, rows: Range<u32>, old: &Layer, new: &Layer, out: &mut Bitmap) {
        let (mut counts, mut samples) = (vec![0_u64; across.len()], vec![0_u64; across.len()]);
        for y in rows {
            counts.fill(0);
            for row in (y * self.down) as usize..((y + 1) * self.down) as usize {
                self.without(old, row, &across, &mut samples);
                let come = Line::new(new, row, &across);
                for (i, (sum, samples)) in counts.iter_mut().zip(&samples).enumerate() {
                    *sum += count(samples | come.word(i));
                }
            }
            let row = out.row_mut(y);
            for (word, &sum) in across.clone().zip(&counts) {
                let shift = word % 8 * 8;
                row[word / 8] = row[word / 8] & !(0xff << shift) | self.half.black(y, sum) << shift;
            }
        }
    }
}

/// The least range that has both.
fn join<T: Ord + Copy>(a: Range<T>, b: Range<T>) -> Range<T> {
    match (a.is_empty(), b.is_empty()) {
        (true, _) => b,
        (_, true) => a,
        _ => a.start.min(b.start)..a.end.max(b.end),
    }
}

/// The words of a layer in a row of samples, counted from the first of a box that has all of them.
struct Line<'a> {
    words: &'a [u64],
    ahead: usize,
}

impl<'a> Line<'a> {
    fn new(layer: &'a Layer, row: usize, across: &Range<usize>) -> Self {
        Self { words: layer.line(row), ahead: layer.across.start.saturating_sub(across.start) }
    }

    #[inline]
    fn word(&self, place: usize) -> u64 {
        self.words.get(place.wrapping_sub(self.ahead)).copied().unwrap_or(0)
    }
}

#[cfg(test)]
mod tests;
