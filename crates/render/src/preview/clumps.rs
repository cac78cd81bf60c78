//! Foliage of blobs, as a function of the place on them.

use super::bark::noise;
use glam::{Vec3, vec3};

/// How far a place stands out, about 0 to 1. `u` and `v` count tiles ([`pleach_mesh::BLOB_TILE`]); all tiles are the same,
/// and meet without a seam.
pub(crate) fn height(u: f32, v: f32) -> f32 {
    let bumps = |n: i32| noise(u * n as f32, v * n as f32, [n, n]);
    // Clumps of two hands, sprays, and leaves.
    0.45 * bumps(5) + 0.3 * bumps(13) + 0.25 * bumps(34)
}

/// The tint of the colour of foliage at a height: what stands out is lighter and yellower. 1 in the mean.
pub(crate) fn tint(height: f32) -> Vec3 {
    let light = 1.0 + 1.3 * (height - 0.5);
    vec3(1.0, 1.0, 1.0) * light * (Vec3::ONE + vec3(0.5, 0.15, -0.4) * (height - 0.5))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_meet_without_a_seam_and_are_as_light_as_their_colour() {
        let mut sum = Vec3::ZERO;
        for i in 0..4096 {
            let (a, b) = ((i % 64) as f32 / 64.0, (i / 64) as f32 / 64.0);
            let here = height(a, b);
            assert!((0.0..=1.0).contains(&here), "{here}");
            for (u, v) in [(a + 1.0, b), (a, b - 3.0), (a + 2.0, b + 1.0)] {
                assert!((here - height(u, v)).abs() < 2e-3, "{a} {b}");
            }
            let tint = tint(here);
            assert!(tint.min_element() > 0.2 && tint.max_element() < 2.0, "{tint}");
            sum += tint / 4096.0;
        }
        assert!((sum - Vec3::ONE).abs().max_element() < 0.1, "{sum}");
    }
}
