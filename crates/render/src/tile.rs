//! Pictures that repeat: colour and relief of a height above a plane.

use crate::picture::Picture;
use crate::srgb;
use glam::Vec3;
use rayon::prelude::*;

/// A square whose heights repeat.
pub(crate) struct Heights {
    side: u32,
    all: Vec<f32>,
}

impl Heights {
    /// `side` times `side` samples of `height`, which takes the place across and down, each from 0 to 1.
    pub(crate) fn new(side: u32, height: impl Fn(f32, f32) -> f32 + Sync) -> Self {
        let side = side.max(1);
        let at = |i: u32| (i as f32 + 0.5) / side as f32;
        let row = |y: u32| (0..side).map(|x| height(at(x), at(y))).collect::<Vec<f32>>();
        Self { side, all: (0..side).into_par_iter().flat_map_iter(row).collect() }
    }

    fn at(&self, x: u32, y: u32) -> f32 {
        self.all[((y % self.side) * self.side + x % self.side) as usize]
    }

    /// The picture in which each pixel is what `color` makes of its height.
    pub(crate) fn picture(&self, color: impl Fn(f32) -> [u8; 3] + Sync) -> Picture {
        self.paint(|x, y| color(self.at(x, y)))
    }

    /// Directions in tangent space, x to the right, y up, of a relief in which 1 is as high as `depth` sides of the square.
    pub(crate) fn normals(&self, depth: f32) -> Picture {
        let last = self.side - 1;
        // For differences over two pixels.
        let steep = depth * self.side as f32 / 2.0;
        self.paint(|x, y| {
            let right = self.at(x + 1, y) - self.at(x + last, y);
            let up = self.at(x, y + last) - self.at(x, y + 1);
            let (dx, dy) = (-right * steep, -up * steep);
            let length = (dx * dx + dy * dy + 1.0).sqrt();
            [dx, dy, 1.0].map(|part| byte(0.5 + 0.5 * part / length))
        })
    }

    fn paint(&self, pixel: impl Fn(u32, u32) -> [u8; 3] + Sync) -> Picture {
        let opaque = |[r, g, b]: [u8; 3]| [r, g, b, 255];
        let row = |y: u32| (0..self.side).flat_map(|x| opaque(pixel(x, y))).collect::<Vec<u8>>();
        let rgba = (0..self.side).into_par_iter().flat_map_iter(row).collect();
        Picture { width: self.side, height: self.side, rgba }
    }
}

pub(crate) fn byte(part: f32) -> u8 {
    (part.clamp(0.0, 1.0) * 255.0).round() as u8
}

/// Colours by shade, as sRGB.
pub(crate) struct Tones(Vec<[u8; 3]>);

impl Tones {
    /// Steps of the table, and the lightest shade.
    const STEPS: usize = 2048;
    const LIGHTEST: f32 = 2.0;

    /// `light` gives the light of a shade.
    pub(crate) fn new(light: impl Fn(f32) -> Vec3) -> Self {
        let of = |step: usize| {
            light(Self::LIGHTEST * step as f32 / Self::STEPS as f32).to_array().map(srgb::encode)
        };
        Self((0..=Self::STEPS).map(of).collect())
    }

    pub(crate) fn tone(&self, shade: f32) -> [u8; 3] {
        let step = (shade / Self::LIGHTEST * Self::STEPS as f32).round().max(0.0) as usize;
        self.0[step.min(Self::STEPS)]
    }
}
