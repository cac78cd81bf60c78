//! From a tree to a silhouette, without a mesh.
//!
//! Stems are tapered strips along their splines, flattened to a tenth of a pixel; leaves and blossoms
//! are polygons with no more corners than can be seen; blobs are their triangles. Shapes set the bits of a sub-sample grid that
//! they cover, and a pixel is black from half coverage: the way in which the reference silhouettes
//! were drawn, and the one that neither thickens nor loses twigs thinner than a pixel.

mod depth;
mod foliage;
mod grid;
mod layer;
mod occlusion;
mod outline;
mod sheet;
mod strip;

use crate::bitmap::Bitmap;
use crate::view::{Camera, Frame, View};
use foliage::{Placer, Run};
use glam::Vec2;
use grid::ACROSS;
pub use layer::{Layer, LayerPainter, Stack};
use pleach_plant::{Helpers, Leaf, Parts, Tree};
use sheet::Sheet;
use std::ops::Range;

/// How finely pixels are sampled: always eight samples across.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Detail {
    /// Eight samples down, sixteen where leaves are thinner than a twelfth of a pixel.
    #[default]
    Full,
    /// Four samples down: for searches.
    Half,
    /// Two samples down: for coarse searches.
    Draft,
}

/// Leaves thinner than this, in pixels, are sampled twice as finely at [`Detail::Full`]: a crown of
/// needles is grey all over, and a grey pixel needs many samples to decide between black and white.
const THIN: f32 = 1.0 / 12.0;

impl Detail {
    fn down(self, thinnest_leaf: f32) -> u32 {
        match self {
            Self::Full if thinnest_leaf < THIN => 16,
            Self::Full => 8,
            Self::Half => 4,
            Self::Draft => 2,
        }
    }
}

/// The silhouette of `tree`, leaves and blossoms included, in a square of `size` pixels that shows all of
/// it: [`Frame::automatic`] and a [`Rasterizer`] at full detail.
#[must_use]
pub fn silhouette(tree: &Tree, view: View, size: u32) -> Bitmap {
    let mut picture = Bitmap::default();
    let frame = Frame::automatic(tree, &view, Parts::LEAFY, size, size);
    Rasterizer::new().draw(tree, &view, &frame, Parts::LEAFY, &mut picture);
    picture
}

/// Draws silhouettes; keeps its memory from one to the next.
///
/// ```
/// use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
/// use pleach_plant::Parts;
///
/// let species = pleach_generators::species("palm")?;
/// let view = View::degrees(30.0, 10.0);
/// let frame = Frame::automatic(&species.grow(1)?, &view, Parts::LEAFY, 64, 64);
/// let (mut rasterizer, mut picture) = (Rasterizer::new(), Bitmap::default());
/// for seed in 1..4 {
///     rasterizer.draw(&species.grow(seed)?, &view, &frame, Parts::LEAFY, &mut picture);
///     assert!(picture.ink() > 100);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Rasterizer {
    /// How finely pixels are sampled.
    pub detail: Detail,
    /// Whether pixels that are black are not looked at any more: the same pictures, sooner where crowns are dense,
    /// but without a meaning of [`Rasterizer::coverage`].
    pub saturates: bool,
    /// Whether stems are projected before they are evaluated, and then in single precision, where there is no
    /// perspective: sooner, and the same but for a pixel here and there.
    pub flattens: bool,
    sheet: Sheet,
    /// Leaves in a row that look alike; kept for its memory.
    runs: Vec<Run>,
}

impl Rasterizer {
    /// A rasteriser at full detail.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// A rasteriser at the given detail.
    #[must_use]
    pub fn with_detail(detail: Detail) -> Self {
        Self { detail, ..Self::default() }
    }

    /// A rasteriser for the many pictures of a search, whose coverage is not asked for.
    #[must_use]
    pub fn for_searches(detail: Detail) -> Self {
        Self { detail, saturates: true, flattens: true, ..Self::default() }
    }

    /// Draws `parts` of `tree` into `out`, which takes the frame's size. Allocates nothing once its
    /// memory has grown to the picture's size.
    pub fn draw(&mut self, tree: &Tree, view: &View, frame: &Frame, parts: Parts, out: &mut Bitmap) {
        self.helped(None).draw(tree, view, frame, parts, out);
    }

    /// [`Rasterizer::draw`], and the picture of its stems alone into `stems`, in hardly more time.
    pub fn draw_with_stems(
        &mut self,
        tree: &Tree,
        view: &View,
        frame: &Frame,
        parts: Parts,
        pictures: [&mut Bitmap; 2],
    ) {
        self.helped(None).draw_with_stems(tree, view, frame, parts, pictures);
    }

    /// The same rasteriser with threads that may help to draw large trees. The pictures are the same.
    pub const fn helped<'a>(&'a mut self, helpers: Option<&'a dyn Helpers>) -> Helped<'a> {
        Helped { rasterizer: self, helpers }
    }

    /// What the last drawn tree covers of each pixel, row by row: the number of samples, of
    /// [`Rasterizer::samples`].
    pub fn coverage(&self, out: &mut Vec<u8>) {
        self.sheet.grid.coverage(out);
    }

    /// Samples of each pixel of the last drawn tree.
    #[must_use]
    pub const fn samples(&self) -> u8 {
        self.sheet.grid.samples()
    }

