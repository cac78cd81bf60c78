//! Markings on bark, as functions of the place on the stem.

use pleach_mesh::palette::BarkPattern;

/// How much lighter or darker than its colour bark is at a place, about 0.3 to 1.3.
///
/// `u` and `v` count tiles ([`pleach_mesh::BARK_TILE`]) around and along the stem. All tiles are the same, and meet
/// without a seam.
pub(crate) fn shade(pattern: BarkPattern, u: f32, v: f32) -> f32 {
    // Bumps per tile, around and along.
    let bumps = |around: i32, along: i32| noise(u * around as f32, v * along as f32, [around, along]);
    match pattern {
        BarkPattern::Furrowed => {
            // Ridges two or three centimetres apart, a hand long, that run into each other.
            let drift = 0.6 * bumps(10, 2) - 0.3;
            let ridge = noise(u * 20.0 + drift, v * 4.0, [20, 4]);
            0.55 + 0.6 * ridge + 0.15 * bumps(60, 20)
        }
        BarkPattern::Banded => {
            let mark = smooth(0.68, 0.8, bumps(4, 14));
            (1.06 - 0.72 * mark) * (1.0 - 0.45 * smooth(0.72, 0.9, bumps(3, 2)))
        }
        BarkPattern::Ringed => {
            let ring = v * 5.0 + 0.25 * bumps(5, 2);
            let ring = ring - ring.floor();
            let line = smooth(0.0, 0.12, ring) * (1.0 - smooth(0.88, 1.0, ring));
            0.72 + 0.3 * line + 0.12 * (bumps(20, 5) - 0.5)
        }
        BarkPattern::Smooth => 0.88 + 0.24 * bumps(8, 5),
        BarkPattern::Plain => 1.0,
    }
}

/// From 0 below `low` to 1 above `high`.
pub(crate) fn smooth(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Smooth bumps between 0 and 1, one per unit each way, that repeat after `period` units of x and of y.
pub(crate) fn noise(x: f32, y: f32, period: [i32; 2]) -> f32 {
    let (ix, iy) = (floor(x), floor(y));
    let (fx, fy) = (x - ix as f32, y - iy as f32);
    let corner = |dx: i32, dy: i32| lattice((ix + dx).rem_euclid(period[0]), (iy + dy).rem_euclid(period[1]));
    let (sx, sy) = (fx * fx * (3.0 - 2.0 * fx), fy * fy * (3.0 - 2.0 * fy));
    let lower = corner(0, 0) * (1.0 - sx) + corner(1, 0) * sx;
    let upper = corner(0, 1) * (1.0 - sx) + corner(1, 1) * sx;
    lower * (1.0 - sy) + upper * sy
}

/// The whole number at or below; without the call that [`f32::floor`] makes on processors that have no instruction for it.
pub(crate) fn floor(x: f32) -> i32 {
    let cut = x as i32;
    cut.saturating_sub(i32::from(cut as f32 > x))
}

/// A fixed height between 0 and 1 for each point of the lattice.
fn lattice(x: i32, y: i32) -> f32 {
    let mut h = (x as u32).wrapping_mul(0x85eb_ca6b) ^ (y as u32).wrapping_mul(0xc2b2_ae35);
    h = (h ^ (h >> 15)).wrapping_mul(0x2c1b_3c6d);
    h = (h ^ (h >> 12)).wrapping_mul(0x297a_2d39);
    (h ^ (h >> 15)) as f32 / u32::MAX as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_meet_without_a_seam_and_markings_stay_in_range() {
        for pattern in BarkPattern::ALL {
            for i in 0..500 {
                let (a, b) = ((i as f32 * 0.37).fract(), (i as f32 * 0.618).fract());
                let here = shade(pattern, a, b);
                assert!((0.18..1.4).contains(&here), "{pattern:?}: {here}");
                for (u, v) in [(a + 1.0, b), (a, b - 3.0), (a + 2.0, b + 1.0)] {
                    let there = shade(pattern, u, v);
                    assert!((here - there).abs() < 2e-3, "{pattern:?} at {a} {b}: {here} {there}");
                }
                let [left, right] = [0.0, 1.0 - 1e-6].map(|u| shade(pattern, u, b));
                assert!((left - right).abs() < 1e-3, "{pattern:?} at {b}: {left} {right}");
            }
        }
    }
}
