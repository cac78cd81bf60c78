//! From intensities of light to bytes and back (IEC 61966-2-1), by tables: the same bits on every platform.

use pleach_mesh::palette::linear;
use pleach_plant::{Color, math};
use std::sync::LazyLock;

/// Steps of the table from 0 to 1: less than half a byte each, down to the darkest.
const STEPS: usize = 8192;

/// The byte of an intensity from 0 to 1; what is outside counts as the nearest.
pub(crate) fn encode(light: f32) -> u8 {
    static TABLE: LazyLock<Vec<u8>> = LazyLock::new(|| {
        let byte = |step: usize| {
            let light = step as f32 / STEPS as f32;
            let coded = if light <= 0.003_130_8 {
                12.92 * light
            } else {
                1.055 * math::powf(light, 1.0 / 2.4) - 0.055
            };
            (coded * 255.0).round() as u8
        };
        (0..=STEPS).map(byte).collect()
    });
    TABLE[(light.clamp(0.0, 1.0) * STEPS as f32).round() as usize]
}

/// The intensity of a byte.
pub(crate) fn decode(byte: u8) -> f32 {
    static TABLE: LazyLock<Vec<f32>> =
        LazyLock::new(|| (0..=255).map(|byte| linear(Color([byte; 3]))[0]).collect());
    TABLE[usize::from(byte)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_come_back() {
        for byte in 0..=255 {
            assert_eq!(encode(decode(byte)), byte);
        }
        assert_eq!((encode(-1.0), encode(2.0), encode(f32::NAN)), (0, 255, 0));
    }
}
