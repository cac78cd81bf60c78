//! What was seen on the way, from which leafy or bare and the confidences are decided.

use super::grid::{Cell, Grid};
use super::mixture::{Mixture, Normal};
use super::oklab;
use super::statistics::{quantile, ramp};

/// Numbers that were met while a picture was read.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Evidence {
    /// Distance from grey that a twentieth of the tree exceeds.
    pub(super) chroma: f64,
    /// Whether a trunk's wood was seen.
    pub(super) trunk: bool,
    /// Its width in cells.
    pub(super) trunk_width: f64,
    /// How far up it was followed, per height of the tree.
    pub(super) trunk_height: f64,
    /// Parts of the crown that are green, yellow to red, white or pink, and pink.
    pub(super) green: f64,
    pub(super) warm: f64,
    pub(super) petals: f64,
    pub(super) pink: f64,
    /// How much more often white lies on wood with nothing above it than the other way around: -1..=1, near 1 for
    /// snow on limbs.
    pub(super) snow: f64,
    /// Part of the tree that lies deeper than wood is thick.
    pub(super) bulk: f64,
    /// Distance of wood and foliage, in spreads of hue, and in lightness.
    pub(super) apart: f64,
    pub(super) apart_light: f64,
}

impl Evidence {
    pub(super) fn see_colors(&mut self, grid: &Grid) {
        let mut all: Vec<f32> = Vec::new();
        for (at, color) in grid.colors.iter().enumerate() {
            if grid.is_tree(at) && color[0] > 0.12 {
                all.push(oklab::chroma(color[1], color[2]));
            }
        }
        self.chroma = f64::from(quantile(&mut all, 0.95).unwrap_or(0.0));
    }

    /// Whether the picture has colours: greys that a camera or JPEG tinted have less than this.
    pub(super) fn has_colors(&self) -> bool {
        self.chroma >= 0.018
    }

    /// Looks at the crown's colours and bulk.
    pub(super) fn see_crown(&mut self, grid: &Grid, wood: &Normal, crown: &[usize]) {
        let mut counts = [0_usize; 4];
        for &at in crown {
            let color = grid.colors[at];
            let (is_green, is_warm) = (wood.is_green(color), wood.is_warm(color));
            let (is_petal, is_pink) = (wood.is_petal(color), wood.is_pink(color));
            for (count, holds) in counts.iter_mut().zip([is_green, is_warm, is_petal, is_pink]) {
                *count += usize::from(holds);
            }
        }
        let part = |count: usize| count as f64 / crown.len().max(1) as f64;
        [self.green, self.warm, self.petals, self.pink] = counts.map(part);
        self.snow = snow(grid, wood);
        let thick = (0.02 * grid.height as f64).max(0.6 * self.trunk_width) as u16 + 1;
        let depths = grid.depths(thick + 1);
        let deep = depths.iter().filter(|&&depth| depth > thick).count();
        let tree = grid.cells.iter().filter(|&&cell| cell != Cell::Outside).count();
        self.bulk = deep as f64 / tree.max(1) as f64;
    }

    pub(super) fn see_mixture(&mut self, mixture: &Mixture) {
        let [.., light] = mixture.foliage.middle;
        let (w, f) = (&mixture.wood, &mixture.foliage);
        let d = |i: usize| f64::from((f.middle[i] - w.middle[i]) / (f.spread[i] + w.spread[i]) * 2.0);
        self.apart = (d(0) * d(0) + d(1) * d(1)).sqrt();
        self.apart_light = f64::from(light - w.middle[2]);
    }

    /// Evidence for leaves or blossoms: above 0 there are some.
    pub(super) fn leaf_score(&self) -> f64 {
        let white = ramp(0.2, 0.5, self.petals) * (1.0 - ramp(0.2, 0.5, self.snow));
        let petals = ramp(0.15, 0.5, self.pink) + white;
        // What is all of one width is a pole.
        let bulk = if self.trunk { ramp(0.02, 0.2, self.bulk) } else { 0.0 };
        ramp(0.05, 0.35, self.green) + ramp(0.15, 0.5, self.warm) + bulk + petals - 0.3
    }

    pub(super) fn has_leaves(&self) -> bool {
        self.leaf_score() > 0.0
    }

    pub(super) fn leaves_confidence(&self) -> f64 {
        ramp(0.016, 0.022, self.chroma) * (0.5 + 0.48 * ramp(0.0, 0.5, self.leaf_score().abs()))
    }

    /// All of a bare tree is wood; else it depends on how well the colours can be told apart.
    pub(super) fn layers_confidence(&self) -> f64 {
        let apart = if self.has_leaves() { 0.2 + 0.75 * ramp(0.8, 3.5, self.apart) } else { 1.0 };
        apart * self.leaves_confidence() * if self.trunk { 1.0 } else { 0.6 }
    }

    /// Whether what is white or pink is blossom: on a leafless tree it is snow.
    pub(super) fn blossoms(&self) -> bool {
        self.has_leaves() && self.petals > 0.04
    }

    /// How much of the crown is probably wood, before a look at its colours: little of a dense one.
    pub(super) fn share_of_wood(&self) -> f64 {
        let open = 0.4 - 0.25 * ramp(0.02, 0.15, self.bulk);
        if self.trunk { open } else { open / 2.0 }
    }
}

/// See [`Evidence::snow`].
fn snow(grid: &Grid, wood: &Normal) -> f64 {
    let is_white = |at: usize| grid.is_tree(at) && wood.is_petal(grid.colors[at]);
    // 0: nothing, 1: white, 2: other tree.
    let kind = |x: usize, y: usize| match y * grid.width + x {
        at if !grid.is_tree(at) => 0,
        at if is_white(at) => 1,
        _ => 2,
    };
    let (mut above, mut below) = (0_u32, 0_u32);
    for x in 0..grid.width {
        let mut start = 0;
        while start < grid.height {
            let end = (start + 1..grid.height).find(|&y| kind(x, y) != kind(x, start)).unwrap_or(grid.height);
            if kind(x, start) == 1 {
                let over = start.checked_sub(1).map_or(0, |y| kind(x, y));
                let under = if end < grid.height { kind(x, end) } else { 0 };
                above += u32::from((over, under) == (0, 2));
                below += u32::from((over, under) == (2, 0));
            }
            start = end;
        }
    }
    if above + below < 4 { 0.0 } else { (f64::from(above) - f64::from(below)) / f64::from(above + below) }
}
