//! Shaded pictures of trees, drawn by the processor.
//!
//! A depth buffer finds the nearest triangle of each sample, nine samples per pixel; each sample is then
//! lit by a sun with shadows and by a sky that the crown hides in part. The same tree, palette and
//! settings give the same picture, for any number of threads.

pub(crate) mod bark;
mod camera;
pub(crate) mod clumps;
mod crown;
mod flat;
mod foliage;
mod light;
mod raster;
mod scene;
mod seen;
mod settings;
mod shade;

use crate::picture::Picture;
pub(crate) use flat::{Flat, Frame};
pub(crate) use foliage::Foliage;
use glam::Vec3;
use light::Sun;
use pleach_mesh::Palette;
use pleach_plant::{Parts, Tree};
use scene::{Scene, Wanted};
pub use settings::{Background, Ground, PreviewSettings};
use std::sync::Arc;

/// The shaded picture of `tree`, a square of `size` pixels with the default settings. For many pictures of
/// one tree make a [`Preview`] once.
#[must_use]
pub fn render(tree: &Tree, palette: &Palette, size: u32) -> Picture {
    let settings = PreviewSettings { width: size, height: size, ..PreviewSettings::default() };
    Preview::new(tree, palette, size).picture(&settings)
}

/// A tree ready to be looked at from many sides.
///
/// ```
/// use pleach_mesh::Palette;
/// use pleach_render::{Preview, PreviewSettings};
///
/// let species = pleach_generators::species("palm")?;
/// let tree = species.grow(1)?;
/// let preview = Preview::new(&tree, &Palette::new(&species.appearance, None), 48);
/// let small = PreviewSettings { width: 48, height: 48, ..PreviewSettings::default() };
/// let [front, side] = [0.0, 90.0].map(|degrees: f64| {
///     preview.picture(&PreviewSettings { azimuth: degrees.to_radians(), ..small })
/// });
/// assert_ne!(front.rgba, side.rgba);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Preview<'a> {
    scene: Scene<'a>,
    /// Whose shadows cards show.
    suns: Vec<Sun>,
}

impl<'a> Preview<'a> {
    /// Prepares `tree`, roots left out, for pictures of about `size` pixels in height.
    #[must_use]
    pub fn new(tree: &'a Tree, palette: &Palette, size: u32) -> Self {
        Self::with_parts(tree, palette, size, Parts::LEAFY)
    }

    /// Prepares `parts` of `tree` for pictures of about `size` pixels in height.
    #[must_use]
    pub fn with_parts(tree: &'a Tree, palette: &Palette, size: u32, parts: Parts) -> Self {
        Self::prepared(tree, palette, Wanted { size, parts, cells: crown::CELLS, ..Wanted::default() })
    }

    /// Prepares `tree` for cards, which show it with its own shadows.
    pub(crate) fn for_cards(tree: &'a Tree, palette: &Palette, size: u32) -> Self {
        let wanted = Wanted { size, cells: crown::CELLS, ..Wanted::default() };
        let scene = Scene::new(tree, palette, wanted);
        let suns = flat::suns(&scene);
        Self { scene, suns }
    }

    /// Prepares a twig with leaves of `foliage`; its light is reckoned more coarsely than that of a crown.
    pub(crate) fn of_twig(tree: &'a Tree, palette: &Palette, size: u32, foliage: Arc<Foliage>) -> Self {
        Self::prepared(tree, palette, Wanted { size, cells: 10, foliage: Some(foliage), ..Wanted::default() })
    }

    fn prepared(tree: &'a Tree, palette: &Palette, wanted: Wanted) -> Self {
        Self { scene: Scene::new(tree, palette, wanted), suns: Vec::new() }
    }

    /// The smallest and largest coordinates of what is drawn, in metres.
    pub(crate) fn bounds(&self) -> (Vec3, Vec3) {
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        self.scene.each_point(|p| (low, high) = (low.min(p), high.max(p)));
        if low.is_finite() { (low, high) } else { (Vec3::ZERO, Vec3::ZERO) }
    }

    /// How far the tree reaches from the vertical axis along `right` or against it, in metres.
    pub(crate) fn reach(&self, right: Vec3) -> f32 {
        let mut reach = 0.0_f32;
        self.scene.each_point(|p| reach = reach.max(p.dot(right).abs()));
        reach
    }

    /// Takes a picture from afar, in even light.
    pub(crate) fn colors(&self, frame: &Frame) -> Picture {
        flat::colors(&self.scene, &self.suns, frame)
    }

    /// The same, and one of normals, which `turn` brings into a card's space.
    pub(crate) fn flat(&self, frame: &Frame, turn: impl Fn(Vec3) -> Vec3 + Sync) -> Flat {
        flat::both(&self.scene, &self.suns, frame, turn)
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
