//! Trees by the colours that they have and that the picture's edges have not.
//!
//! Where houses, hills and other trees are behind a tree, no one surface is its background. But a person who
//! takes a picture of a tree puts it in the middle, and what is behind it mostly reaches the picture's edges.
//! So two mixtures of colours are fitted, one to what is in the middle and one to the rest, and pixels go to
//! the likelier one of them and are fitted again, a few times: as in Rother, Kolmogorov and Blake, "GrabCut"
//! (2004), with a soft ellipse in the place of a rectangle that a person drags. Neighbours agree by mean
//! fields in the place of a graph cut. All of that is done in a small picture; then each pixel of the large
//! one is asked for its own colour.

use super::Segmentation;
use super::backdrop::Backdrop;
use super::mixture::Mixture;
use super::oklab::Oklab;
use super::photo::Photo;
use super::score::{Foreground, MIN_DISTANCE, PhotoFrame, less};
use crate::bitmap::Bitmap;
use crate::pieces;

/// Longer side of the small picture.
const SIDE: u32 = 300;
/// Half axes of the ellipse that is tree at first, as parts of half the picture's width and height.
const FIRST: [f64; 2] = [0.75, 0.85];
/// What speaks for tree in the middle of the picture, as a logarithm of likelihoods; it falls by
/// [`FALL`] times as much up to an ellipse of the half axes [`REACH`].
const MIDDLE: f64 = 2.5;
const FALL: f64 = 1.4;
const REACH: [f64; 2] = [0.9, 1.0];
/// What speaks against tree where the colour is that of the upper edge.
const SKY: f64 = 6.0;
/// The sky is what the edges show down to this part of the height ...
const UPPER: f64 = 0.4;
/// ... unless more than this part of the first ellipse has its colours: a crown fills the upper edge.
const MAX_SKY: f64 = 0.7;
/// A colour speaks for either side by this at most.
const MAX_COLOR: f64 = 6.0;
/// How much neighbours that agree speak for their side.
const NEIGHBORS: f64 = 4.0;
/// Rounds of fitting, after which few pixels change sides; rounds of mean fields in each.
const ROUNDS: usize = 6;
const FIELDS: usize = 6;
/// Components of the tree's colours, and of all others.
const COMPONENTS: [usize; 2] = [5, 7];
/// Fewer pixels of the small picture are not a tree.
const MIN_TREE: u64 = 50;
/// What speaks for tree by more, or by less, is firm or loose.
const MARGIN: f64 = 1.5;

/// What has other colours than the picture's edges; `None` if nothing has.
pub(super) fn foreground(photo: &Photo) -> Option<Foreground> {
    let frame = &PhotoFrame::new(photo);
    let small = Small::new(frame);
    let sky = Sky::new(frame);
    let (tree, rest, field) = small.separate(frame, &sky)?;
    let (width, height) = (photo.width(), photo.height());
    let (mut ink, mut firm, mut loose) =
        (Bitmap::new(width, height), Bitmap::new(width, height), Bitmap::new(width, height));
    for y in 0..height {
        for x in 0..width {
            let neighbors = NEIGHBORS * small.at(&field, x, y, width, height);
            // Far from the tree no colour is enough.
            if neighbors < -0.9 * NEIGHBORS {
                continue;
            }
            let (color, place) = (frame.converter.oklab(photo.rgb(x, y)), frame.place(x, y));
            let by_color = by_color(&tree, &rest, color);
            let for_tree = neighbors + by_color + sky.prior(place, color);
            ink.set(x, y, for_tree > 0.0);
            // A place in the middle alone makes no tree.
            firm.set(x, y, for_tree > MARGIN && by_color > MARGIN);
            loose.set(x, y, for_tree > -MARGIN);
        }
    }
    Some(Foreground { ink, horizon: None, segmentation: Segmentation::Colors, firm, loose })
}

fn by_color(tree: &Mixture<3>, rest: &Mixture<3>, color: Oklab) -> f64 {
    (tree.log_likelihood(color) - rest.log_likelihood(color)).clamp(-MAX_COLOR, MAX_COLOR)
}

/// How far out a place is, 1 at the rim of an ellipse with these half axes, squared.
fn out([x, y]: [f64; 2], [a, b]: [f64; 2]) -> f64 {
    let (x, y) = (x / a, y / b);
    x * x + y * y
}

/// What the upper edges show, if that is a sky.
struct Sky(Option<Backdrop>);

impl Sky {
    fn new(frame: &PhotoFrame<'_>) -> Self {
        let (samples, _) = frame.samples(None);
        let upper: Vec<_> = samples.into_iter().filter(|(at, _)| at[1] < 2.0 * UPPER - 1.0).collect();
        Self(Backdrop::fit(&upper))
    }

    fn has(&self, at: [f64; 2], color: Oklab) -> bool {
        self.0.as_ref().is_some_and(|sky| sky.spreads(less(color, sky.color(at))) < MIN_DISTANCE)
    }

    /// What place and sky say, before any colour of the tree is known.
    fn prior(&self, at: [f64; 2], color: Oklab) -> f64 {
        MIDDLE * (1.0 - FALL * out(at, REACH)) - if self.has(at, color) { SKY } else { 0.0 }
    }
}

/// The photograph at a small size.
struct Small {
    width: u32,
    height: u32,
    colors: Vec<Oklab>,
}

