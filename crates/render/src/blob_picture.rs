//! Pictures of foliage that repeat, for blobs: colour and relief.
//!
//! They are baked from what [`crate::Preview`] draws on blobs. A tile is [`pleach_mesh::BLOB_TILE`] metres wide.

use crate::picture::Picture;
use crate::preview::clumps::{height, tint};
use crate::tile::{Heights, Tones};
use glam::Vec3;
use pleach_mesh::palette::linear;
use pleach_mesh::{BLOB_TILE, Material, Pictures};
use pleach_plant::Color;

/// How far what stands out most is above what stands out least, in metres.
const DEPTH: f32 = 0.08;

/// The tile of foliage of this colour, `side` pixels a side.
#[must_use]
pub fn foliage(color: Color, side: u32) -> Pictures<Picture> {
    let heights = Heights::new(side, height);
    let own = Vec3::from(linear(color));
    let tones = Tones::new(|height| own * tint(height.min(1.0)));
    Pictures {
        normal: Some(heights.normals(DEPTH / BLOB_TILE)),
        ..Pictures::tiles(Material::Leaf, heights.picture(|height| tones.tone(height)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn foliage_has_its_colour_in_the_mean_and_a_relief() {
        let color = Color([88, 140, 60]);
        let Pictures { color: picture, normal, .. } = foliage(color, 128);
        let mean = |channel: usize| {
            let all = picture.rgba.chunks_exact(4).map(|pixel| f32::from(pixel[channel]));
            all.sum::<f32>() / (128.0 * 128.0)
        };
        for (channel, wanted) in color.0.into_iter().enumerate() {
            assert!((mean(channel) - f32::from(wanted)).abs() < 10.0, "{channel}: {}", mean(channel));
        }
        let normal = normal.unwrap();
        let flat = normal.rgba.chunks_exact(4).filter(|pixel| pixel[2] > 250).count();
        assert!((100..16_000).contains(&flat), "{flat}");
    }
}
