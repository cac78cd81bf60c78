//! From a tree to a silhouette, without a mesh.
//!
//! Stems are tapered strips along their splines, flattened to a tenth of a pixel; leaves and blossoms
//! are polygons with no more corners than can be seen; blobs are their triangles. Shapes set the bits of a sub-sample grid that
//! they cover, and a pixel is black from half coverage: the way in which the reference silhouettes
//! were drawn, and the one that neither thickens nor loses twigs thinner than a pixel.

mod depth;
mod grid;
mod layer;
mod occlusion;
mod outline;
mod strip;

use crate::bitmap::Bitmap;
use crate::view::{Camera, Frame, View};
use glam::{Vec2, Vec3};
use grid::{ACROSS, Corner, Grid};
pub use layer::{Layer, LayerPainter, Stack};
use occlusion::Occlusion;
use outline::{Blade, Outlines};
use pleach_plant::leaf_shape::{Faces, Outline};
use pleach_plant::{Leaf, Parts, Tree};

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
    grid: Grid,
    /// Pixels that are black, of trees with much to draw.
    occlusion: Occlusion,
    outlines: Outlines,
    /// How many leaves in a row look alike; kept for its memory.
    runs: Vec<usize>,
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
        self.sample(tree, view, frame, parts);
        self.grid.resolve(out);
    }

    /// [`Rasterizer::draw`], and the picture of its stems alone into `stems`, in hardly more time.
    pub fn draw_with_stems(
        &mut self,
        tree: &Tree,
        view: &View,
        frame: &Frame,
        parts: Parts,
        [stems, out]: [&mut Bitmap; 2],
    ) {
        let (camera, down) = self.begin(tree, view, frame, parts);
        self.stems_onto(tree, &camera, down, parts);
        self.grid.resolve(stems);
        self.foliage_onto(tree, &camera, down, parts);
        self.grid.resolve(out);
    }

    /// What the last drawn tree covers of each pixel, row by row: the number of samples, of
    /// [`Rasterizer::samples`].
    pub fn coverage(&self, out: &mut Vec<u8>) {
        self.grid.coverage(out);
    }

    /// Samples of each pixel of the last drawn tree.
    #[must_use]
    pub const fn samples(&self) -> u8 {
        self.grid.samples()
    }

    fn sample(&mut self, tree: &Tree, view: &View, frame: &Frame, parts: Parts) {
        let (camera, down) = self.begin(tree, view, frame, parts);
        self.sample_onto(tree, &camera, down, parts);
    }

    /// An empty picture for `tree`; its camera, and the samples down a pixel.
    fn begin(&mut self, tree: &Tree, view: &View, frame: &Frame, parts: Parts) -> (Camera, u32) {
        let camera = Camera::new(view, frame);
        let leafy = parts.contains(Parts::LEAVES);
        let thickness = if leafy { leaf_thickness(tree, &camera) } else { f32::INFINITY };
        let down = self.detail.down(thickness);
        self.grid.reset(frame.width, frame.height, down);
        (camera, down)
    }

    /// Sets the samples of `parts` of `tree` and leaves the others as they are.
    fn sample_onto(&mut self, tree: &Tree, camera: &Camera, down: u32, parts: Parts) {
        self.stems_onto(tree, camera, down, parts);
        self.foliage_onto(tree, camera, down, parts);
    }

    fn stems_onto(&mut self, tree: &Tree, camera: &Camera, down: u32, parts: Parts) {
        let scale = Vec2::new(ACROSS as f32, down as f32);
        self.occlusion.reset();
        let flattens = self.flattens && camera.is_orthographic();
        let hides = self.saturates && tree.knots.len() > self.grid.area() / KNOTS_TO_HIDE;
        for stem in tree.stems.iter().filter(|stem| parts.has_stem(stem.kind)) {
            if flattens {
                strip::flat::draw(&mut self.grid, &mut self.occlusion, camera, scale, tree, stem);
                if hides {
                    self.occlusion.look(&mut self.grid, PIXELS_FOR_A_PIECE);
                }
            } else {
                strip::draw(&mut self.grid, camera, scale, tree, stem);
            }
        }
    }

    fn foliage_onto(&mut self, tree: &Tree, camera: &Camera, down: u32, parts: Parts) {
        let scale = Vec2::new(ACROSS as f32, down as f32);
        if parts.contains(Parts::LEAVES) {
            self.leaves(tree, camera, scale);
        }
        if parts.contains(Parts::BLOSSOMS) {
            self.blossoms(tree, camera, scale);
        }
        if parts.contains(Parts::BLOBS) {
            self.blobs(tree, camera, scale);
        }
    }

    /// In several passes over all of the crown where it has many leaves: after each of them the pixels are marked
    /// that are black, so that most leaves of the later ones need only a look.
    fn leaves(&mut self, tree: &Tree, camera: &Camera, scale: Vec2) {
        let placer = Placer::new(camera, scale);
        // To look for them takes as long as to place the leaves, and each pass wants them.
        self.runs.clear();
        self.runs.extend(tree.leaves.chunk_by(outline::look_alike).map(<[Leaf]>::len));
        let count = tree.leaves.len() * LEAVES_TO_SWEEP;
        self.in_passes(count, |own, part| own.every_so_many_leaves(tree, &placer, part));
    }

    /// Draws shapes in several passes if `count` is more than there are pixels, and looks for black pixels between them.
    /// `draw` draws the shapes at a place and every so many from there on, and returns how many were drawn.
    fn in_passes(&mut self, count: usize, draw: impl Fn(&mut Self, (usize, usize)) -> usize) {
        let passes = if self.saturates && count > self.grid.area() { PASSES } else { 1 };
        for pass in 0..passes {
            if pass > 0 {
                self.occlusion.look(&mut self.grid, PIXELS_FOR_A_LEAF);
            }
            let drawn = draw(self, (pass, passes));
            self.occlusion.add(drawn);
        }
    }

    /// Draws the leaves at `first`, and every `step` from there on; returns how many were drawn. Those are not that
    /// lie where all is black: of pixels, or of samples while no black pixels are known.
    fn every_so_many_leaves(
        &mut self,
        tree: &Tree,
        placer: &Placer<'_>,
        (first, step): (usize, usize),
    ) -> usize {
        let pixels = placer.camera.pixels_per_meter() as f32;
        let row = 1.0 / placer.scale.y;
        let Self { grid, occlusion, outlines, runs, .. } = self;
        let mut corners = [[0.0; 2]; Outline::MAX_CORNERS];
        let mut drawn = 0;
        let mut rest = &tree.leaves[..];
        for &count in &*runs {
            let run;
            (run, rest) = rest.split_at(count);
            let leaf = &run[0];
            let size = [leaf.across.length() * pixels, leaf.along.length() * pixels];
            let Blade { outline, half_width, lowest, highest } = outlines.get(tree.outline_of(leaf), size);
            let corners = &mut corners[..outline.len()];
            for leaf in run.iter().skip(first).step_by(step) {
                let Some([at, across, along]) = placer.place(leaf) else { continue };
                // Most leaves of a dense crown lie before or behind others.
                let reach = |axis: usize| {
                    let (low, high) = (along[axis] * lowest, along[axis] * highest);
                    let side = across[axis].abs() * half_width;
                    (at[axis] + low.min(high) - side, at[axis] + low.max(high) + side)
                };
                let (top, bottom) = reach(1);
                if !Grid::has_row(top, bottom) {
                    continue;
                }
                let (left, right) = reach(0);
                if is_hidden(occlusion, grid, [left, right], [top, bottom], row) {
                    continue;
                }
                for (corner, p) in corners.iter_mut().zip(outline) {
                    *corner = [
                        at[0] + across[0] * p[0] + along[0] * p[1],
                        at[1] + across[1] * p[0] + along[1] * p[1],
                    ];
                }
                grid.fill(corners);
                drawn += 1;
            }
        }
        drawn
    }

    /// In passes, as leaves are.
    fn blossoms(&mut self, tree: &Tree, camera: &Camera, scale: Vec2) {
        let placer = Placer::new(camera, scale);
        // Leaves may have been drawn since black pixels were looked for.
        if self.saturates {
            self.occlusion.look(&mut self.grid, PIXELS_FOR_A_LEAF);
        }
        let count = tree.blossoms.len() * BLOSSOMS_TO_SWEEP;
        self.in_passes(count, |own, part| own.every_so_many_blossoms(tree, &placer, part));
    }

    /// As [`Self::every_so_many_leaves`], of blossoms.
    fn every_so_many_blossoms(
        &mut self,
        tree: &Tree,
        placer: &Placer<'_>,
        (first, step): (usize, usize),
    ) -> usize {
        let row = 1.0 / placer.scale.y;
        let Self { grid, occlusion, .. } = self;
        let mut corners = [[0.0; 2]; Outline::MAX_CORNERS];
        let mut drawn = 0;
        let mut last: Option<(u16, Cup)> = None;
        for blossom in tree.blossoms.iter().skip(first).step_by(step) {
            let Some([at, across, along]) = placer.place(blossom) else { continue };
            let normal = placer.normal(blossom);
            // Nearly all trees have blossoms of one shape.
            let (_, Cup { faces, middle, half }) = match last.take() {
                Some(cup) if cup.0 == blossom.shape => last.insert(cup),
                _ => {
                    let faces = tree.blossom_shapes[usize::from(blossom.shape)].faces();
                    last.insert((blossom.shape, Cup::new(faces)))
                }
            };
            let place = |[u, v, w]: [f32; 3], axis: usize| {
                at[axis] + across[axis] * u + along[axis] * v + normal[axis] * w
            };
            let reach = |axis: usize| {
                let center = place(*middle, axis);
                let far =
                    across[axis].abs() * half[0] + along[axis].abs() * half[1] + normal[axis].abs() * half[2];
                [center - far, center + far]
            };
            let [top, bottom] = reach(1);
            if !Grid::has_row(top, bottom) {
                continue;
            }
            let [left, right] = reach(0);
            if is_hidden(occlusion, grid, [left, right], [top, bottom], row) {
                continue;
            }
            for polygon in faces.petals {
                let corners = &mut corners[..polygon.len()];
                for (corner, &vertex) in corners.iter_mut().zip(*polygon) {
                    let point = faces.vertices[usize::from(vertex)];
                    *corner = [place(point, 0), place(point, 1)];
                }
                grid.fill(corners);
            }
            drawn += 1;
        }
        drawn
    }

    /// The sides of each blob that face the viewer: what is behind them has the same outline.
    fn blobs(&mut self, tree: &Tree, camera: &Camera, scale: Vec2) {
        let placer = Placer::new(camera, scale);
        for blob in &tree.blobs {
            let vertices = &tree.blob_vertices[blob.vertices()];
            for triangle in &tree.blob_triangles[blob.triangles()] {
                let [a, b, c] = triangle.map(|i| placer.point(vertices[i as usize]));
                let (Some(a), Some(b), Some(c)) = (a, b, c) else { continue };
                // Rows count downwards, so that what is counter-clockwise in the world is clockwise.
                let turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
                if turn < 0.0 {
                    self.grid.fill(&[a, b, c]);
                }
            }
        }
    }
}

