//! Colours, and mixing them as the eye would.

use crate::math;
use std::fmt;

/// A colour as on screens: sRGB, 0 to 255 a channel. Written `#rrggbb`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Color(pub [u8; 3]);

impl Color {
    /// From `0xrrggbb`.
    #[must_use]
    pub const fn from_hex(hex: u32) -> Self {
        Self([(hex >> 16) as u8, (hex >> 8) as u8, hex as u8])
    }

    /// Reads `#rrggbb`.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        let digits = text.strip_prefix('#').filter(|d| d.len() == 6 && d.is_ascii())?;
        let channel = |i: usize| u8::from_str_radix(&digits[2 * i..2 * i + 2], 16).ok();
        Some(Self([channel(0)?, channel(1)?, channel(2)?]))
    }

    /// The mean of colours by their weights (0 or more, not all 0), in Oklab, where distances are about
    /// even to the eye: half red and half green is an ochre and not a dark brown.
    ///
    /// One colour alone, or several that are the same, come back unchanged. `None` without any weight.
    #[must_use]
    pub fn mean(parts: impl IntoIterator<Item = (Self, f64)>) -> Option<Self> {
        let parts: Vec<(Self, f64)> = parts.into_iter().filter(|(_, weight)| *weight > 0.0).collect();
        let (first, _) = *parts.first()?;
        if parts.iter().all(|(color, _)| *color == first) {
            return Some(first);
        }
        let sum: f64 = parts.iter().map(|(_, weight)| weight).sum();
        let mut mean = [0.0; 3];
        for (color, weight) in parts {
            for (mean, value) in mean.iter_mut().zip(color.oklab()) {
                *mean += value * weight / sum;
            }
        }
        Some(Self::from_oklab(mean))
    }

    /// Lightness, green to red, blue to yellow: Björn Ottosson, "A perceptual color space for image
    /// processing" (2020).
    fn oklab(self) -> [f64; 3] {
        let [r, g, b] = self.0.map(|channel| {
            let v = f64::from(channel) / 255.0;
            if v <= 0.040_45 { v / 12.92 } else { math::pow((v + 0.055) / 1.055, 2.4) }
        });
        let l = math::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
        let m = math::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
        let s = math::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
        [
            0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
            1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
            0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s,
        ]
    }

    /// The nearest colour that a screen has, from lightness, green to red, and blue to yellow in Oklab.
    #[must_use]
    pub fn from_oklab([lightness, a, b]: [f64; 3]) -> Self {
        let l = math::powi(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
        let m = math::powi(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
        let s = math::powi(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
        let linear = [
            4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
            -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
            -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s,
        ];
        Self(linear.map(|v| {
            let v = v.clamp(0.0, 1.0);
            let v = if v <= 0.003_130_8 { v * 12.92 } else { 1.055 * math::pow(v, 1.0 / 2.4) - 0.055 };
            (255.0 * v).round() as u8
        }))
    }
}

impl fmt::Display for Color {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self([r, g, b]) = self;
        write!(f, "#{r:02x}{g:02x}{b:02x}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_third_colour_comes_back_from_oklab() {
        for hex in (0..0x0100_0000).step_by(997) {
            let color = Color::from_hex(hex);
            assert_eq!(Color::from_oklab(color.oklab()), color, "{color}");
            assert_eq!(Color::parse(&color.to_string()), Some(color));
        }
    }

    #[test]
    fn a_mean_lies_between_and_keeps_what_is_alike() {
        let (black, white) = (Color([0; 3]), Color([255; 3]));
        // Lightness 0.5 in Oklab is an eighth of the light.
        assert_eq!(Color::mean([(black, 1.0), (white, 1.0)]), Some(Color([0x63; 3])));
        assert_eq!(Color::mean([(black, 0.0), (white, 2.0)]), Some(white));
        let green = Color::from_hex(0x5f_87_34);
        assert_eq!(Color::mean([(green, 0.3), (green, 0.7)]), Some(green));
        assert_eq!(Color::mean([(green, 0.0)]), None);
        // The plain mean of red and green would be #808000, dark beside both.
        let Some(Color([r, g, b])) = Color::mean([(Color([255, 0, 0]), 0.5), (Color([0, 255, 0]), 0.5)])
        else {
            panic!("a mean");
        };
        assert!(r > 170 && g > 140 && b < 40, "{r} {g} {b}");
    }
}
