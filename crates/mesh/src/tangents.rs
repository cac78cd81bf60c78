//! Tangents, which pictures of normals need: the directions in which u grows.

use crate::block::{Block, Vertex};
use glam::Vec3;

/// For each corner of `block` the unit vector at right angles to its normal in which u grows, and 1 where the picture is
/// seen as it is or −1 where it is mirrored: normal × tangent times this number points to the picture's top, as in glTF 2.0,
/// section 3.7.2.1. The corners are numbered from `first` in the block's triangles.
#[must_use]
pub fn tangents(block: &Block, first: u32) -> Vec<[f32; 4]> {
    let mut along = vec![Vec3::ZERO; block.vertices.len()];
    // Above zero where the picture is mirrored.
    let mut mirrored = vec![0.0; block.vertices.len()];
    for triangle in &block.triangles {
        let corners = triangle.map(|corner| (corner - first) as usize);
        let [a, b, c] = corners.map(|corner| &block.vertices[corner]);
        let (to_b, to_c) = (b.position - a.position, c.position - a.position);
        let (uv_b, uv_c) = (b.uv - a.uv, c.uv - a.uv);
        let (face, turn) = (to_b.cross(to_c), uv_b.perp_dot(uv_c));
        // Solved for the direction of u; its size does not matter. By the area of the triangle, as normals are.
        let direction = (to_b * uv_c.y - to_c * uv_b.y) * turn.signum();
        let direction = direction.try_normalize().unwrap_or(Vec3::ZERO) * face.length();
        for corner in corners {
            along[corner] += direction;
            // v grows downwards, so that a picture that is seen as it is turns the other way than its triangle.
            mirrored[corner] += turn * face.dot(block.vertices[corner].normal);
        }
    }
    let tangent = |((vertex, along), mirrored): ((&Vertex, Vec3), f32)| {
        let flat = along - vertex.normal * along.dot(vertex.normal);
        let tangent = flat.try_normalize().unwrap_or_else(|| vertex.normal.any_orthonormal_vector());
        [tangent.x, tangent.y, tangent.z, if mirrored > 0.0 { -1.0 } else { 1.0 }]
    };
    block.vertices.iter().zip(along).zip(mirrored).map(tangent).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{vec2, vec3};

    #[test]
    fn tangents_run_with_u_across_the_normal() {
        let corner = |x: f32, z: f32| Vertex {
            position: vec3(x, 0.3 * x, z),
            normal: vec3(0.3, -1.0, 0.0).normalize(),
            uv: vec2(2.0 * x, -z),
        };
        let vertices = vec![corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)];
        let triangles = vec![[10, 11, 12], [10, 12, 13]];
        let block = Block { vertices, triangles, ..Block::default() };
        let expected = vec3(1.0, 0.3, 0.0).normalize();
        for [x, y, z, w] in tangents(&block, 10) {
            assert!((vec3(x, y, z) - expected).length() < 1e-6 && w == 1.0, "{x} {y} {z} {w}");
        }
    }

    #[test]
    fn a_corner_without_a_picture_has_some_tangent() {
        let vertex = Vertex { normal: Vec3::Z, ..Vertex::default() };
        let block = Block { vertices: vec![vertex; 3], triangles: vec![[0, 1, 2]], ..Block::default() };
        for [x, y, z, _] in tangents(&block, 0) {
            assert!((vec3(x, y, z).length() - 1.0).abs() < 1e-6 && z.abs() < 1e-6);
        }
    }

    #[test]
    fn a_mirrored_picture_is_told() {
        // A square that faces −y; v grows downwards.
        let square = |is_mirrored: bool| {
            let vertex = |(x, z): (f32, f32)| Vertex {
                position: vec3(x, 0.0, z),
                normal: -Vec3::Y,
                uv: vec2(if is_mirrored { 1.0 - x } else { x }, 1.0 - z),
            };
            let vertices = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(vertex).to_vec();
            Block { vertices, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Block::default() }
        };
        assert!(tangents(&square(false), 0).iter().all(|t| *t == [1.0, 0.0, 0.0, 1.0]));
        assert!(tangents(&square(true), 0).iter().all(|t| *t == [-1.0, 0.0, 0.0, -1.0]));
    }
}
