//! The tree as flat arrays: stems, their knots, leaves, blossoms and blobs.

mod blob;
mod check;
mod data;
mod digest;
mod leaf;
mod parts;
mod place;
mod stem;

pub use blob::Blob;
pub use check::MalformedTree;
pub use leaf::Leaf;
pub use parts::{Foliage, Parts};
pub use stem::{Stem, StemKind};

use crate::individual::{StemPath, Step};
use crate::leaf_shape::{BlossomShape, Outline};
use crate::spline::Cubic;
use glam::{DVec3, Vec3};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// One knot of a stem's spline. Neighbouring knots bound a cubic Bézier piece.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Knot {
    /// The point itself, in metres.
    pub point: DVec3,
    /// Handle of the piece that arrives here (an absolute point, in metres).
    pub handle_in: DVec3,
    /// Handle of the piece that leaves here (an absolute point, in metres).
    pub handle_out: DVec3,
    /// Radius of the stem here, in metres. Linear in the curve parameter between knots.
    pub radius: f64,
}

/// A whole plant. Metres, z up, right-handed; the ground is z = 0.
///
/// Flat arrays that [`Tree::clear`] empties and keeps, so that growing the next tree into the same
/// value allocates nothing once the arrays are large enough.
///
/// It is read from and written to JSON and the like; what is read is checked as by [`Tree::well_formed`].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "data::TreeData", into = "data::TreeData")]
pub struct Tree {
    /// Stems, parents before children.
    pub stems: Vec<Stem>,
    /// Knots of all stems, each stem's in one run.
    pub knots: Vec<Knot>,
    /// Leaves, in any order.
    pub leaves: Vec<Leaf>,
    /// Blossoms, in any order.
    pub blossoms: Vec<Leaf>,
    /// The unit shapes that leaves name by number.
    pub leaf_shapes: Vec<Arc<Outline>>,
    /// The unit shapes that blossoms name by number.
    pub blossom_shapes: Vec<BlossomShape>,
    /// Foliage as closed surfaces.
    pub blobs: Vec<Blob>,
    /// Vertices of all blobs in metres, each blob's in one run.
    pub blob_vertices: Vec<Vec3>,
    /// Triangles of all blobs, each blob's in one run.
    pub blob_triangles: Vec<[u32; 3]>,
}

/// Arrays of fewer bytes are never too large.
const SPARE: usize = 1 << 20;

/// Halves the room of a large array of which less than a quarter is used, as often as that is so.
fn release_spare<T>(array: &mut Vec<T>) {
    let mut room = array.capacity();
    while room / 4 > array.len() && room * size_of::<T>() > SPARE {
        room /= 2;
    }
    array.shrink_to(room);
}

impl Tree {
    /// Removes every part and keeps the memory.
    pub fn clear(&mut self) {
        self.stems.clear();
        self.knots.clear();
        self.leaves.clear();
        self.blossoms.clear();
        self.leaf_shapes.clear();
        self.blossom_shapes.clear();
        self.blobs.clear();
        self.blob_vertices.clear();
        self.blob_triangles.clear();
    }

    /// Gives back memory that holds nothing.
    pub fn shrink_to_fit(&mut self) {
        self.stems.shrink_to_fit();
        self.knots.shrink_to_fit();
        self.leaves.shrink_to_fit();
        self.blossoms.shrink_to_fit();
        self.blobs.shrink_to_fit();
        self.blob_vertices.shrink_to_fit();
        self.blob_triangles.shrink_to_fit();
    }

    /// Gives back memory of large arrays that are nearly empty, for trees that are grown one after the other into the
    /// same value: a single one that is ten times as large as the others would keep its memory for all of them.
    pub fn release_spare(&mut self) {
        release_spare(&mut self.stems);
        release_spare(&mut self.knots);
        release_spare(&mut self.leaves);
        release_spare(&mut self.blossoms);
        release_spare(&mut self.blobs);
        release_spare(&mut self.blob_vertices);
        release_spare(&mut self.blob_triangles);
    }