/// Whether all of a box in samples, of which there are 1 / `row` down each pixel, is black: by pixels where these have been
/// looked for, and else by samples.
#[inline]
fn is_hidden(occlusion: &Occlusion, grid: &Grid, across: [f32; 2], down: [f32; 2], row: f32) -> bool {
    if occlusion.is_known() {
        return occlusion.hides(across, down, row);
    }
    grid.is_covered(across[0], across[1], down[0], down[1])
}

/// Passes of a dense crown, and its density: more than one leaf per this many pixels.
const PASSES: usize = 8;
const LEAVES_TO_SWEEP: usize = 16;
/// The same of blossoms, which take several polygons each.
const BLOSSOMS_TO_SWEEP: usize = 64;
/// Pieces of stems are hidden if there is more than one knot per this many pixels.
const KNOTS_TO_HIDE: usize = 16;
/// Black pixels are looked for after a pass, or after a stem, once there is a shape per this many pixels.
const PIXELS_FOR_A_LEAF: usize = 100;
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

/// The unit shape of a blossom and the box around it.
struct Cup {
    faces: &'static Faces,
    middle: [f32; 3],
    /// Half of its extents.
    half: [f32; 3],
}

impl Cup {
    fn new(faces: &'static Faces) -> Self {
        let along = |axis: usize| {
            let all = faces.vertices.iter().map(|vertex| vertex[axis]);
            all.fold([f32::MAX, f32::MIN], |[low, high], v| [low.min(v), high.max(v)])
        };
        let bounds = [along(0), along(1), along(2)];
        Self {
            faces,
            middle: bounds.map(|[low, high]| (low + high) / 2.0),
            half: bounds.map(|[low, high]| (high - low) / 2.0),
        }
    }
}

