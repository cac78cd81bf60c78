//! Pictures of bark that repeat: its colour, its relief, and how rough it is.
//!
//! They are baked from the markings that [`crate::Preview`] draws, so that a mesh in another program has the bark of
//! pleach's own pictures. A tile is [`pleach_mesh::BARK_TILE`] metres wide on thick stems.

use crate::picture::Picture;
use crate::preview::bark::{shade, smooth};
use crate::tile::{Heights, Tones, byte};
use glam::Vec3;
use pleach_mesh::palette::{BarkPattern, linear};
use pleach_mesh::{BARK_TILE, Material, Pictures};
use pleach_plant::Color;

/// Sides of pictures in pixels that are offered.
pub const SIDES: [u32; 3] = [512, 1024, 2048];

/// Depth in metres of markings whose shade goes from 0 to 1.
const fn depth(pattern: BarkPattern) -> f32 {
    match pattern {
        BarkPattern::Furrowed => 0.02,
        BarkPattern::Ringed => 0.006,
        BarkPattern::Smooth => 0.004,
        BarkPattern::Banded => 0.003,
        BarkPattern::Plain => 0.0,
    }
}

/// The tile of bark of this pattern and colour, `side` pixels a side.
#[must_use]
pub fn bark(pattern: BarkPattern, color: Color, side: u32) -> Pictures<Picture> {
    let heights = Heights::new(side, |u, v| shade(pattern, u, v));
    let own = Vec3::from(linear(color));
    let tones = Tones::new(|shade| own * shade);
    let roughness = |height: f32| {
        [byte(0.55 + 0.45 * smooth(0.4, 0.9, height)), byte(0.95 - 0.15 * smooth(0.6, 1.2, height)), 0]
    };
    Pictures {
        normal: Some(heights.normals(depth(pattern) / BARK_TILE as f32)),
        roughness: Some(heights.picture(roughness)),
        ..Pictures::tiles(Material::Bark, heights.picture(|height| tones.tone(height)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BROWN: Color = Color([120, 96, 72]);

    fn pixel(picture: &Picture, x: u32, y: u32) -> [i32; 3] {
        let at = ((y * picture.width + x) * 4) as usize;
        std::array::from_fn(|c| i32::from(picture.rgba[at + c]))
    }

    /// Greatest difference between neighbours of a row or a column.
    fn step(picture: &Picture, a: (u32, u32), b: (u32, u32)) -> i32 {
        let (a, b) = (pixel(picture, a.0, a.1), pixel(picture, b.0, b.1));
        (0..3).map(|c| (a[c] - b[c]).abs()).max().unwrap()
    }

    #[test]
    fn tiles_have_no_seam() {
        for pattern in BarkPattern::ALL {
            let pictures = bark(pattern, BROWN, 256);
            for (what, picture) in pictures.all() {
                let last = picture.width - 1;
                let seam = (0..=last)
                    .map(|i| step(picture, (last, i), (0, i)).max(step(picture, (i, last), (i, 0))));
                let inside = (0..=last).flat_map(|i| (0..last).map(move |j| (i, j)));
                let inside = inside
                    .map(|(i, j)| step(picture, (j, i), (j + 1, i)).max(step(picture, (i, j), (i, j + 1))));
                let (seam, inside) = (seam.max().unwrap(), inside.max().unwrap());
                assert!(seam <= inside, "{pattern:?} {what}: {seam} at the seam, {inside} inside");
            }
        }
    }

    #[test]
    fn plain_bark_is_even_and_furrows_are_lit_from_their_side() {
        let plain = bark(BarkPattern::Plain, BROWN, 64);
        assert!((0..64).all(|i| pixel(&plain.color, i, 63 - i) == [120, 96, 72]));
        assert!((0..64).all(|i| pixel(plain.normal.as_ref().unwrap(), i, i) == [128, 128, 255]));
        let furrowed = bark(BarkPattern::Furrowed, BROWN, 512);
        let (color, normal) = (&furrowed.color, furrowed.normal.as_ref().unwrap());
        // Where bark rises to the right its normal leans to the left.
        let mut leans = [0, 0];
        for (x, y) in (0..512).flat_map(|y| (1..511).map(move |x| (x, y))) {
            let rise = pixel(color, x + 1, y)[0] - pixel(color, x - 1, y)[0];
            if rise.abs() > 2 {
                leans[usize::from((rise > 0) == (pixel(normal, x, y)[0] < 128))] += 1;
            }
        }
        assert!(leans[1] > 100 * leans[0] && leans[1] > 10_000, "{leans:?}");
        let all: i64 = (0..512 * 512).map(|i| i64::from(pixel(color, i % 512, i / 512)[0])).sum();
        assert!((90..130).contains(&(all / (512 * 512))), "as light as its colour, about");
    }
}
