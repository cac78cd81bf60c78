//! Leaves or blossoms of any mix of shapes, in runs.

use crate::atlas::{Atlas, Form};
use crate::block::{Block, Placement, Vertex};
use crate::foliage::UnitMesh;
use crate::part::Count;
use glam::{Mat3, Quat, Vec2, Vec3, vec2, vec3};
use pleach_plant::Leaf;
use std::ops::Range;

/// All leaves, or all blossoms, of a tree with the meshes of their unit shapes.
#[derive(Debug)]
pub(crate) struct Placed<'a> {
    pub(crate) leaves: &'a [Leaf],
    shapes: Shapes,
    /// Where normals lean away from, if they do.
    heart: Option<Vec3>,
    pub(crate) count: Count,
    runs: Vec<Run>,
}

/// The meshes of unit shapes, each in several forms if there is an atlas.
#[derive(Clone, Debug)]
pub(crate) struct Shapes {
    meshes: Vec<UnitMesh>,
    atlas: Option<Atlas>,
}

impl Shapes {
    /// One mesh for each shape.
    pub(crate) const fn plain(meshes: Vec<UnitMesh>) -> Self {
        Self { meshes, atlas: None }
    }

    /// The meshes of so many shapes in the forms of an atlas; `mesh` makes one of them, for a whole picture.
    pub(crate) fn in_forms(shapes: usize, mesh: impl Fn(usize, Form) -> UnitMesh) -> Self {
        let atlas = Atlas::new(shapes);
        let each = |shape: usize| {
            let mesh = &mesh;
            (0..atlas.forms).map(move |form| {
                mesh(shape, Form::new(form)).in_cell(atlas.sheet.cell(atlas.cell(shape, form)))
            })
        };
        Self { meshes: (0..shapes).flat_map(each).collect(), atlas: Some(atlas) }
    }

    fn get(&self, leaf: &Leaf) -> &UnitMesh {
        let shape = usize::from(leaf.shape);
        &self.meshes[self.atlas.map_or(shape, |atlas| atlas.cell(shape, atlas.form_of(leaf)))]
    }

    /// The middle of some picture of a leaf.
    pub(crate) fn somewhere(&self) -> Vec2 {
        let cell = self.atlas.map_or([0.0, 0.0, 1.0, 1.0], |atlas| atlas.sheet.cell(0));
        vec2(cell[0] + cell[2], cell[1] + cell[3]) / 2.0
    }
}

/// How much of a normal is its leaf's own, against the direction away from the crown's heart.
const OWN: f32 = 1.0;

/// A run of leaves, and the vertices before it.
#[derive(Clone, Debug)]
struct Run {
    leaves: Range<usize>,
    first_vertex: u64,
}

impl<'a> Placed<'a> {
    /// Cuts `leaves`, whose shapes are numbers of `shapes`, into runs of at most `run_vertices`.
    pub(crate) fn new(leaves: &'a [Leaf], shapes: Shapes, run_vertices: u64) -> Self {
        let (mut count, mut runs) = (Count::default(), Vec::<Run>::new());
        for (i, leaf) in leaves.iter().enumerate() {
            let size = shapes.get(leaf).count();
            match runs.last_mut() {
                Some(run) if count.vertices + size.vertices - run.first_vertex <= run_vertices => {
                    run.leaves.end = i + 1;
                }
                _ => runs.push(Run { leaves: i..i + 1, first_vertex: count.vertices }),
            }
            count += size;
        }
        Self { leaves, shapes, heart: None, count, runs }
    }

    /// The same with normals that lean away from `heart`.
    pub(crate) fn rounded(mut self, heart: Option<Vec3>) -> Self {
        self.heart = heart;
        self
    }

    /// The runs in order.
    pub(crate) fn ranges(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        self.runs.iter().map(|run| run.leaves.clone())
    }

    /// The one shape of all leaves, if there is but one: what instances need. In its first form.
    pub(crate) fn only_shape(&self) -> Option<&UnitMesh> {
        let forms = self.shapes.atlas.map_or(1, |atlas| atlas.forms);
        self.shapes.meshes.first().filter(|_| self.shapes.meshes.len() == forms)
    }

    /// The middle of some picture of a leaf.
    pub(crate) fn somewhere(&self) -> Vec2 {
        self.shapes.somewhere()
    }