/// Takes the frames of leaves from the world to samples.
struct Placer<'a> {
    camera: &'a Camera,
    right: Vec3,
    down: Vec3,
    origin: Vec2,
    scale: Vec2,
    orthographic: bool,
}

impl<'a> Placer<'a> {
    fn new(camera: &'a Camera, scale: Vec2) -> Self {
        let (x, y) = camera.project(glam::DVec3::ZERO, 1.0);
        Self {
            camera,
            right: camera.right.as_vec3() * scale.x,
            down: camera.down.as_vec3() * scale.y,
            origin: Vec2::new(x as f32, y as f32) * scale,
            scale,
            orthographic: camera.is_orthographic(),
        }
    }

    /// Position and the two axes of a leaf in samples; `None` behind the camera. Under perspective a
    /// leaf is drawn at the magnification of its base.
    fn place(&self, leaf: &Leaf) -> Option<[Corner; 3]> {
        let (across, along) = (self.flat(leaf.across), self.flat(leaf.along));
        if self.orthographic {
            let at = self.flat(leaf.position);
            return Some([[at[0] + self.origin.x, at[1] + self.origin.y], across, along]);
        }
        let point = leaf.position.as_dvec3();
        let magnification = self.camera.magnification(point)?;
        let (x, y) = self.camera.project(point, magnification);
        let grown = |a: Corner| a.map(|v| v * magnification as f32);
        Some([[x as f32 * self.scale.x, y as f32 * self.scale.y], grown(across), grown(along)])
    }

    /// A point in samples; `None` behind the camera.
    fn point(&self, point: Vec3) -> Option<Corner> {
        if self.orthographic {
            let at = self.flat(point);
            return Some([at[0] + self.origin.x, at[1] + self.origin.y]);
        }
        let point = point.as_dvec3();
        let (x, y) = self.camera.project(point, self.camera.magnification(point)?);
        Some([x as f32 * self.scale.x, y as f32 * self.scale.y])
    }

    /// The third axis, which only blossoms have a use for.
    fn normal(&self, leaf: &Leaf) -> Corner {
        let magnification = self.camera.magnification(leaf.position.as_dvec3()).unwrap_or(1.0);
        self.flat(leaf.normal()).map(|v| v * magnification as f32)
    }

    fn flat(&self, v: Vec3) -> Corner {
        [v.dot(self.right), v.dot(self.down)]
    }
}
