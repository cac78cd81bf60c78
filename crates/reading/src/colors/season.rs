//! Which season the colours speak of.

use super::grid::{Cell, Grid};
use super::layers::{Kind, Layers};
use super::oklab;
use super::statistics::ramp;
use pleach_plant::Season;

/// Leaves of less than this angle of hue have turned: yellow is 110 and green 142, but sunlit leaves of summer are
/// as low as 104.
const TURNED: f32 = 97.0;
/// Less hue than this per lightness is brown or grey.
const HUED: f32 = 0.13;
/// This part of the leaves and blossoms in blossom is spring.
pub(super) const BLOSSOM: f64 = 0.05;

/// Parts of the foliage: turned leaves, green ones, and petals.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Parts {
    pub(super) turned: f64,
    pub(super) green: f64,
    pub(super) petals: f64,
}

impl Parts {
    pub(super) fn new(grid: &Grid, layers: &Layers) -> Self {
        let (mut parts, mut all) = (Self::default(), 0.0_f64);
        for at in layers.cells(Kind::Foliage).filter(|&at| grid.cells[at] == Cell::Inside) {
            let color = grid.colors[at];
            let [u, v] = oklab::hue_of(color);
            let angle = oklab::angle(u, v);
            let is_hued = oklab::chroma(u, v) > HUED;
            all += 1.0;
            if layers.wood.is_petal(color) {
                parts.petals += 1.0;
            } else if is_hued && angle < TURNED {
                parts.turned += 1.0;
            } else if (TURNED..170.0).contains(&angle) && oklab::chroma(u, v) > 0.03 {
                parts.green += 1.0;
            }
        }
        let all = all.max(1.0);
        Self { turned: parts.turned / all, green: parts.green / all, petals: parts.petals / all }
    }
}

/// The season of a tree in colour, with a confidence. Young leaves without blossom are taken for summer's.
pub(super) fn season(parts: Parts, layers: &Layers, leaves_confidence: f64) -> (Season, f64) {
    if !layers.evidence.has_leaves() {
        return (Season::Winter, leaves_confidence);
    }
    if parts.petals >= BLOSSOM && parts.turned < 0.4 {
        return (Season::Spring, leaves_confidence * (0.5 + 0.45 * ramp(BLOSSOM, 0.15, parts.petals)));
    }
    let margin = parts.turned - parts.green;
    let clear = leaves_confidence * (0.5 + 0.45 * ramp(0.0, 0.3, margin.abs()));
    let doubt = 1.0 - 0.4 * ramp(0.02, BLOSSOM, parts.petals);
    (if margin > 0.0 { Season::Autumn } else { Season::Summer }, clear * doubt)
}
