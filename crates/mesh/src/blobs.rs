//! Closed surfaces of foliage as triangles with smooth normals.

use crate::block::{Block, Vertex};
use crate::part::Count;
use glam::{Vec2, Vec3, vec2};
use pleach_plant::{Blob, Tree};

/// Width and height in metres of the picture that blobs show.
pub const TILE: f32 = 1.0;

/// Whether the blobs of `tree` show tiles of foliage where there are pictures. Leaves have a sheet of pictures, on which
/// nothing repeats: with them blobs have one colour.
#[must_use]
pub const fn have_tiles(tree: &Tree) -> bool {
    !tree.blobs.is_empty() && tree.leaves.is_empty()
}

/// Where blobs are on their picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Cover {
    /// All corners in one place.
    Spot(Vec2),
    /// In tiles of [`TILE`] metres, as seen along the axis that is nearest to the normal of each triangle, upright: pictures
    /// are drawn at most √3 times as long one way as the other. A corner is there once for each axis.
    Tiles,
}

/// One of six directions: along x, y or z, and back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Side(usize);

const SIDES: usize = 6;

impl Side {
    /// The one that a triangle with this normal looks to.
    fn new(normal: Vec3) -> Self {
        let far = normal.abs();
        let axis = if far.x >= far.y && far.x >= far.z {
            0
        } else if far.y >= far.z {
            1
        } else {
            2
        };
        Self(axis + if normal[axis] < 0.0 { 3 } else { 0 })
    }

    /// The place on the picture of a point, in tiles; v grows downwards.
    fn uv(self, p: Vec3) -> Vec2 {
        let uv = match self.0 {
            0 => vec2(p.y, -p.z),
            1 => vec2(-p.x, -p.z),
            2 => vec2(p.x, -p.y),
            3 => vec2(-p.y, -p.z),
            4 => vec2(p.x, -p.z),
            _ => vec2(p.x, p.y),
        };
        uv / TILE
    }
}

/// The corners of `blob`, each with the side that shows it, and its triangles by their numbers.
fn corners(tree: &Tree, blob: &Blob, cover: Cover) -> (Vec<(u32, Side)>, Vec<[u32; 3]>) {
    let positions = &tree.blob_vertices[blob.vertices()];
    let triangles = &tree.blob_triangles[blob.triangles()];
    if let Cover::Spot(_) = cover {
        return ((0..positions.len() as u32).map(|i| (i, Side(0))).collect(), triangles.to_vec());
    }
    let mut numbers = vec![[u32::MAX; SIDES]; positions.len()];
    let mut corners = Vec::with_capacity(positions.len());
    let cut = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|i| positions[i as usize]);
        let side = Side::new((b - a).cross(c - a));
        triangle.map(|i| {
            let number = &mut numbers[i as usize][side.0];
            if *number == u32::MAX {
                *number = corners.len() as u32;
                corners.push((i, side));
            }
            *number
        })
    };
    let triangles = triangles.iter().map(cut).collect();
    (corners, triangles)
}

/// Vertices and triangles of all blobs.
pub(crate) fn count(tree: &Tree, cover: Cover) -> Count {
    let mut count = Count::default();
    for blob in &tree.blobs {
        let vertices = corners(tree, blob, cover).0.len() as u64;
        count += Count { vertices, triangles: blob.triangle_count.into() };
    }
    count
}

/// Appends `blob`; its vertices count from `base`.
pub(crate) fn push(tree: &Tree, blob: &Blob, cover: Cover, base: u32, block: &mut Block) {
    let positions = &tree.blob_vertices[blob.vertices()];
    let mut normals = vec![Vec3::ZERO; positions.len()];
    for triangle in &tree.blob_triangles[blob.triangles()] {
        let [a, b, c] = triangle.map(|i| positions[i as usize]);
        // Twice the area, so that large faces count more.
        let normal = (b - a).cross(c - a);
        triangle.iter().for_each(|&i| normals[i as usize] += normal);
    }
    let (corners, triangles) = corners(tree, blob, cover);
    block.vertices.extend(corners.into_iter().map(|(corner, side)| {
        let position = positions[corner as usize];
        Vertex {
            position,
            normal: normals[corner as usize].try_normalize().unwrap_or(Vec3::Z),
            uv: match cover {
                Cover::Spot(uv) => uv,
                Cover::Tiles => side.uv(position),
            },
        }
    }));
    block.triangles.extend(triangles.into_iter().map(|t| t.map(|i| base + i)));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::MeshSettings;
    use crate::{Material, Mesh};

    #[test]
    fn pictures_on_blobs_are_upright_and_hardly_stretched() {
        let tree = pleach_generators::preset("stylised_oak").unwrap().grow(1).unwrap();
        let mesh = |pictured| Mesh::new(&tree, MeshSettings { pictured, ..MeshSettings::default() });
        let (plain, pictured) = (mesh(false), mesh(true));
        let [plain, pictured] = [&plain, &pictured].map(|mesh| mesh.part(Material::Leaf).unwrap());
        assert_eq!(plain.triangles.len(), pictured.triangles.len());
        assert!(plain.vertices.iter().all(|vertex| vertex.uv == plain.vertices[0].uv));
        assert!(pictured.vertices.len() < plain.vertices.len() * 3 / 2);
        let at = |block: &Block, corner: u32| {
            let Vertex { position, normal, .. } = block.vertices[corner as usize];
            (position, normal)
        };
        for (a, b) in plain.triangles.iter().zip(&pictured.triangles) {
            assert_eq!(a.map(|i| at(plain, i)), b.map(|i| at(pictured, i)));
            let [a, b, c] = b.map(|i| pictured.vertices[i as usize]);
            let (p, q) = (b.position - a.position, c.position - a.position);
            let (s, t) = (b.uv - a.uv, c.uv - a.uv);
            let area = s.perp_dot(t);
            let (across, along) = ((p * t.y - q * s.y) / area, (q * s.x - p * t.x) / area);
            let stretch = across.length() / along.length();
            assert!(area < 0.0, "mirrored");
            assert!((0.55..1.8).contains(&stretch), "{stretch}");
        }
    }
}
