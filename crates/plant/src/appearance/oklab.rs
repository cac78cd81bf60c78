//! Oklab of many pixels, in single precision.
//!
//! Björn Ottosson, "A perceptual color space for image processing" (2020). Distances in it are about even to the eye:
//! 0.02 can just be told apart, black and white are 1 apart. Light that is `k` times as strong multiplies all three
//! coordinates by the cube root of `k`.

use crate::math;

/// Lightness 0 to 1, green to red, blue to yellow.
pub type Oklab = [f32; 3];

/// Light, 0 to 1, of each of the 256 values of a channel of sRGB (IEC 61966-2-1).
#[must_use]
pub fn linear_table() -> [f32; 256] {
    std::array::from_fn(|value| {
        let v = value as f32 / 255.0;
        if v <= 0.04045 { v / 12.92 } else { math::powf((v + 0.055) / 1.055, 2.4) }
    })
}

/// The colour of red, green and blue light, 0 to 1 each.
#[must_use]
#[expect(clippy::excessive_precision, reason = "as they were published")]
pub fn from_linear([r, g, b]: [f32; 3]) -> Oklab {
    let l = math::cbrtf(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
    let m = math::cbrtf(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
    let s = math::cbrtf(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
    [
        0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
        1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
        0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s,
    ]
}
