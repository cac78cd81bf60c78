//! What wood and foliage look like in this picture.
//!
//! Two normal distributions over hue (as [`oklab::hue_of`] gives it) and lightness. Wood's comes from the trunk and
//! stays; foliage's starts from what in the crown is not like the trunk, and is fitted to what is more likely foliage,
//! a few times: expectation and maximisation (Dempster, Laird, Rubin 1977) with medians, so that neither glints nor
//! sky at the edges move it.

use super::grid::{Cell, Grid};
use super::oklab::{self, Oklab};
use super::statistics::median_and_spread;
use super::trunk::Trunk;

/// Iterations of the fit; the medians stay where they are after three or four.
const ITERATIONS: usize = 4;
/// Spreads of hue are at least this: JPEG's blocks alone have a third of it.
const MIN_SPREAD: f32 = 0.022;
/// And at most this, so that a trunk with moss and sky on it still says something.
const MAX_SPREAD: f32 = 0.045;
/// Wood in the crown is in other light than the trunk.
const MIN_WOOD_LIGHT: f32 = 0.13;
/// Foliage has sun and shade of its own.
const MIN_FOLIAGE_LIGHT: f32 = 0.09;
/// Wood seen in fewer cells than this may be chance, and is taken to be more like most bark.
const USUAL_CELLS: f32 = 40.0;
/// In this light and less, nothing can be said, and from this on, all.
const DIM: (f32, f32) = (0.08, 0.24);
/// A crown shades itself: being darker than its usual leaf says half as much against a leaf.
const SELF_SHADE: f32 = 0.5;
/// Squared distances count up to this: no single number decides alone.
const FAR: f32 = 9.0;

/// A normal distribution over hue and lightness.
#[derive(Clone, Copy, Debug)]
pub(super) struct Normal {
    pub(super) middle: [f32; 3],
    pub(super) spread: [f32; 3],
}

impl Normal {
    /// Bark as most trees have it, for a picture without a trunk.
    pub(super) const BARK: Self = Self { middle: [0.02, 0.07, 0.32], spread: [0.03, 0.04, 0.12] };

    fn fit(grid: &Grid, cells: impl Iterator<Item = usize>, min_light: f32) -> Option<Self> {
        let mut values: [Vec<f32>; 3] = Default::default();
        for color in cells.map(|at| grid.colors[at]).filter(|&color| !oklab::is_black(color)) {
            let [u, v] = oklab::hue_of(color);
            for (list, value) in values.iter_mut().zip([u, v, color[0]]) {
                list.push(value);
            }
        }
        let [u, v, light] = values.each_mut().map(|list| median_and_spread(list));
        let (u, v, light) = (u?, v?, light?);
        let hue = |spread: f32| spread.clamp(MIN_SPREAD, MAX_SPREAD);
        Some(Self { middle: [u.0, v.0, light.0], spread: [hue(u.1), hue(v.1), light.1.max(min_light)] })
    }

    /// The hue moved the part `share` of the way to another's; the lightness stays.
    fn towards(mut self, other: &Self, share: f32) -> Self {
        for i in 0..2 {
            self.middle[i] += share * (other.middle[i] - self.middle[i]);
            self.spread[i] += share * (other.spread[i] - self.spread[i]);
        }
        self
    }

    /// Logarithm of the density, but for a constant. Darker colours are `darker` times as far away.
    fn log_density(&self, color: Oklab, darker: f32) -> f32 {
        let hue = self.hue_distance(color);
        let light = (color[0] - self.middle[2]) / self.spread[2];
        let light = if light < 0.0 { light * darker } else { light };
        let squares = hue * hue + light * light;
        let volume = self.spread[0] * self.spread[1] * self.spread[2];
        -0.5 * squares.min(FAR) - pleach_plant::math::lnf(volume)
    }

    /// Whether a colour beside this wood is green.
    pub(super) fn is_green(&self, color: Oklab) -> bool {
        let [u, v] = oklab::hue_of(color);
        u < (self.middle[0] - 0.03).min(-0.025) && v > 0.02
    }

