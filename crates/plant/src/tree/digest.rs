//! A tree in one number.

use super::{Leaf, StemKind, Tree};
use crate::fnv::Fnv;

impl Tree {
    /// A hash of all bits of stems, knots, leaves, blossoms and blobs, equal for equal trees.
    #[must_use]
    pub fn digest(&self) -> u64 {
        let mut hash = Fnv::default();
        for stem in &self.stems {
            let kind = match stem.kind {
                StemKind::Trunk => 0,
                StemKind::Branch => 1,
                StemKind::Fork => 2,
                StemKind::Root => 3,
            };
            hash =
                hash.with(&[kind]).with(&stem.level.to_le_bytes()).with(&stem.offset.to_bits().to_le_bytes());
            for number in [stem.parent.unwrap_or(u32::MAX), stem.number, stem.first_knot, stem.knot_count] {
                hash = hash.with(&number.to_le_bytes());
            }
        }
        for knot in &self.knots {
            for point in [knot.point, knot.handle_in, knot.handle_out] {
                hash = point.to_array().iter().fold(hash, |hash, v| hash.with(&v.to_bits().to_le_bytes()));
            }
            hash = hash.with(&knot.radius.to_bits().to_le_bytes());
        }
        for Leaf { position, along, across, stem, shape } in self.leaves.iter().chain(&self.blossoms) {
            for v in [position, along, across].iter().flat_map(|vector| vector.to_array()) {
                hash = hash.with(&v.to_bits().to_le_bytes());
            }
            hash = hash.with(&stem.to_le_bytes()).with(&shape.to_le_bytes());
        }
        for vertex in &self.blob_vertices {
            hash = vertex.to_array().iter().fold(hash, |hash, v| hash.with(&v.to_bits().to_le_bytes()));
        }
        for corner in self.blob_triangles.iter().flatten() {
            hash = hash.with(&corner.to_le_bytes());
        }
        hash.value()
    }
}
