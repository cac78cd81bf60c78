//! How far each pixel is from the background, and how far is tree.

use super::backdrop::{Backdrop, Sample};
use super::horizon::{Horizon, StepThreshold};
use super::oklab::{Converter, Oklab};
use super::photo::Photo;
use super::shadow;
use super::{Background, MaskError, Segmentation};
use crate::bitmap::Bitmap;
use crate::goal::ink::otsu;

/// Width of the frame that is taken for background, as a part of the picture's shorter side.
const FRAME: f64 = 0.02;
/// Most pixels of the frame that a background is fitted to; more do not change it.
const MAX_SAMPLES: usize = 20_000;
/// Rows near the horizon, as a part of the picture's height, where pixels may be part sky and part
/// ground.
const HAZE: f64 = 0.01;
/// Nothing nearer to the background than this, in spreads, is tree.
pub(super) const MIN_DISTANCE: f64 = 3.5;
/// Side of the parts of a picture in which the tree has a threshold of its own, as a part of the shorter side.
const TILE: f64 = 0.05;
/// What is half way between background and tree, as a part of the mean level of what stands out: a
/// little more than half, since pixels that are part tree count there too.
const HALF: f64 = 0.55;
/// Levels of a spread: 255 of them reach from black to white.
const LEVELS: f64 = 5.1;

/// Factors on the least distance of what stands out firmly, and loosely.
const FIRM: f64 = 1.5;
const LOOSE: f64 = 1.0 / 1.5;
/// The farthest that a pixel may have to be.
const MAX_LEVEL: u8 = 254;

/// What stands out from the background, before it is tidied up.
pub(super) struct Foreground {
    pub(super) ink: Bitmap,
    pub(super) horizon: Option<Horizon>,
    /// How tree and background were separated.
    pub(super) segmentation: Segmentation,
    /// What stands out even if the least distance is half as far again.
    pub(super) firm: Bitmap,
    /// What stands out if the least distance is a third nearer.
    pub(super) loose: Bitmap,
}

impl Foreground {
    /// What the picture itself says: its ink, and what is firmly and loosely so.
    pub(super) const fn given(segmentation: Segmentation, ink: Bitmap, firm: Bitmap, loose: Bitmap) -> Self {
        Self { ink, horizon: None, segmentation, firm, loose }
    }
}

/// Finds what stands out from the background, for each possible horizon, the clearest
/// first and none last.
pub(super) fn foregrounds(
    photo: &Photo,
    background: Background,
) -> impl Iterator<Item = Result<Foreground, MaskError>> + '_ {
    let frame = PhotoFrame::new(photo);
    let (left, right) = (frame.side(0), frame.side(photo.width() - frame.width));
    let detect = |clear| Horizon::detect(&left, &right, clear);
    let mut horizons = match background {
        Background::Plain => vec![None],
        Background::Sky => vec![detect(StepThreshold::LENIENT)],
        Background::Auto => vec![detect(StepThreshold::STRICT), detect(StepThreshold::LENIENT), None],
    };
    if horizons[0].is_none() {
        // The same as the last one.
        horizons.rotate_left(1);
    }
    horizons.dedup();
    horizons.into_iter().map(move |horizon| foreground(&frame, horizon))
}

