//! Leaves or blossoms of any mix of shapes, in runs.

use crate::block::{Block, Placement};
use crate::foliage::UnitMesh;
use crate::part::Count;
use glam::{Mat3, Quat, Vec3, vec3};
use pleach_plant::Leaf;
use std::ops::Range;

/// All leaves, or all blossoms, of a tree with the meshes of their unit shapes.
#[derive(Debug)]
pub(crate) struct Placed<'a> {
    pub(crate) leaves: &'a [Leaf],
    shapes: Vec<UnitMesh>,
    pub(crate) count: Count,
    runs: Vec<Run>,
}

/// A run of leaves, and the vertices before it.
#[derive(Clone, Debug)]
struct Run {
    leaves: Range<usize>,
    first_vertex: u64,
}

impl<'a> Placed<'a> {
    /// Cuts `leaves`, whose shapes are numbers of `shapes`, into runs of at most `run_vertices`.
    pub(crate) fn new(leaves: &'a [Leaf], shapes: Vec<UnitMesh>, run_vertices: u64) -> Self {
        let (mut count, mut runs) = (Count::default(), Vec::<Run>::new());
        for (i, leaf) in leaves.iter().enumerate() {
            let size = shapes[usize::from(leaf.shape)].count();
            match runs.last_mut() {
                Some(run) if count.vertices + size.vertices - run.first_vertex <= run_vertices => {
                    run.leaves.end = i + 1;
                }
                _ => runs.push(Run { leaves: i..i + 1, first_vertex: count.vertices }),
            }
            count += size;
        }
        Self { leaves, shapes, count, runs }
    }

    /// The runs in order.
    pub(crate) fn ranges(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        self.runs.iter().map(|run| run.leaves.clone())
    }

    /// The one shape of all leaves, if there is but one: what instances need.
    pub(crate) fn only_shape(&self) -> Option<&UnitMesh> {
        if let [shape] = &self.shapes[..] { Some(shape) } else { None }
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
            let shape = &self.shapes[usize::from(leaf.shape)];
            shape.push(leaf, base as u32, block);
            base += shape.count().vertices;
            placed(i, block);
        }
    }
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
        let meshes = || shapes.map(|s| UnitMesh::leaf(s.outline(), LeafStyle::Outline)).to_vec();
        let leaves: Vec<Leaf> = (0..50).map(|i| Leaf { shape: u16::from(i % 3 == 0), ..UNIT }).collect();
        let placed = Placed::new(&leaves, meshes(), 100);
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
        assert!(Placed::new(&leaves[1..2], meshes()[..1].to_vec(), 100).only_shape().is_some());
    }
}