    /// Appends the leaves of `range`, one of the runs, to `block`; calls `placed` after each one with
    /// its number.
    pub(crate) fn fill(
        &self,
        range: Range<usize>,
        block: &mut Block,
        mut placed: impl FnMut(usize, &mut Block),
    ) {
        let run = self.runs.partition_point(|run| run.leaves.start < range.start);
        let mut base = self.runs[run].first_vertex;
        for i in range {
            let leaf = &self.leaves[i];
            let shape = self.shapes.get(leaf);
            let first = block.vertices.len();
            shape.push(leaf, base as u32, block);
            base += shape.count().vertices;
            if let Some(heart) = self.heart {
                block.vertices[first..].iter_mut().for_each(|vertex| round(vertex, heart));
            }
            placed(i, block);
        }
    }
}

/// Leans a normal away from `heart`. Programs turn the normals of a face that is seen from behind: one that looks
/// inwards leans inwards, so that turned it leans outwards.
fn round(vertex: &mut Vertex, heart: Vec3) {
    let outwards = (vertex.position - heart).normalize_or_zero();
    let side = if vertex.normal.dot(outwards) < 0.0 { -1.0 } else { 1.0 };
    let leant = vertex.normal * OWN + outwards * side;
    vertex.normal = leant.try_normalize().unwrap_or(vertex.normal);
}

/// Where leaves and blossoms lean away from: the middle of what they take, but low in it, so that a crown is lit from
/// above as a body. `None` if there are none.
pub(crate) fn heart<'l>(leaves: impl Iterator<Item = &'l Leaf>) -> Option<Vec3> {
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for leaf in leaves {
        let middle = leaf.position + leaf.along / 2.0;
        (low, high) = (low.min(middle), high.max(middle));
    }
    low.is_finite().then(|| (low + high) / 2.0 - Vec3::Z * (0.25 * (high.z - low.z)))
}

/// Where the unit shape stands as it is.
pub(crate) const UNIT: Leaf =
    Leaf { position: Vec3::ZERO, along: Vec3::Y, across: Vec3::X, stem: 0, shape: 0 };

/// Translation, rotation and scale that carry the unit shape to `leaf`.
pub(crate) fn placement(leaf: &Leaf) -> Placement {
    let (width, length) = (leaf.across.length(), leaf.along.length());
    let x = leaf.across.try_normalize().unwrap_or(Vec3::X);
    let y = (leaf.along - x * leaf.along.dot(x)).try_normalize().unwrap_or(Vec3::Y);
    let rotation = Quat::from_mat3(&Mat3::from_cols(x, y, x.cross(y)));
    Placement { translation: leaf.position, rotation, scale: vec3(width, length, length) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::LeafStyle;
    use pleach_plant::leaf_shape::LeafShape;

    #[test]
    fn runs_hold_every_leaf_once_whatever_its_shape() {
        let shapes = [LeafShape::Maple, LeafShape::Triangle];
        let meshes = |n: usize| {
            Shapes::plain(
                shapes[..n].iter().map(|s| UnitMesh::leaf(s.outline(), LeafStyle::Outline)).collect(),
            )
        };
        let leaves: Vec<Leaf> = (0..50).map(|i| Leaf { shape: u16::from(i % 3 == 0), ..UNIT }).collect();
        let placed = Placed::new(&leaves, meshes(2), 100);
        assert!(placed.only_shape().is_none() && placed.runs.len() > 5);
        let (mut vertices, mut triangles, mut seen) = (0, Vec::new(), Vec::new());
        for range in placed.ranges() {
            let mut block = Block::default();
            placed.fill(range, &mut block, |i, _| seen.push(i));
            assert!(block.vertices.len() <= 100);
            let own = vertices as u32..(vertices + block.vertices.len()) as u32;
            assert!(block.triangles.iter().flatten().all(|i| own.contains(i)));
            vertices += block.vertices.len();
            triangles.append(&mut block.triangles);
        }
        assert_eq!(seen, (0..50).collect::<Vec<_>>());
        let counted = Count { vertices: vertices as u64, triangles: triangles.len() as u64 };
        assert_eq!(placed.count, counted);
        assert!(Placed::new(&leaves[1..2], meshes(1), 100).only_shape().is_some());
    }
}
