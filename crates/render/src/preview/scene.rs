//! A meshed tree as shading wants it.

use super::crown::Crown;
use glam::Vec3;
use pleach_mesh::{
    Block, LeafStyle, Material, MeshError, MeshSettings, Mesher, Palette, Part, Sink, Vertex, send,
};
use pleach_tree::stats::Bounds;
use pleach_tree::{Parts, Tree};
use std::ops::Range;

/// All parts in one run of corners and triangles.
#[derive(Debug)]
pub(super) struct Scene {
    pub(super) palette: Palette,
    pub(super) vertices: Vec<Vertex>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// First triangle of each part, what it is, and how many triangles each of its leaves has.
    pub(super) parts: Vec<(u32, Material, u32)>,
    /// The triangles of closed surfaces of foliage.
    pub(super) blobs: Range<u32>,
    /// First corner of each stem, its radius at the base in metres, its level.
    pub(super) stems: Vec<(u32, f32, u16)>,
    pub(super) crown: Crown,
    pub(super) low: Vec3,
    pub(super) high: Vec3,
    /// Whether roots are drawn, whose ends are in the ground.
    pub(super) has_roots: bool,
    /// The middle of the leaves, and how far they reach on average.
    pub(super) heart: Vec3,
    pub(super) reach: f32,
}

impl Scene {
    pub(super) fn new(tree: &Tree, palette: &Palette, size: u32, parts: Parts) -> Self {
        let bounds = Bounds::new(tree, parts);
        let (low, high) = bounds.map_or((Vec3::ZERO, Vec3::ONE), |b| (b.min.as_vec3(), b.max.as_vec3()));
        let pixel = f64::from((high - low).max_element().max(1e-3)) / f64::from(size.max(1));
        let settings = MeshSettings {
            tolerance: (0.2 * pixel).clamp(2e-4, 0.02),
            min_sides: 5,
            leaves: leaf_style(tree, pixel),
            parts,
            ..MeshSettings::default()
        };
        let mesher = Mesher::new(tree, settings);
        let mut run = Run::default();
        // This sink never fails, and a tree without triangles is an empty picture.
        let _ = send(std::slice::from_ref(&mesher), &mut run);
        let mut scene = Self {
            palette: *palette,
            vertices: run.vertices,
            triangles: run.triangles,
            parts: Vec::new(),
            blobs: 0..0,
            stems: stems(tree, &mesher),
            crown: Crown::new(low, high, areas(tree)),
            low,
            high,
            has_roots: parts.contains(Parts::ROOTS),
            heart: (low + high) / 2.0,
            reach: 1.0,
        };
        for (part, first) in run.parts {
            let placed = if part.material == Material::Blossom { &tree.blossoms } else { &tree.leaves };
            // Blobs follow the leaves.
            let of_blobs = if part.material == Material::Leaf { tree.blob_triangles.len() } else { 0 };
            let of_leaves = part.count.triangles as usize - of_blobs;
            let each = of_leaves / placed.len().max(1);
            if of_blobs > 0 {
                let first = first + of_leaves as u32;
                scene.blobs = first..first + of_blobs as u32;
            }
            scene.parts.push((first, part.material, each.max(1) as u32));
        }
        if !tree.leaves.is_empty() {
            let n = tree.leaves.len() as f32;
            scene.heart = tree.leaves.iter().map(|l| l.position).sum::<Vec3>() / n;
            let distance = |l: &pleach_tree::Leaf| l.position.distance(scene.heart);
            scene.reach = (tree.leaves.iter().map(distance).sum::<f32>() / n).max(1e-3);
        }
        scene
    }

    /// Where a corner is.
    #[inline]
    pub(super) fn point(&self, corner: u32) -> Vec3 {
        self.vertices[corner as usize].position
    }

    /// Where all corners are.
    pub(super) fn points(&self) -> impl Iterator<Item = Vec3> + Clone {
        self.vertices.iter().map(|vertex| vertex.position)
    }

    /// Part of a triangle: what it is, and the number of its leaf.
    pub(super) fn part_of(&self, triangle: u32) -> (Material, u32) {
        let part = self.parts.partition_point(|p| p.0 <= triangle).max(1) - 1;
        let (first, material, each) = self.parts[part];
        (material, (triangle - first) / each)
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

fn leaf_style(tree: &Tree, pixel: f64) -> LeafStyle {
    let lengths = tree.leaves.iter().map(|leaf| f64::from(leaf.along.length()));
    let mean = lengths.sum::<f64>() / tree.leaves.len().max(1) as f64;
    if mean < SMALL * pixel { LeafStyle::Simple } else { LeafStyle::Outline }
}

/// The sink that puts all parts into one run.
#[derive(Debug, Default)]
struct Run {
    vertices: Vec<Vertex>,
    triangles: Vec<[u32; 3]>,
    /// Each with the number of its first triangle.
    parts: Vec<(Part, u32)>,
    /// The number of each part's first corner.
    first: Vec<u32>,
}

impl Sink for Run {
    fn begin(&mut self, parts: &[Part]) -> Result<(), MeshError> {
        let (mut vertices, mut triangles) = (0, 0);
        for part in parts {
            self.parts.push((*part, triangles as u32));
            self.first.push(vertices as u32);
            vertices += part.count.vertices;
            triangles += part.count.triangles;
        }
        self.vertices.reserve_exact(vertices as usize);
        self.triangles.reserve_exact(triangles as usize);
        Ok(())
    }

    fn block(&mut self, part: usize, block: &mut Block) -> Result<(), MeshError> {
        let first = self.first[part];
        self.vertices.append(&mut block.vertices);
        self.triangles.extend(block.triangles.drain(..).map(|corners| corners.map(|corner| corner + first)));
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
    let leaf = |l: &pleach_tree::Leaf, unit: f32| (l.position + l.along * 0.5, l.unit_area() * unit);
    let leaves = tree.leaves.iter().map(move |l| leaf(l, tree.outline_of(l).area()));
    let blossoms = tree.blossoms.iter().map(move |l| leaf(l, 1.5));
    let pieces = tree.stems.iter().flat_map(|stem| tree.knots_of(stem).windows(2)).map(|pair| {
        let length = pair[0].point.distance(pair[1].point);
        let middle = (pair[0].point + pair[1].point) / 2.0;
        (middle.as_vec3(), (length * (pair[0].radius + pair[1].radius)) as f32)
    });
    leaves.chain(blossoms).chain(pieces)
}
