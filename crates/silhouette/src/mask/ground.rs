//! The ground around a tree's foot, where a box shows the tree.

use super::backdrop::{Backdrop, Sample};
use super::cut::Cut;
use super::oklab::Oklab;
use super::pixel_box::PixelBox;
use super::shadow;

/// Ground is what is not tree from this part of the box's height above its foot on down.
const ABOVE_FOOT: f64 = 0.2;
/// Shade is looked for in this lowest part of the box: more than a shadow may take up, so that what reaches higher
/// is seen to.
const LOWEST: f64 = 0.6;
/// Samples that the ground is fitted to; more do not change it.
const MAX_SAMPLES: usize = 6_000;

/// What the ground looks like in the light.
pub(super) struct Ground {
    backdrop: Backdrop,
    part: PixelBox,
    /// The first row in which ground was seen, and the first in which shade is looked for.
    first: u32,
    shade_from: u32,
}

impl Ground {
    /// What is not tree, low in the box of a cut and below it; `None` if there is hardly anything.
    pub(super) fn new(cut: &Cut, region: &PixelBox) -> Option<Self> {
        let small = &cut.small;
        let from = |part: f64| region.y + ((1.0 - part) * f64::from(region.height)) as u32;
        let first = from(ABOVE_FOOT);
        let mut samples: Vec<Sample> = Vec::new();
        for y in 0..small.height {
            for x in (0..small.width).filter(|&x| !cut.is_tree[small.index(x, y)]) {
                let (px, py) = small.middle(x, y);
                if py >= first {
                    samples.push((place(&small.part, px, py), small.colors[small.index(x, y)]));
                }
            }
        }
        let stride = samples.len().div_ceil(MAX_SAMPLES).max(1);
        let thinned: Vec<Sample> = samples.into_iter().step_by(stride).collect();
        let backdrop = Backdrop::fit(&thinned)?;
        Some(Self { backdrop, part: small.part, first, shade_from: from(LOWEST) })
    }

    /// Whether a pixel has the ground's colour in the shade.
    pub(super) fn is_shade(&self, (x, y): (u32, u32), color: Oklab) -> bool {
        if y < self.shade_from {
            return false;
        }
        // Above the ground that was seen, its last row's colour: a surface must not be continued.
        let ground = self.backdrop.color(place(&self.part, x, y.max(self.first)));
        shadow::is_shade(color.map(f64::from), ground, |difference| self.backdrop.spreads(difference))
    }
}

/// A pixel's place from −1 to 1 in both directions of a part of the picture.
fn place(part: &PixelBox, x: u32, y: u32) -> [f64; 2] {
    let along = |at: u32, start: u32, side: u32| (2.0 * f64::from(at - start) + 1.0) / f64::from(side) - 1.0;
    [along(x, part.x, part.width), along(y, part.y, part.height)]
}
