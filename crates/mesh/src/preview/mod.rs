//! Shaded pictures of trees, drawn by the processor.
//!
//! A depth buffer finds the nearest triangle of each sample, nine samples a pixel; each sample is then
//! lit by a sun with shadows and by a sky that the crown hides in part. The same tree, palette and
//! settings give the same picture, for any number of threads.

mod bark;
mod camera;
mod crown;
mod flat;
mod light;
mod raster;
mod scene;
mod shade;

use crate::palette::Palette;
pub(crate) use flat::Frame;
use glam::Vec3;
use pleach_tree::Tree;
use pleach_tree::species::Color;
use scene::Scene;

/// What is behind the tree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Background {
    /// A pale wall, a little darker below.
    #[default]
    Studio,
    /// Nothing: the picture has an alpha channel.
    Transparent,
    /// One colour.
    Plain(Color),
}

/// What the tree stands on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ground {
    /// A floor of which only the tree's shadow is seen.
    #[default]
    Shadow,
    /// Short grass.
    Grass,
    /// Nothing.
    None,
}

/// How a picture is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreviewSettings {
    /// Width in pixels, 1 to 8192.
    pub width: u32,
    /// Height in pixels, 1 to 8192.
    pub height: u32,
    /// Radians around the tree; 0 looks along +y.
    pub azimuth: f64,
    /// Radians above the horizon, -π/2 to π/2.
    pub elevation: f64,
    /// What is behind the tree.
    pub background: Background,
    /// What the tree stands on.
    pub ground: Ground,
    /// Whether the tree stays inside the picture from any azimuth, for turntables.
    pub all_around: bool,
}

impl Default for PreviewSettings {
    /// 768 × 768 pixels from the front, five degrees up, in the studio.
    fn default() -> Self {
        Self {
            width: 768,
            height: 768,
            azimuth: 0.0,
            elevation: 0.09,
            background: Background::Studio,
            ground: Ground::Shadow,
            all_around: false,
        }
    }
}

/// A picture: rows from the top, four bytes a pixel, red, green, blue and alpha (not multiplied).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// sRGB and alpha.
    pub rgba: Vec<u8>,
}

impl Picture {
    /// Copies `other` with its upper left corner at (`x`, `y`); what reaches over the edge is left out.
    pub fn paste(&mut self, other: &Self, x: u32, y: u32) {
        let width = other.width.min(self.width.saturating_sub(x)) as usize * 4;
        let rows = other.height.min(self.height.saturating_sub(y)) as usize;
        if width == 0 {
            return;
        }
        for (row, pixels) in other.rgba.chunks_exact(other.width as usize * 4).enumerate().take(rows) {
            let start = ((y as usize + row) * self.width as usize + x as usize) * 4;
            self.rgba[start..start + width].copy_from_slice(&pixels[..width]);
        }
    }
}

/// A tree ready to be looked at from many sides.
#[derive(Debug)]
pub struct Preview {
    scene: Scene,
}

impl Preview {
    /// Meshes `tree` for pictures of about `size` pixels in height.
    #[must_use]
    pub fn new(tree: &Tree, palette: &Palette, size: u32) -> Self {
        Self { scene: Scene::new(tree, palette, size) }
    }

    /// The smallest and largest coordinates of what is drawn, in metres.
    pub(crate) fn bounds(&self) -> (Vec3, Vec3) {
        let points = self.scene.points.iter().copied();
        let start = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let (low, high) = points.fold(start, |(low, high), p| (low.min(p), high.max(p)));
        if low.is_finite() { (low, high) } else { (Vec3::ZERO, Vec3::ZERO) }
    }

    /// How far the tree reaches from the vertical axis along `right` or against it, in metres.
    pub(crate) fn reach(&self, right: Vec3) -> f32 {
        self.scene.points.iter().map(|p| p.dot(right).abs()).fold(0.0, f32::max)
    }

    /// Takes a picture from afar, in even light.
    pub(crate) fn flat(&self, frame: &Frame) -> Picture {
        flat::picture(&self.scene, frame)
    }

    /// Takes a picture.
    #[must_use]
    pub fn picture(&self, settings: &PreviewSettings) -> Picture {
        let settings = PreviewSettings {
            width: settings.width.clamp(1, 8192),
            height: settings.height.clamp(1, 8192),
            ..*settings
        };
        shade::picture(&self.scene, &settings)
    }
}