/// Finds what stands out from the background above and below a horizon, or from one background.
fn foreground(frame: &PhotoFrame<'_>, horizon: Option<Horizon>) -> Result<Foreground, MaskError> {
    let photo = frame.photo;
    let (width, height) = (photo.width(), photo.height());
    let (above, below) = frame.samples(horizon);
    let untold = MaskError::NoTree { why: "the frame has too few pixels to tell the background by" };
    let above = Backdrop::fit(&above).ok_or(untold)?;
    let below = Backdrop::fit(&below);
    let haze = (HAZE * f64::from(height)).max(1.0);

    let mut levels = Vec::with_capacity(width as usize * height as usize);
    let mut histogram = [0_u64; 256];
    let mut shade = Bitmap::new(width, height);
    for y in 0..height {
        for x in 0..width {
            let color = frame.converter.oklab(photo.rgb(x, y));
            let at = frame.place(x, y);
            let depth = match (horizon, &below) {
                (Some(horizon), Some(_)) => f64::from(y) + 0.5 - horizon.at(x, width),
                _ => f64::NEG_INFINITY,
            };
            let distance = match &below {
                Some(below) if depth.abs() <= haze => between(&above, below, at, color),
                Some(below) if depth > 0.0 => below.spreads(less(color, below.color(at))),
                _ => above.spreads(less(color, above.color(at))),
            };
            let level = (LEVELS * distance).min(255.0) as u8;
            if distance > LOOSE * MIN_DISTANCE {
                let ground = below.as_ref().filter(|_| depth > 0.0).unwrap_or(&above);
                let spreads = |difference| ground.spreads(difference);
                shade.set(x, y, shadow::is_shade(color.map(f64::from), ground.color(at), spreads));
            }
            // Trunk and lawn say nothing about crown and sky.
            if depth <= 0.0 {
                histogram[usize::from(level)] += 1;
            }
            levels.push(level);
        }
    }
    let even = MaskError::NoTree { why: "the picture has about one colour" };
    let least = (LEVELS * MIN_DISTANCE) as u8;
    let root = u32::from(otsu(&square_roots(&histogram)).ok_or(even)?);
    let level = ((root * root / 255) as u8).max(least);
    let row = width as usize;
    let local = Local::new(&levels, width, height, level);
    let beyond = |part: f64| {
        Bitmap::from_fn(width, height, |x, y| {
            let least = (part * f64::from(level.max(local.half_way(x, y)))) as u8;
            levels[y as usize * row + x as usize] > least.min(MAX_LEVEL)
        })
    };
    let (mut ink, mut firm, mut loose) = (beyond(1.0), beyond(FIRM), beyond(LOOSE));
    let shadow = shadow::on_ground(&ink, &shade);
    [&mut ink, &mut firm, &mut loose].into_iter().for_each(|map| map.subtract(&shadow));
    let segmentation = Segmentation::Color { threshold: f64::from(level) / LEVELS, horizon };
    Ok(Foreground { ink, horizon, segmentation, firm, loose })
}

pub(super) fn less(color: Oklab, other: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| f64::from(color[i]) - other[i])
}

/// Distance from the nearest mixture of sky and ground.
fn between(above: &Backdrop, below: &Backdrop, at: [f64; 2], color: Oklab) -> f64 {
    let (sky, ground) = (above.color(at), below.color(at));
    let spreads = (0..=4).map(|quarter| {
        let share = f64::from(quarter) / 4.0;
        let mixed = std::array::from_fn(|i| sky[i] + share * (ground[i] - sky[i]));
        let difference = less(color, mixed);
        above.spreads(difference).min(below.spreads(difference))
    });
    spreads.fold(f64::INFINITY, f64::min)
}

/// The pixels along the picture's edges.
pub(super) struct PhotoFrame<'a> {
    pub(super) photo: &'a Photo,
    pub(super) converter: Converter,
    /// In pixels.
    pub(super) width: u32,
}

impl<'a> PhotoFrame<'a> {
    pub(super) fn new(photo: &'a Photo) -> Self {
        let side = photo.width().min(photo.height());
        let width = ((f64::from(side) * FRAME).round() as u32).clamp(1, side);
        Self { photo, converter: Converter::new(), width }
    }

    /// A pixel's place from −1 to 1 in both directions.
    pub(super) fn place(&self, x: u32, y: u32) -> [f64; 2] {
        let part = |at: u32, of: u32| (2.0 * f64::from(at) + 1.0) / f64::from(of) - 1.0;
        [part(x, self.photo.width()), part(y, self.photo.height())]
    }

