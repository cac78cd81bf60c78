//! The sky of a photograph, if some of it is seen.

use super::backdrop::{Backdrop, Sample};
use super::oklab::Oklab;
use super::reduced::Reduced;
use super::score::{MIN_DISTANCE, less};

/// A sky differs from cell to cell by less than this, in Oklab.
const SMOOTH: f32 = 0.03;
/// Of a cell's four neighbours so many are as smooth: twigs are before many others.
const MIN_NEAR: usize = 3;
/// It is at least so light, or so blue.
const LIGHT: f32 = 0.75;
const BLUE: f32 = -0.04;
/// It is seen above this part of the height.
const LOWEST: f64 = 0.6;
/// Fewer cells are not a sky.
const MIN_CELLS: usize = 60;
/// Part of the cells that at least are.
const MIN_PART: f64 = 0.004;
/// Samples that a sky is fitted to; more do not change it.
const MAX_SAMPLES: usize = 6_000;

/// What the sky looks like behind the tree.
pub(super) struct ClearSky {
    backdrop: Option<Backdrop>,
}

impl ClearSky {
    /// What is smooth, light or blue, and not low in the picture.
    pub(super) fn new(small: &Reduced) -> Self {
        let mut samples: Vec<Sample> = Vec::new();
        for y in 1..small.height.saturating_sub(1) {
            if f64::from(y) > LOWEST * f64::from(small.height) {
                break;
            }
            for x in 1..small.width.saturating_sub(1) {
                let color = small.colors[small.index(x, y)];
                let is_sky = color[0] > LIGHT || color[2] < BLUE;
                let near = [(x - 1, y), (x + 1, y), (x, y - 1), (x, y + 1)];
                let is_near = |&&(x, y): &&(u32, u32)| apart(color, small.colors[small.index(x, y)]) < SMOOTH;
                if is_sky && near.iter().filter(is_near).count() >= MIN_NEAR {
                    let (x, y) = small.middle(x, y);
                    samples.push((Self::place(small, x, y), color));
                }
            }
        }
        let least = MIN_CELLS.max((MIN_PART * small.colors.len() as f64) as usize);
        let stride = samples.len().div_ceil(MAX_SAMPLES).max(1);
        let thinned: Vec<Sample> = samples.iter().step_by(stride).copied().collect();
        let backdrop = if samples.len() < least { None } else { Backdrop::fit(&thinned) };
        Self { backdrop }
    }

    /// A pixel's place from −1 to 1 in both directions of the part of the picture.
    fn place(small: &Reduced, x: u32, y: u32) -> [f64; 2] {
        let along =
            |at: u32, start: u32, side: u32| (2.0 * f64::from(at - start) + 1.0) / f64::from(side) - 1.0;
        [along(x, small.part.x, small.part.width), along(y, small.part.y, small.part.height)]
    }

    /// How far a pixel is from the sky behind it, in spreads; infinite without a sky.
    pub(super) fn distance(&self, small: &Reduced, (x, y): (u32, u32), color: Oklab) -> f32 {
        self.backdrop
            .as_ref()
            .map_or(f32::INFINITY, |sky| sky.spreads(less(color, sky.color(Self::place(small, x, y)))) as f32)
    }

    /// Whether a distance is that of a pixel of the sky.
    pub(super) const fn is_sky(distance: f32) -> bool {
        distance < MIN_DISTANCE as f32
    }
}

pub(super) fn apart(a: Oklab, b: Oklab) -> f32 {
    let squares: f32 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
    squares.sqrt()
}
