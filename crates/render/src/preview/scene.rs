//! A meshed tree, prepared for shading.

use super::crown::Crown;
use super::foliage::Foliage;
use super::raster::DepthBuffer;
use glam::Vec3;
use pleach_mesh::palette::linear;
use pleach_mesh::{
    Block, Count, LeafStyle, Material, MeshError, MeshSettings, Mesher, Palette, Part, Sink, Source as _,
    Vertex, blobs_have_tiles, send,
};
use pleach_plant::Bounds;
use pleach_plant::{Parts, Tree};
use std::ops::Range;
use std::sync::Arc;

/// The palette as intensities of light.
#[derive(Clone, Copy, Debug)]
pub(super) struct Colors {
    pub(super) bark: Vec3,
    pub(super) leaf: Vec3,
}

impl Colors {
    fn new(palette: &Palette) -> Self {
        let [bark, leaf] = [palette.bark, palette.leaf].map(linear).map(Vec3::from);
        Self { bark, leaf }
    }
}

/// A tree about to be looked at. Its triangles are made again for each pass over them, block by block: all of them
/// would take several times as much memory as the tree.
#[derive(Debug)]
pub(super) struct Scene<'a> {
    pub(super) palette: Palette,
    pub(super) colors: Colors,
    mesher: Mesher<'a>,
    /// What leaves and blossoms show.
    pub(super) foliage: Arc<Foliage>,
    /// First triangle of each part, and what it is.
    parts: Vec<(u32, Material)>,
    /// The triangles of closed surfaces of foliage.
    pub(super) blobs: Range<u32>,
    /// Whether blobs show foliage, and not one colour.
    pub(super) has_tiles: bool,
    /// First corner of each stem, its radius at the base in metres, its level.
    stems: Vec<(u32, f32, u16)>,
    pub(super) crown: Crown,
    pub(super) low: Vec3,
    pub(super) high: Vec3,
    /// Whether roots are drawn, whose ends are in the ground.
    pub(super) has_roots: bool,
    /// The middle of the leaves, and how far they reach on average.
    pub(super) heart: Vec3,
    pub(super) reach: f32,
}

/// How a scene is prepared.
#[derive(Debug)]
pub(super) struct Wanted {
    /// Height of its pictures in pixels, about.
    pub(super) size: u32,
    /// What of the tree is drawn.
    pub(super) parts: Parts,
    /// Cells in which its light is reckoned, along the longest side.
    pub(super) cells: u32,
    /// Its leaves; they are painted here if they are not given.
    pub(super) foliage: Option<Arc<Foliage>>,
}

impl Default for Wanted {
    fn default() -> Self {
        Self { size: 256, parts: Parts::LEAFY, cells: 10, foliage: None }
    }
}