impl Small {
    fn new(frame: &PhotoFrame<'_>) -> Self {
        let (photo, longer) = (frame.photo, frame.photo.width().max(frame.photo.height()));
        let scaled = |side: u32| if longer > SIDE { (side * SIDE).div_ceil(longer).max(1) } else { side };
        let (width, height) = (scaled(photo.width()), scaled(photo.height()));
        let bounds = |at: u32, of: u32, side: u32| {
            let first = (u64::from(at) * u64::from(side) / u64::from(of)) as u32;
            let end = (u64::from(at + 1) * u64::from(side) / u64::from(of)) as u32;
            first..end.max(first + 1)
        };
        let mut colors = Vec::with_capacity(width as usize * height as usize);
        for y in 0..height {
            for x in 0..width {
                let (mut sum, mut count) = ([0_u32; 3], 0);
                for y in bounds(y, height, photo.height()) {
                    for x in bounds(x, width, photo.width()) {
                        sum.iter_mut().zip(photo.rgb(x, y)).for_each(|(s, v)| *s += u32::from(v));
                        count += 1;
                    }
                }
                colors.push(frame.converter.oklab(sum.map(|s| (s / count) as u8)));
            }
        }
        Self { width, height, colors }
    }

    fn place(&self, i: usize) -> [f64; 2] {
        let part = |at: usize, of: u32| (2.0 * at as f64 + 1.0) / f64::from(of) - 1.0;
        [part(i % self.width as usize, self.width), part(i / self.width as usize, self.height)]
    }

    /// The colours of the tree, those of the rest, and how much what is around a pixel is tree, from −1 to 1.
    fn separate(&self, frame: &PhotoFrame<'_>, sky: &Sky) -> Option<(Mixture<3>, Mixture<3>, Vec<f64>)> {
        let edge = (frame.width * self.width).div_ceil(frame.photo.width()).max(2);
        let (width, height) = (self.width, self.height);
        let is_edge = |i: usize| {
            let (x, y) = (i as u32 % width, i as u32 / width);
            x.min(y).min(width - 1 - x).min(height - 1 - y) < edge
        };
        let all = 0..self.colors.len();
        let first: Vec<usize> = all.clone().filter(|&i| out(self.place(i), FIRST) < 1.0).collect();
        let skies = first.iter().filter(|&&i| sky.has(self.place(i), self.colors[i])).count();
        if skies as f64 > MAX_SKY * first.len() as f64 {
            return None;
        }
        let prior: Vec<f64> = all.clone().map(|i| sky.prior(self.place(i), self.colors[i])).collect();
        let mut is_tree = vec![false; self.colors.len()];
        first.iter().for_each(|&i| is_tree[i] = !sky.has(self.place(i), self.colors[i]));
        let mut found = None;
        for _ in 0..ROUNDS {
            let of = |wanted: &dyn Fn(usize) -> bool| -> Vec<Oklab> {
                all.clone().filter(|&i| wanted(i)).map(|i| self.colors[i]).collect()
            };
            let tree = Mixture::fit(&of(&|i| is_tree[i]), COMPONENTS[0])?;
            let rest = Mixture::fit(&of(&|i| !is_tree[i] || is_edge(i)), COMPONENTS[1])?;
            let alone: Vec<f64> =
                all.clone().map(|i| by_color(&tree, &rest, self.colors[i]) + prior[i]).collect();
            let mut together = alone.clone();
            let mut field = Vec::new();
            for _ in 0..FIELDS {
                // As the hyperbolic tangent of half of it, without one.
                let sides: Vec<f64> = together.iter().map(|m| m / (4.0 + m * m).sqrt()).collect();
                field = self.blurred(&sides);
                together = alone.iter().zip(&field).map(|(a, f)| a + NEIGHBORS * f).collect();
            }
            let ink = Bitmap::from_fn(width, height, |x, y| together[(y * width + x) as usize] > 0.0);
            let largest = pieces::piece(&ink, &pieces::widened(&ink, 1), None)?;
            if largest.ink() < MIN_TREE {
                return None;
            }
            all.clone().for_each(|i| is_tree[i] = largest.get(i as u32 % width, i as u32 / width));
            found = Some((tree, rest, field));
        }
        found
    }

    /// Blurred by about a pixel: binomial weights of four, in both directions.
    fn blurred(&self, values: &[f64]) -> Vec<f64> {
        const WEIGHTS: [f64; 5] = [0.0625, 0.25, 0.375, 0.25, 0.0625];
        let (width, height) = (self.width as usize, self.height as usize);
        let near = |at: usize, by: usize, of: usize| (at + by).saturating_sub(2).min(of - 1);
        let blur = |values: &[f64], step: &dyn Fn(usize, usize, usize) -> usize| -> Vec<f64> {
            let at = |i: usize| {
                let (x, y) = (i % width, i / width);
                WEIGHTS.iter().enumerate().map(|(by, w)| w * values[step(x, y, by)]).sum()
            };
            (0..values.len()).map(at).collect()
        };
        let across = blur(values, &|x, y, by| y * width + near(x, by, width));
        blur(&across, &|x, y, by| near(y, by, height) * width + x)
    }

    /// A value of the small picture at a pixel of one of `width` × `height`, between its four neighbours.
    fn at(&self, values: &[f64], x: u32, y: u32, width: u32, height: u32) -> f64 {
        let between = |at: u32, of: u32, side: u32| {
            let place = ((f64::from(at) + 0.5) * f64::from(side) / f64::from(of) - 0.5).max(0.0);
            let first = (place as u32).min(side - 1);
            (first as usize, (first + 1).min(side - 1) as usize, place - f64::from(first))
        };
        let (left, right, along) = between(x, width, self.width);
        let (above, below, down) = between(y, height, self.height);
        let row = |y: usize| {
            let row = &values[y * self.width as usize..];
            row[left] + along * (row[right] - row[left])
        };
        row(above) + down * (row(below) - row(above))
    }
}
