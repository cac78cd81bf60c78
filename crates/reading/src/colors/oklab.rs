//! Hues in Oklab, whose ratios to the lightness are the same in sun and shade.

pub(super) use pleach_plant::oklab::{Oklab, from_linear, linear_table};
use pleach_plant::{Color, math};

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

/// The nearest colour of screens.
pub(super) fn to_color(color: Oklab) -> Color {
    Color::from_oklab(color.map(f64::from))
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
