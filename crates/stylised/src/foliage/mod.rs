//! Foliage as closed surfaces: blobs at branch ends, cones around trunks, fronds on top of them.

mod blob;
mod cone;
mod frond;

pub(crate) use blob::Blobs;

use crate::params::{FoliageKind, Numbers};
use crate::skeleton::Skeleton;
use crate::write::{Budget, Writer};
use glam::DVec3;
use pleach_tree::{GrowError, Key};

/// Radius of the first sphere of a blob of size 1.
const RADIUS: f64 = 0.25;
/// Foliage smaller than this is not there.
const MIN_SIZE: f64 = 1e-3;

/// A closed surface about to be written: vertices in units of the sliders, triangles counter-clockwise
/// from outside.
#[derive(Debug, Default)]
pub(crate) struct Surface {
    pub(crate) vertices: Vec<DVec3>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

impl Surface {
    fn clear(&mut self) {
        self.vertices.clear();
        self.triangles.clear();
    }

    /// Triangles between `rings` rings of `sides` vertices each, the first vertex of a ring after the
    /// last of the one before; then a fan from the vertex after all rings to the first ring, and from
    /// the one after that to the last.
    fn close_rings(&mut self, rings: u32, sides: u32) {
        let (first, last) = (rings * sides, rings * sides + 1);
        for i in 0..sides {
            let next = (i + 1) % sides;
            self.triangles.push([first, next, i]);
            for ring in 0..rings - 1 {
                let at = |ring: u32, side: u32| ring * sides + side;
                let (a, b, c, d) = (at(ring, i), at(ring, next), at(ring + 1, next), at(ring + 1, i));
                self.triangles.extend([[a, b, c], [a, c, d]]);
            }
            let top = (rings - 1) * sides;
            self.triangles.push([top + i, top + next, last]);
        }
    }
}

/// Memory for foliage.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    blobs: Blobs,
    surface: Surface,
}

/// Writes the foliage of the tree with this skeleton.
///
/// # Errors
/// If a limit is passed.
pub(crate) fn grow(
    scratch: &mut Scratch,
    numbers: &Numbers,
    skeleton: &Skeleton,
    key: Key,
    budget: &mut Budget,
    writer: &mut Writer<'_>,
) -> Result<(), GrowError> {
    if numbers.leaves_quantity <= 0.0 || numbers.leaves_size < MIN_SIZE {
        return Ok(());
    }
    match numbers.foliage {
        FoliageKind::Blob => scratch.blobs.grow(numbers, skeleton, key, budget, writer),
        FoliageKind::Cone => cone::grow(&mut scratch.surface, numbers, skeleton, key, budget, writer),
        FoliageKind::Palm => frond::grow(&mut scratch.surface, numbers, skeleton, key, budget, writer),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;
    use pleach_tree::Blob;

    #[test]
    fn rings_are_closed_and_face_outwards() {
        let mut surface = Surface::default();
        for z in [0.0, 1.0, 2.0] {
            let corners = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)];
            surface.vertices.extend(corners.map(|(x, y)| dvec3(x, y, z)));
        }
        surface.vertices.extend([DVec3::ZERO, dvec3(0.0, 0.0, 2.0)]);
        surface.close_rings(3, 4);
        assert!(Blob::is_closed(&surface.triangles));
        let at = |i: u32| surface.vertices[i as usize];
        let volume: f64 =
            surface.triangles.iter().map(|t| at(t[0]).dot(at(t[1]).cross(at(t[2]))) / 6.0).sum();
        assert!((volume - 4.0).abs() < 1e-12, "a prism: {volume}");
    }
}