    /// Makes room for all of `others`, to be appended, and for nothing else.
    pub fn reserve_for(&mut self, others: &[Self]) {
        let sum = |len: fn(&Self) -> usize| others.iter().map(len).sum();
        self.stems.reserve_exact(sum(|t| t.stems.len()));
        self.knots.reserve_exact(sum(|t| t.knots.len()));
        self.leaves.reserve_exact(sum(|t| t.leaves.len()));
        self.blossoms.reserve_exact(sum(|t| t.blossoms.len()));
        self.blobs.reserve_exact(sum(|t| t.blobs.len()));
        self.blob_vertices.reserve_exact(sum(|t| t.blob_vertices.len()));
        self.blob_triangles.reserve_exact(sum(|t| t.blob_triangles.len()));
    }

    /// The knots of `stem`.
    #[must_use]
    pub fn knots_of(&self, stem: &Stem) -> &[Knot] {
        &self.knots[stem.knots()]
    }

    /// The Bézier pieces of `stem` from base to tip, each with the radii at its two ends.
    pub fn pieces_of(&self, stem: &Stem) -> impl Iterator<Item = (Cubic, f64, f64)> + '_ {
        self.knots_of(stem).windows(2).map(|w| (piece(&w[0], &w[1]), w[0].radius, w[1].radius))
    }

    /// Length of the spline of `stem` in metres, to 0.3 %.
    #[must_use]
    pub fn length_of(&self, stem: &Stem) -> f64 {
        /// Chords per piece: pieces turn by well under a radian.
        const CHORDS: u32 = 8;
        self.pieces_of(stem).map(|(piece, ..)| piece.length(CHORDS)).sum()
    }

    /// The deepest level present plus one.
    #[must_use]
    pub fn level_count(&self) -> usize {
        self.stems.iter().map(|s| usize::from(s.level) + 1).max().unwrap_or(0)
    }

    /// Where stem number `index` is, from the ground up: another path for each stem where stems have addresses.
    #[must_use]
    pub fn path_of(&self, index: usize) -> StemPath {
        let stem = &self.stems[index];
        let step =
            if stem.kind == StemKind::Fork { Step::Fork(stem.number) } else { Step::Child(stem.number) };
        stem.parent
            .map_or_else(|| StemPath::trunk(stem.number), |parent| self.path_of(parent as usize).then(step))
    }

    /// The unit shape of `leaf`, which is one of [`Tree::leaves`].
    #[must_use]
    pub fn outline_of(&self, leaf: &Leaf) -> &Outline {
        &self.leaf_shapes[usize::from(leaf.shape)]
    }

    /// Appends `other`, whose indices are its own, except for the parents of those stems for which
    /// `rooted_here` holds: these are indices in `self` already. Shapes of leaves and blossoms are
    /// numbers in the tables of `self`, which `other` therefore need not have.
    pub fn append(&mut self, other: &Self, rooted_here: impl Fn(&Stem) -> bool) {
        let stem_base = self.stems.len() as u32;
        let knot_base = self.knots.len() as u32;
        self.stems.extend(other.stems.iter().map(|stem| Stem {
            parent: stem.parent.map(|p| if rooted_here(stem) { p } else { p + stem_base }),
            first_knot: stem.first_knot + knot_base,
            ..*stem
        }));
        self.knots.extend_from_slice(&other.knots);
        let moved = |leaf: &Leaf| Leaf { stem: leaf.stem + stem_base, ..*leaf };
        self.leaves.extend(other.leaves.iter().map(moved));
        self.blossoms.extend(other.blossoms.iter().map(moved));
        let (vertex_base, triangle_base) =
            (self.blob_vertices.len() as u32, self.blob_triangles.len() as u32);
        self.blobs.extend(other.blobs.iter().map(|blob| Blob {
            stem: blob.stem + stem_base,
            first_vertex: blob.first_vertex + vertex_base,
            first_triangle: blob.first_triangle + triangle_base,
            ..*blob
        }));
        self.blob_vertices.extend_from_slice(&other.blob_vertices);
        self.blob_triangles.extend_from_slice(&other.blob_triangles);
    }
}

