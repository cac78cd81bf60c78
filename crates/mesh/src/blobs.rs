//! Closed surfaces of foliage as triangles with smooth normals.

use crate::block::{Block, Vertex};
use crate::part::Count;
use glam::{Vec2, Vec3};
use pleach_plant::{Blob, Tree};

/// Vertices and triangles of all blobs.
pub(crate) fn count(tree: &Tree) -> Count {
    let mut count = Count::default();
    for blob in &tree.blobs {
        count += Count { vertices: blob.vertex_count.into(), triangles: blob.triangle_count.into() };
    }
    count
}

/// Appends `blob`, all of whose corners have these texture coordinates; its vertices count from `base`.
pub(crate) fn push(tree: &Tree, blob: &Blob, uv: Vec2, base: u32, block: &mut Block) {
    let positions = &tree.blob_vertices[blob.vertices()];
    let triangles = &tree.blob_triangles[blob.triangles()];
    let mut normals = vec![Vec3::ZERO; positions.len()];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|i| positions[i as usize]);
        // Twice the area, so that large faces count more.
        let normal = (b - a).cross(c - a);
        triangle.iter().for_each(|&i| normals[i as usize] += normal);
    }
    block.vertices.extend(positions.iter().zip(normals).map(|(&position, normal)| Vertex {
        position,
        normal: normal.try_normalize().unwrap_or(Vec3::Z),
        uv,
    }));
    block.triangles.extend(triangles.iter().map(|t| t.map(|i| base + i)));
}
