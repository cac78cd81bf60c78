//! Colours as people see them apart.
//!
//! Oklab: Björn Ottosson, "A perceptual color space for image processing" (2020). Distances in it are
//! about even to the eye: 0.02 can just be told apart, black and white are 1 apart. It keeps the hue of
//! blues steady while they fade, as skies do.

use pleach_plant::math;

/// Lightness 0 to 1, green to red, blue to yellow.
pub(super) type Oklab = [f32; 3];

/// From sRGB with 8 bits a channel.
pub(super) struct Converter {
    /// Light of each of the 256 values.
    linear: [f32; 256],
}

impl Converter {
    /// IEC 61966-2-1: the curve of sRGB.
    pub(super) fn new() -> Self {
        let linear = std::array::from_fn(|value| {
            let v = value as f32 / 255.0;
            if v <= 0.04045 { v / 12.92 } else { math::powf((v + 0.055) / 1.055, 2.4) }
        });
        Self { linear }
    }

    #[expect(clippy::excessive_precision, reason = "as they were published")]
    pub(super) fn oklab(&self, [r, g, b]: [u8; 3]) -> Oklab {
        let [r, g, b] = [r, g, b].map(|v| self.linear[usize::from(v)]);
        let l = math::cbrtf(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
        let m = math::cbrtf(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
        let s = math::cbrtf(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
        [
            0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
            1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
            0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn greys_have_no_hue_and_primaries_lie_where_they_were_published() {
        let oklab = Converter::new();
        for v in [0, 1, 60, 128, 255] {
            let [_, a, b] = oklab.oklab([v; 3]);
            assert!(a.abs() < 1e-4 && b.abs() < 1e-4, "{v}: {a} {b}");
        }
        assert!((oklab.oklab([255; 3])[0] - 1.0).abs() < 1e-4);
        for (rgb, expected) in [
            ([255, 0, 0], [0.62796, 0.22486, 0.12585]),
            ([0, 255, 0], [0.86644, -0.23389, 0.17950]),
            ([0, 0, 255], [0.45201, -0.03246, -0.31153]),
        ] {
            for (found, expected) in oklab.oklab(rgb).into_iter().zip(expected) {
                assert!((found - expected).abs() < 2e-4, "{rgb:?}: {found} {expected}");
            }
        }
    }
}
