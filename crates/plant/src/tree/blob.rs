//! Foliage as closed surfaces, for trees that are drawn and not grown leaf by leaf.

use serde::{Deserialize, Serialize};
use std::ops::Range;

/// A closed surface of foliage: a run of [`Tree::blob_vertices`](super::Tree::blob_vertices) and one of
/// [`Tree::blob_triangles`](super::Tree::blob_triangles), whose numbers count from the blob's first
/// vertex. Seen from outside, triangles are counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Blob {
    /// Index in [`Tree::stems`](super::Tree::stems) of the stem that carries it.
    pub stem: u32,
    /// First of its vertices.
    pub first_vertex: u32,
    /// Number of its vertices, at least 4.
    pub vertex_count: u32,
    /// First of its triangles.
    pub first_triangle: u32,
    /// Number of its triangles, at least 4.
    pub triangle_count: u32,
}

impl Blob {
    /// Its vertices as a range of [`Tree::blob_vertices`](super::Tree::blob_vertices).
    #[must_use]
    pub fn vertices(&self) -> Range<usize> {
        let first = self.first_vertex as usize;
        first..first + self.vertex_count as usize
    }

    /// Its triangles as a range of [`Tree::blob_triangles`](super::Tree::blob_triangles).
    #[must_use]
    pub fn triangles(&self) -> Range<usize> {
        let first = self.first_triangle as usize;
        first..first + self.triangle_count as usize
    }

    /// Whether `triangles` close a surface: each edge is passed exactly once in each direction.
    #[must_use]
    pub fn is_closed(triangles: &[[u32; 3]]) -> bool {
        let edges = |t: &[u32; 3]| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])];
        let mut there: Vec<(u32, u32)> = triangles.iter().flat_map(edges).collect();
        let mut back: Vec<(u32, u32)> = there.iter().map(|&(a, b)| (b, a)).collect();
        there.sort_unstable();
        back.sort_unstable();
        there == back && there.windows(2).all(|w| w[0] != w[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tetrahedron_is_closed_until_a_face_is_missing_or_turned() {
        let mut faces = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
        assert!(Blob::is_closed(&faces));
        assert!(!Blob::is_closed(&faces[1..]));
        assert!(!Blob::is_closed(&[faces.clone(), faces.clone()].concat()));
        faces[0] = [0, 1, 2];
        assert!(!Blob::is_closed(&faces));
    }
}