    /// An empty picture for `tree`; its camera, and the samples down a pixel.
    fn begin(&mut self, tree: &Tree, view: &View, frame: &Frame, parts: Parts) -> (Camera, u32) {
        let camera = Camera::new(view, frame);
        let leafy = parts.contains(Parts::LEAVES);
        let thickness = if leafy { leaf_thickness(tree, &camera) } else { f32::INFINITY };
        let down = self.detail.down(thickness);
        self.sheet.grid.reset(frame.width, frame.height, down);
        (camera, down)
    }

    /// Sets the samples of a scene and leaves the others as they are.
    fn sample_onto(&mut self, scene: &Scene<'_>) {
        self.stems_onto(scene);
        self.foliage_onto(scene);
    }

    fn stems_onto(&mut self, scene: &Scene<'_>) {
        let Scene { tree, camera, scale, parts, helpers } = *scene;
        self.sheet.occlusion.reset();
        let flattens = self.flattens && camera.is_orthographic();
        let hides = self.saturates && tree.knots.len() > self.sheet.grid.area() / KNOTS_TO_HIDE;
        let count = parts_of(tree.knots.len());
        self.sheet.draw(count, helpers, &|sheet, part| {
            let stems = &tree.stems[part_of(tree.stems.len(), part, count)];
            for stem in stems.iter().filter(|stem| parts.has_stem(stem.kind)) {
                if flattens {
                    strip::flat::draw(&mut sheet.grid, &mut sheet.occlusion, camera, scale, tree, stem);
                    if hides {
                        sheet.look(PIXELS_FOR_A_PIECE);
                    }
                } else {
                    strip::draw(&mut sheet.grid, camera, scale, tree, stem);
                }
            }
        });
    }

    fn foliage_onto(&mut self, scene: &Scene<'_>) {
        if scene.parts.contains(Parts::LEAVES) {
            self.leaves(scene);
        }
        if scene.parts.contains(Parts::BLOSSOMS) {
            self.blossoms(scene);
        }
        if scene.parts.contains(Parts::BLOBS) {
            self.blobs(scene);
        }
    }
}

/// A [rasteriser](Rasterizer::helped) with threads that may help.
#[derive(Debug)]
pub struct Helped<'a> {
    rasterizer: &'a mut Rasterizer,
    helpers: Option<&'a dyn Helpers>,
}

impl Helped<'_> {
    /// [`Rasterizer::draw`].
    pub fn draw(self, tree: &Tree, view: &View, frame: &Frame, parts: Parts, out: &mut Bitmap) {
        let Self { rasterizer, helpers } = self;
        let (camera, down) = rasterizer.begin(tree, view, frame, parts);
        rasterizer.sample_onto(&Scene { helpers, ..Scene::new(tree, &camera, down, parts) });
        rasterizer.sheet.grid.resolve(out);
    }

    /// [`Rasterizer::draw_with_stems`].
    pub fn draw_with_stems(
        self,
        tree: &Tree,
        view: &View,
        frame: &Frame,
        parts: Parts,
        [stems, out]: [&mut Bitmap; 2],
    ) {
        let Self { rasterizer, helpers } = self;
        let (camera, down) = rasterizer.begin(tree, view, frame, parts);
        let scene = Scene { helpers, ..Scene::new(tree, &camera, down, parts) };
        rasterizer.stems_onto(&scene);
        rasterizer.sheet.grid.resolve(stems);
        rasterizer.foliage_onto(&scene);
        rasterizer.sheet.grid.resolve(out);
    }
}

/// What is drawn: parts of a tree as a camera sees them.
struct Scene<'a> {
    tree: &'a Tree,
    camera: &'a Camera,
    /// Turns pixels into samples.
    scale: Vec2,
    parts: Parts,
    helpers: Option<&'a dyn Helpers>,
}

impl<'a> Scene<'a> {
    /// Of so many samples down a pixel.
    const fn new(tree: &'a Tree, camera: &'a Camera, down: u32, parts: Parts) -> Self {
        let scale = Vec2::new(ACROSS as f32, down as f32);
        Self { tree, camera, scale, parts, helpers: None }
    }
}

/// Most parts into which the stems, and each pass over the foliage, are cut for helpers.
const PARTS: usize = 32;
/// Knots, leaves or blossoms of a part on average, at least: what takes as long as to clear a sheet a few times.
const MIN_PART: usize = 512;

/// Parts into which so many knots, leaves or blossoms are cut.
fn parts_of(count: usize) -> usize {
    (count / MIN_PART).clamp(1, PARTS)
}

/// The items of part `part` if `count` items are cut into `parts`.
const fn part_of(count: usize, part: usize, parts: usize) -> Range<usize> {
    count * part / parts..count * (part + 1) / parts
}

/// Pieces of stems are hidden if there is more than one knot per this many pixels.
const KNOTS_TO_HIDE: usize = 16;
/// Black pixels are looked for after a stem once there is a piece per this many pixels.
const PIXELS_FOR_A_PIECE: usize = 64;

/// Every how many leaves one is measured for the mean thickness: an estimate is enough.
const MEASURED: usize = 64;

/// Mean width of leaves in pixels, seen from the front of the blade; infinite without leaves.
fn leaf_thickness(tree: &Tree, camera: &Camera) -> f32 {
    let width = |leaf: &Leaf| tree.outline_of(leaf).width() * leaf.across.length();
    let measured = tree.leaves.iter().step_by(MEASURED);
    let count = tree.leaves.len().div_ceil(MEASURED);
    if count == 0 {
        return f32::INFINITY;
    }
    measured.map(width).sum::<f32>() / count as f32 * camera.pixels_per_meter() as f32
}
