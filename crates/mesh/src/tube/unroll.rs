//! Texture coordinates of bark: how many tiles of a picture go around a stem, and how many along it.
//!
//! A whole number of tiles goes around, so that there is no seam, and it is the same from base to tip, so that nothing
//! begins or ends on the way. A tile is then narrower where the stem is thinner, and to keep its form it is shorter
//! there by as much: tiles along are ∫ n/(2πr) ds for n tiles around. So pictures are not stretched anywhere but at
//! the very tip, whatever the taper.

use super::path::Ring;
use pleach_plant::math;
use std::f64::consts::TAU;

/// Width and height in metres of a tile on a stem that is as thick as its widest ring: about, since a whole number goes
/// around.
pub const TILE: f64 = 0.5;
/// Rings count as no thinner than this part of the widest: towards a point tiles would become endlessly many. What is
/// thinner is one part in 250 of the surface of a cone.
const THINNEST: f64 = 1.0 / 16.0;

/// Tiles around a stem that is `widest` metres in radius.
pub(crate) fn around(widest: f64) -> u32 {
    (TAU * widest / TILE).round().clamp(1.0, 1e4) as u32
}

/// Radius of the widest of some rings, in metres.
pub(super) fn widest(rings: &[Ring]) -> f64 {
    rings.iter().map(|ring| ring.radius).fold(0.0, f64::max)
}

/// Sets the tiles along a stem of each of its rings, and returns how many go around it.
pub(crate) fn unroll(rings: &mut [Ring]) -> u32 {
    let widest = widest(rings).max(f64::MIN_POSITIVE);
    let around = around(widest);
    let n = f64::from(around);
    let thick = |ring: &Ring| ring.radius.max(THINNEST * widest);
    let mut tiles = 0.0;
    for i in 1..rings.len() {
        let (a, b) = (&rings[i - 1], &rings[i]);
        // Between two rings a stem is a cone: the mean of one over its radius is one over their logarithmic mean.
        let (from, to) = (thick(a), thick(b));
        let is_even = (to - from).abs() < 1e-6 * from;
        let mean = if is_even { 1.0 / from } else { math::ln(to / from) / (to - from) };
        tiles += (b.along - a.along) * mean * n / TAU;
        rings[i].tiles = tiles;
    }
    around
}

/// Tiles from the base to `along` metres from it, on a line between rings.
pub(super) fn tiles_at(rings: &[Ring], along: f64) -> f64 {
    let after = rings.partition_point(|ring| ring.along < along);
    match (rings.get(after.wrapping_sub(1)), rings.get(after)) {
        (Some(a), Some(b)) => {
            let part = ((along - a.along) / (b.along - a.along).max(1e-12)).clamp(0.0, 1.0);
            a.tiles + (b.tiles - a.tiles) * part
        }
        (None, Some(first)) => first.tiles,
        (Some(last), None) => last.tiles,
        (None, None) => 0.0,
    }
}