impl<'a> Scene<'a> {
    /// Prepares `tree` for pictures.
    pub(super) fn new(tree: &'a Tree, palette: &Palette, wanted: Wanted) -> Self {
        let Wanted { size, parts, cells, foliage } = wanted;
        let bounds = Bounds::new(tree, parts);
        let (low, high) = bounds.map_or((Vec3::ZERO, Vec3::ONE), |b| (b.min.as_vec3(), b.max.as_vec3()));
        let pixel = f64::from((high - low).max_element().max(1e-3)) / f64::from(size.max(1));
        let settings = MeshSettings {
            tolerance: (0.2 * pixel).clamp(2e-4, 0.02),
            min_sides: 5,
            leaves: leaf_style(tree, pixel),
            // Far fewer than leaves, and the brightest part: a square would be recognised.
            blossoms: Some(LeafStyle::Outline),
            pictured: true,
            // Shading rounds a crown by itself.
            rounded: false,
            parts,
            ..MeshSettings::default()
        };
        let mesher = Mesher::new(tree, settings);
        let paint = || Arc::new(Foliage::new(tree, palette, (mean_length(tree) / pixel) as f32));
        let mut scene = Self {
            palette: *palette,
            colors: Colors::new(palette),
            foliage: foliage.unwrap_or_else(paint),
            parts: Vec::new(),
            blobs: 0..0,
            has_tiles: blobs_have_tiles(tree),
            stems: stems(tree, &mesher),
            crown: Crown::new(low, high, cells, areas(tree)),
            low,
            high,
            has_roots: parts.contains(Parts::ROOTS),
            heart: (low + high) / 2.0,
            reach: 1.0,
            mesher,
        };
        let mut first = 0;
        for part in scene.mesher.parts(0) {
            // Blobs follow the leaves.
            let of_blobs = if part.material == Material::Leaf { tree.blob_triangles.len() as u32 } else { 0 };
            let end = first + part.count.triangles as u32;
            if of_blobs > 0 {
                scene.blobs = end - of_blobs..end;
            }
            scene.parts.push((first, part.material));
            first = end;
        }
        if !tree.leaves.is_empty() {
            let n = tree.leaves.len() as f32;
            scene.heart = tree.leaves.iter().map(|l| l.position).sum::<Vec3>() / n;
            let distance = |l: &pleach_plant::Leaf| l.position.distance(scene.heart);
            scene.reach = (tree.leaves.iter().map(distance).sum::<f32>() / n).max(1e-3);
        }
        scene
    }

    /// Meshes the tree and shows it to `see`, block by block.
    pub(super) fn each_block(&self, see: impl FnMut(Shown<'_>)) {
        let mut pass = Pass { see, parts: Vec::new(), corners: 0, triangles: 0 };
        // This sink never fails, and a tree without triangles is an empty picture.
        let _ = send(std::slice::from_ref(&self.mesher), &mut pass);
    }

    /// Shows all corners to `see`, in their order.
    pub(super) fn each_point(&self, mut see: impl FnMut(Vec3)) {
        self.each_block(|block| block.vertices.iter().for_each(|vertex| see(vertex.position)));
    }

    /// Draws all triangles into a buffer of so many samples; `place` says where in it a point is.
    pub(super) fn draw(&self, width: u32, height: u32, place: impl Fn(Vec3) -> Vec3) -> DepthBuffer {
        let mut buffer = DepthBuffer::new(width, height);
        let mut corners = Vec::new();
        self.each_block(|block| {
            corners.clear();
            corners.extend(block.vertices.iter().map(|vertex| place(vertex.position)));
            buffer.draw(&corners, block.triangles, block.first_triangle);
        });
        buffer
    }

    /// How many corners and triangles there are.
    pub(super) fn count(&self) -> Count {
        self.mesher.count()
    }

    /// What a triangle is a part of.
    pub(super) fn material_of(&self, triangle: u32) -> Material {
        let part = self.parts.partition_point(|p| p.0 <= triangle).max(1) - 1;
        self.parts[part].1
    }

    /// Radius in metres and level of the stem with this corner.
    pub(super) fn stem_of(&self, vertex: u32) -> (f32, u16) {
        let stem = self.stems.partition_point(|s| s.0 <= vertex).max(1) - 1;
        (self.stems[stem].1, self.stems[stem].2)
    }
}

/// Leaves shorter than this, in pixels, are drawn as two triangles of their area: nobody sees their shape, and a
/// crown of them takes a third of the memory.
const SMALL: f64 = 6.0;

/// Mean length of leaves, or of blossoms where there are none, in metres.
fn mean_length(tree: &Tree) -> f64 {
    let leaves = if tree.leaves.is_empty() { &tree.blossoms } else { &tree.leaves };
    let lengths = leaves.iter().map(|leaf| f64::from(leaf.along.length()));
    lengths.sum::<f64>() / leaves.len().max(1) as f64
}

fn leaf_style(tree: &Tree, pixel: f64) -> LeafStyle {
    if mean_length(tree) < SMALL * pixel { LeafStyle::Simple } else { LeafStyle::Outline }
}

/// Part of a scene's triangles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shown<'a> {
    pub(super) vertices: &'a [Vertex],
    /// By their corners' places in `vertices`.
    pub(super) triangles: &'a [[u32; 3]],
    /// Number in the whole scene of the first of `vertices`.
    pub(super) first_corner: u32,
    /// Number in the whole scene of the first of `triangles`.
    pub(super) first_triangle: u32,
}