    /// Whether it is yellow, orange or red, and not green.
    pub(super) fn is_warm(&self, color: Oklab) -> bool {
        let [u, v] = oklab::hue_of(color);
        let yellower = v > self.middle[1] + 0.05 && u > -0.05;
        let redder = u > self.middle[0] + 0.08;
        (yellower || redder) && oklab::chroma(u, v) > 0.15 && !self.is_green(color)
    }

    /// Whether it is a petal's, white or pink, and brighter than this wood; snow has the same colours.
    pub(super) fn is_petal(&self, color: Oklab) -> bool {
        let [u, v] = oklab::hue_of(color);
        color[0] > (self.middle[2] + 0.15).max(0.68) && u > -0.03 && v < 0.08 && v > -0.06 && u < 0.2
    }

    /// Whether it is pink.
    pub(super) fn is_pink(&self, color: Oklab) -> bool {
        let [u, v] = oklab::hue_of(color);
        self.is_petal(color) && u > 0.025 && u > v
    }

    /// Whether it is a leaf's.
    pub(super) fn is_leaf(&self, color: Oklab) -> bool {
        self.is_green(color) || self.is_warm(color)
    }

    /// Distance of hues, in spreads.
    pub(super) fn hue_distance(&self, color: Oklab) -> f32 {
        let [u, v] = oklab::hue_of(color);
        let (du, dv) = ((u - self.middle[0]) / self.spread[0], (v - self.middle[1]) / self.spread[1]);
        (du * du + dv * dv).sqrt()
    }
}

/// Both distributions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mixture {
    pub(super) wood: Normal,
    pub(super) foliage: Normal,
    log_odds: f32,
}

impl Mixture {
    /// Fits foliage to `crown`; `None` if nothing there has another colour than wood.
    pub(super) fn fit(grid: &Grid, wood: Normal, crown: &[usize], share_of_wood: f32) -> Option<Self> {
        let log_odds = pleach_plant::math::lnf(share_of_wood / (1.0 - share_of_wood));
        let leafy = crown.iter().copied().filter(|&at| wood.is_leaf(grid.colors[at]));
        let other = crown.iter().copied().filter(|&at| wood.hue_distance(grid.colors[at]) > 1.5);
        let foliage = if 20 * leafy.clone().count() > crown.len() {
            Normal::fit(grid, leafy, MIN_FOLIAGE_LIGHT)?
        } else {
            Normal::fit(grid, other, MIN_FOLIAGE_LIGHT)?
        };
        let mut mixture = Self { wood, foliage, log_odds };
        for _ in 0..ITERATIONS {
            let likely = crown.iter().copied().filter(|&at| mixture.wood_share(grid.colors[at]) < 0.5);
            let Some(foliage) = Normal::fit(grid, likely, MIN_FOLIAGE_LIGHT) else { break };
            mixture.foliage = foliage;
        }
        Some(mixture)
    }

    /// How likely a colour is wood's, 0..=1.
    pub(super) fn wood_share(&self, color: Oklab) -> f32 {
        let odds = self.wood.log_density(color, 1.0) - self.foliage.log_density(color, SELF_SHADE);
        let odds = odds * ((color[0] - DIM.0) / (DIM.1 - DIM.0)).clamp(0.0, 1.0) + self.log_odds;
        1.0 / (1.0 + pleach_plant::math::expf(-odds))
    }
}

/// The wood that a trunk shows, unless it is green: foliage that hides it, or ivy.
pub(super) fn wood_of(grid: &Grid, trunk: &Trunk) -> Option<Normal> {
    let inner: Vec<usize> =
        trunk.cells.iter().copied().filter(|&at| grid.cells[at] == Cell::Inside).collect();
    let cells = if inner.len() >= 8 { &inner } else { &trunk.cells };
    let wood = Normal::fit(grid, cells.iter().copied(), MIN_WOOD_LIGHT)?;
    let is_green = wood.middle[0] < -0.045 && wood.middle[1] > 0.05;
    let share = cells.len() as f32 / (cells.len() as f32 + USUAL_CELLS);
    (!is_green).then(|| wood.towards(&Normal::BARK, 1.0 - share))
}