/// The Bézier piece between two neighbouring knots.
#[must_use]
pub fn piece(from: &Knot, to: &Knot) -> Cubic {
    Cubic::new(from.point, from.handle_out, to.handle_in, to.point)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::leaf_shape::LeafShape;
    use glam::{dvec3, vec3};

    fn pole(level: u16, parent: Option<u32>, first_knot: u32) -> Stem {
        let kind = if parent.is_some() { StemKind::Branch } else { StemKind::Trunk };
        Stem { parent, level, kind, number: 0, offset: 0.0, first_knot, knot_count: 2 }
    }

    fn knot(z: f64) -> Knot {
        let point = dvec3(0.0, 0.0, z);
        Knot { point, handle_in: point, handle_out: point, radius: 0.1 }
    }

    #[test]
    fn spare_room_is_given_back_where_there_is_much_of_it() {
        let mut tree = small();
        let same = tree.clone();
        tree.leaves.reserve_exact(400_000);
        tree.knots.reserve_exact(1000);
        tree.release_spare();
        assert!(tree == same && tree.knots.capacity() >= 1000);
        assert!(tree.leaves.capacity() * size_of::<Leaf>() <= SPARE);
        // What is used in part stays.
        tree.leaves = vec![tree.leaves[0]; 100_000];
        tree.leaves.reserve_exact(200_000);
        tree.release_spare();
        assert!(tree.leaves.capacity() >= 300_000);
    }

    fn small() -> Tree {
        let (along, across) = (vec3(0.0, 0.0, 2.0), Vec3::X);
        let leaf = Leaf { position: Vec3::ZERO, along, across, stem: 0, shape: 0 };
        Tree {
            stems: vec![pole(0, None, 0), pole(1, Some(0), 2)],
            knots: (0..4).map(|i| knot(f64::from(i))).collect(),
            leaves: vec![leaf],
            leaf_shapes: vec![Arc::clone(LeafShape::Ovate.outline())],
            blobs: vec![Blob {
                stem: 1,
                first_vertex: 0,
                vertex_count: 4,
                first_triangle: 0,
                triangle_count: 4,
            }],
            blob_vertices: vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z],
            blob_triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
            ..Tree::default()
        }
    }

    #[test]
    fn appending_moves_every_index() {
        let mut tree = small();
        let mut branches = small();
        branches.stems = vec![pole(1, Some(0), 0), pole(2, Some(0), 2)];
        branches.leaves[0].stem = 1;
        tree.append(&branches, |stem| stem.level == 1);
        assert_eq!(tree.stems.len(), 4);
        assert_eq!((tree.stems[2].parent, tree.stems[2].first_knot), (Some(0), 4));
        assert_eq!((tree.stems[3].parent, tree.stems[3].first_knot), (Some(2), 6));
        assert_eq!(tree.leaves[1].stem, 3);
        assert_eq!((tree.blobs[1].stem, tree.blobs[1].first_vertex, tree.blobs[1].first_triangle), (3, 4, 4));
        tree.well_formed().unwrap();
    }

    #[test]
    fn broken_promises_are_named() {
        let breaks: [(&str, fn(&mut Tree)); 9] = [
            ("two knots", |t| t.stems[1].knot_count = 1),
            ("before its parent", |t| t.stems[1].parent = Some(1)),
            ("one level below", |t| t.stems[1].level = 2),
            ("not finite", |t| t.knots[3].point.x = f64::NAN),
            ("does not exist", |t| t.leaves[0].stem = 9),
            ("a shape that does not exist", |t| t.leaves[0].shape = 1),
            ("beyond the arrays", |t| t.blobs[0].first_vertex = 1),
            ("a vertex that does not exist", |t| t.blob_triangles[3][0] = 4),
            ("closed surface", |t| t.blob_triangles[3] = [0, 2, 3]),
        ];
        small().well_formed().unwrap();
        for (what, damage) in breaks {
            let mut tree = small();
            damage(&mut tree);
            let message = tree.well_formed().unwrap_err().to_string();
            assert!(message.contains(what), "{message}");
        }
    }

    #[test]
    fn a_leaf_measures_itself() {
        let leaf = small().leaves[0];
        assert_eq!(leaf.unit_area(), 2.0);
        assert_eq!(leaf.normal(), vec3(0.0, -2.0, 0.0));
    }
}