/// The sink that shows what comes and keeps nothing.
struct Pass<F> {
    see: F,
    /// The number of each part's first corner.
    parts: Vec<u32>,
    /// What has come.
    corners: u32,
    triangles: u32,
}

impl<F: FnMut(Shown<'_>)> Sink for Pass<F> {
    fn begin(&mut self, parts: &[Part]) -> Result<(), MeshError> {
        let mut corners = 0;
        for part in parts {
            self.parts.push(corners);
            corners += part.count.vertices as u32;
        }
        Ok(())
    }

    fn block(&mut self, part: usize, block: &mut Block) -> Result<(), MeshError> {
        let before = self.corners - self.parts[part];
        block.triangles.iter_mut().flatten().for_each(|corner| *corner -= before);
        (self.see)(Shown {
            vertices: &block.vertices,
            triangles: &block.triangles,
            first_corner: self.corners,
            first_triangle: self.triangles,
        });
        self.corners += block.vertices.len() as u32;
        self.triangles += block.triangles.len() as u32;
        Ok(())
    }

    fn end(&mut self) -> Result<(), MeshError> {
        Ok(())
    }
}

fn stems(tree: &Tree, mesher: &Mesher<'_>) -> Vec<(u32, f32, u16)> {
    let radius = |i: usize| tree.knots_of(&tree.stems[i])[0].radius as f32;
    (0..tree.stems.len()).map(|i| (mesher.first_vertex(i) as u32, radius(i), tree.stems[i].level)).collect()
}

/// Where area hangs: leaves and blossoms at their middles, stems along their knots.
fn areas(tree: &Tree) -> impl Iterator<Item = (Vec3, f32)> {
    let leaf = |l: &pleach_plant::Leaf, unit: f32| (l.position + l.along * 0.5, l.unit_area() * unit);
    let leaves = tree.leaves.iter().map(move |l| leaf(l, tree.outline_of(l).area()));
    let blossoms = tree.blossoms.iter().map(move |l| leaf(l, 1.5));
    let pieces = tree.stems.iter().flat_map(|stem| tree.knots_of(stem).windows(2)).map(|pair| {
        let length = pair[0].point.distance(pair[1].point);
        let middle = (pair[0].point + pair[1].point) / 2.0;
        (middle.as_vec3(), (length * (pair[0].radius + pair[1].radius)) as f32)
    });
    leaves.chain(blossoms).chain(pieces)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Leaves of two triangles are for crowns that are seen from afar; blossoms keep their petals there.
    #[test]
    fn blossoms_have_their_petals_however_small_the_picture() {
        let species = pleach_generators::preset("hill_cherry").unwrap();
        let tree = species.grow(1).unwrap();
        assert!(!tree.blossoms.is_empty());
        let triangles = |mesher: &Mesher<'_>, material: Material| {
            let part = mesher.parts(0).into_iter().find(|part| part.material == material);
            part.map_or(0, |part| part.count.triangles)
        };
        let mesh = Mesher::new(&tree, MeshSettings::default());
        for size in [64, 512] {
            let wanted = Wanted { size, ..Wanted::default() };
            let scene = Scene::new(&tree, &Palette::new(&species.appearance, None), wanted);
            assert_eq!(
                triangles(&scene.mesher, Material::Blossom),
                triangles(&mesh, Material::Blossom),
                "{size}"
            );
            assert_eq!(triangles(&scene.mesher, Material::Leaf), 2 * tree.leaves.len() as u64, "{size}");
        }
    }
}
