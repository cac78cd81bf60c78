//! Colours as people see them apart. Oklab keeps the hue of blues steady while they fade, as skies do.

pub(super) use pleach_plant::oklab::Oklab;
use pleach_plant::oklab::{from_linear, linear_table};

/// From sRGB with 8 bits a channel.
pub(super) struct Converter {
    /// Light of each of the 256 values.
    linear: [f32; 256],
}

impl Converter {
    pub(super) fn new() -> Self {
        Self { linear: linear_table() }
    }

    pub(super) fn oklab(&self, rgb: [u8; 3]) -> Oklab {
        from_linear(rgb.map(|v| self.linear[usize::from(v)]))
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
