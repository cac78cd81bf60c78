//! Markings on bark, as functions of the place on the stem.

use pleach_mesh::palette::BarkPattern;
use std::f32::consts::TAU;

/// How much lighter or darker than its colour bark is at a place, about 0.3 to 1.3.
///
/// `u` is the part of a turn around the stem, `v` metres along it, `radius` in metres.
pub(crate) fn shade(pattern: BarkPattern, u: f32, v: f32, radius: f32) -> f32 {
    match pattern {
        BarkPattern::Furrowed => {
            // Ridges two or three centimetres apart, a hand long, that run into each other.
            let around = (TAU * radius / 0.025).round().max(3.0);
            let half = (around * 0.5).ceil();
            let drift = 0.6 * noise(u * half, v * 3.0, half as i32) - 0.3;
            let ridge = noise((u + drift / around) * around, v * 7.0, around as i32);
            let fine = noise(u * around * 3.0, v * 40.0, (around * 3.0) as i32);
            0.55 + 0.6 * ridge + 0.15 * fine
        }
        BarkPattern::Banded => {
            let around = (TAU * radius / 0.12).round().max(2.0);
            let dash = noise(u * around, v * 28.0, around as i32);
            let mark = smooth(0.68, 0.8, dash);
            let half = (around * 0.5).ceil();
            let patch = noise(u * half, v * 2.2, half as i32);
            (1.06 - 0.72 * mark) * (1.0 - 0.45 * smooth(0.72, 0.9, patch))
        }
        BarkPattern::Ringed => {
            let ring = (v / 0.11 + 0.25 * noise(u * 5.0, v * 4.0, 5)).fract();
            let line = smooth(0.0, 0.12, ring) * (1.0 - smooth(0.88, 1.0, ring));
            0.72 + 0.3 * line + 0.12 * (noise(u * 24.0, v * 9.0, 24) - 0.5)
        }
        BarkPattern::Smooth => {
            let around = (TAU * radius / 0.06).round().max(3.0);
            0.88 + 0.24 * noise(u * around, v * 9.0, around as i32)
        }
        BarkPattern::Plain => 1.0,
    }
}

/// From 0 below `low` to 1 above `high`.
pub(crate) fn smooth(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Smooth bumps between 0 and 1, one per unit each way; in x they repeat after `period`.
fn noise(x: f32, y: f32, period: i32) -> f32 {
    let (fx, fy) = (x - x.floor(), y - y.floor());
    let (ix, iy) = (x.floor() as i32, y.floor() as i32);
    let corner = |dx: i32, dy: i32| lattice((ix + dx).rem_euclid(period.max(1)), iy + dy);
    let (sx, sy) = (fx * fx * (3.0 - 2.0 * fx), fy * fy * (3.0 - 2.0 * fy));
    let lower = corner(0, 0) * (1.0 - sx) + corner(1, 0) * sx;
    let upper = corner(0, 1) * (1.0 - sx) + corner(1, 1) * sx;
    lower * (1.0 - sy) + upper * sy
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
    fn markings_meet_at_the_seam_and_stay_in_range() {
        for pattern in BarkPattern::ALL {
            for i in 0..500 {
                let (v, radius) = (i as f32 * 0.013, 0.01 + (i % 40) as f32 * 0.01);
                let [left, right] = [0.0, 1.0 - 1e-6].map(|u| shade(pattern, u, v, radius));
                assert!((left - right).abs() < 0.05, "{pattern:?} at {v}: {left} {right}");
                let inside = shade(pattern, (i as f32 * 0.37).fract(), v, radius);
                assert!((0.18..1.4).contains(&inside), "{pattern:?}: {inside}");
            }
        }
    }
}
