//! Colours as people see them apart, and back again.
//!
//! Oklab: Björn Ottosson, "A perceptual color space for image processing" (2020). Light that is `k` times as strong
//! multiplies all three coordinates by the cube root of `k`, so their ratios are the same in sun and shade.

use pleach_plant::{Color, math};

/// Lightness 0 to 1, green to red, blue to yellow.
pub(super) type Oklab = [f32; 3];

/// Darker than this, hues are mostly noise: ratios to the lightness are taken to this one instead.
const DARK: f32 = 0.25;

/// Green to red and blue to yellow per lightness: what shade leaves unchanged.
pub(super) fn hue_of([lightness, a, b]: Oklab) -> [f32; 2] {
    let lightness = lightness.max(DARK);
    [a / lightness, b / lightness]
}

/// Whether a colour is too dark to be a leaf's or bark's: a drawn outline, or noise in deep shade.
pub(super) fn is_black([lightness, ..]: Oklab) -> bool {
    lightness < 0.1
}

/// Angle of the hue in degrees, 0 to 360: red 29, orange 60, yellow 110, green 142, blue 264.
pub(super) fn angle(a: f32, b: f32) -> f32 {
    let degrees = math::atan2(f64::from(b), f64::from(a)).to_degrees();
    (if degrees < 0.0 { degrees + 360.0 } else { degrees }) as f32
}

/// Distance from grey.
pub(super) fn chroma(a: f32, b: f32) -> f32 {
    (a * a + b * b).sqrt()
}

/// Light of each of the 256 values of a channel (IEC 61966-2-1).
pub(super) fn linear_table() -> [f32; 256] {
    std::array::from_fn(|value| {
        let v = value as f32 / 255.0;
        if v <= 0.04045 { v / 12.92 } else { math::powf((v + 0.055) / 1.055, 2.4) }
    })
}

/// From light, 0 to 1 per channel.
#[expect(clippy::excessive_precision, reason = "as they were published")]
pub(super) fn from_linear([r, g, b]: [f32; 3]) -> Oklab {
    let l = math::cbrtf(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
    let m = math::cbrtf(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
    let s = math::cbrtf(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
    [
        0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
        1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
        0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s,
    ]
}

/// The nearest colour of screens.
#[expect(clippy::excessive_precision, reason = "as they were published")]
pub(super) fn to_color([lightness, a, b]: Oklab) -> Color {
    let cube = |x: f32| x * x * x;
    let l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
    let m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
    let s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
    let linear = [
        4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
        -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
        -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s,
    ];
    Color(linear.map(|v| {
        let v = v.clamp(0.0, 1.0);
        let v = if v <= 0.003_130_8 { v * 12.92 } else { 1.055 * math::powf(v, 1.0 / 2.4) - 0.055 };
        (255.0 * v).round() as u8
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_come_back_and_shade_keeps_the_hue() {
        let table = linear_table();
        for hex in (0..0x0100_0000).step_by(997) {
            let color = Color::from_hex(hex);
            let light = color.0.map(|v| table[usize::from(v)]);
            assert_eq!(to_color(from_linear(light)), color, "{color}");
        }
        let light = Color::from_hex(0x5c_83_36).0.map(|v| table[usize::from(v)]);
        let [sun, shade] = [1.0, 0.3].map(|k| hue_of(from_linear(light.map(|v| k * v))));
        assert!((sun[0] - shade[0]).abs() < 1e-4 && (sun[1] - shade[1]).abs() < 1e-4, "{sun:?} {shade:?}");
        assert!((angle(0.22486, 0.12585) - 29.2).abs() < 0.1, "red");
    }
}