    /// Mean colours of the rows of the strip that begins at `column`.
    fn side(&self, column: u32) -> Vec<Oklab> {
        let row = |y| {
            let mut sum = [0.0; 3];
            for x in column..column + self.width {
                let color = self.converter.oklab(self.photo.rgb(x, y));
                sum.iter_mut().zip(color).for_each(|(s, c)| *s += c);
            }
            sum.map(|s| s / self.width as f32)
        };
        (0..self.photo.height()).map(row).collect()
    }

    /// Samples of the background above and below the horizon; all are above if there is none.
    pub(super) fn samples(&self, horizon: Option<Horizon>) -> (Vec<Sample>, Vec<Sample>) {
        let (w, h, f) = (self.photo.width(), self.photo.height(), self.width);
        let gap = 2.0 * (HAZE * f64::from(h)).max(1.0);
        let stride = (2 * (w as usize + h as usize) * f as usize).div_ceil(MAX_SAMPLES).max(1);
        let (mut above, mut below) = (Vec::new(), Vec::new());
        let mut count = 0_usize;
        for y in 0..h {
            for x in 0..w {
                if x >= f && x < w - f && y >= f && y < h - f {
                    continue;
                }
                count += 1;
                if !count.is_multiple_of(stride) {
                    continue;
                }
                let sample = (self.place(x, y), self.converter.oklab(self.photo.rgb(x, y)));
                match horizon {
                    Some(horizon) => {
                        let depth = f64::from(y) + 0.5 - horizon.at(x, w);
                        if depth > gap {
                            below.push(sample);
                        } else if depth < -gap {
                            above.push(sample);
                        }
                    }
                    None => above.push(sample),
                }
            }
        }
        (above, below)
    }
}

/// A histogram of the square roots of what another one counts, both up to 255.
///
/// Otsu's two parts should be about as wide as each other, and tree varies more than background does:
/// roots even that out.
fn square_roots(histogram: &[u64; 256]) -> [u64; 256] {
    let mut roots = [0; 256];
    for (level, count) in histogram.iter().enumerate() {
        roots[(255.0 * level as f64).sqrt().round() as usize] += count;
    }
    roots
}

/// How far tree is from the background in each part of a picture.
///
/// Trees have many tones. One threshold for all is too high for leaves in the sun, or so low that every
/// pixel is ink that a leaf of the shade just touches. As with the local thresholds of Bernsen, "Dynamic
/// thresholding of grey-level images" (1986), pixels are compared with the middle of what is around them.
struct Local {
    tile: u32,
    columns: usize,
    /// Mean level of what stands out, around each tile.
    means: Vec<f64>,
}

impl Local {
    fn new(levels: &[u8], width: u32, height: u32, level: u8) -> Self {
        let tile = (f64::from(width.min(height)) * TILE).ceil() as u32;
        let (columns, rows) = (width.div_ceil(tile) as usize, height.div_ceil(tile) as usize);
        let mut sums = vec![(0_u64, 0_u64); columns * rows];
        for (y, row) in levels.chunks_exact(width as usize).enumerate() {
            for (x, &seen) in row.iter().enumerate().filter(|(_, seen)| **seen > level) {
                let sum = &mut sums[y / tile as usize * columns + x / tile as usize];
                sum.0 += u64::from(seen);
                sum.1 += 1;
            }
        }
        let near = |at: usize, most: usize| at.saturating_sub(1)..(at + 2).min(most);
        let means = (0..rows).flat_map(|y| (0..columns).map(move |x| (x, y))).map(|(x, y)| {
            let (mut sum, mut count) = (0, 0);
            for y in near(y, rows) {
                for x in near(x, columns) {
                    sum += sums[y * columns + x].0;
                    count += sums[y * columns + x].1;
                }
            }
            sum as f64 / count.max(1) as f64
        });
        Self { tile, columns, means: means.collect() }
    }

    /// The level half way between background and tree around a pixel: where a pixel is half tree.
    fn half_way(&self, x: u32, y: u32) -> u8 {
        (HALF * self.means[(y / self.tile) as usize * self.columns + (x / self.tile) as usize]) as u8
    }
}
