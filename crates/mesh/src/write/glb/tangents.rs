//! Tangents, which pictures of normals need: the directions in which u grows.

use crate::block::Block;
use glam::Vec3;

/// For each corner of `block` the unit vector at right angles to its normal in which u grows, and 1, since no picture is
/// mirrored. The corners are numbered from `first` in the block's triangles.
pub(super) fn tangents(block: &Block, first: u32) -> Vec<[f32; 4]> {
    let mut along = vec![Vec3::ZERO; block.vertices.len()];
    for triangle in &block.triangles {
        let corners = triangle.map(|corner| (corner - first) as usize);
        let [a, b, c] = corners.map(|corner| &block.vertices[corner]);
        let (to_b, to_c) = (b.position - a.position, c.position - a.position);
        let (uv_b, uv_c) = (b.uv - a.uv, c.uv - a.uv);
        // Solved for the direction of u; its sign says whether the picture is mirrored, and its size does not matter.
        let direction = (to_b * uv_c.y - to_c * uv_b.y) * uv_b.perp_dot(uv_c).signum();
        // By the area of the triangle, as normals are.
        let area = to_b.cross(to_c).length();
        let direction = direction.try_normalize().unwrap_or(Vec3::ZERO) * area;
        corners.into_iter().for_each(|corner| along[corner] += direction);
    }
    let at_right_angles = |(vertex, along): (&crate::Vertex, Vec3)| {
        let flat = along - vertex.normal * along.dot(vertex.normal);
        let tangent = flat.try_normalize().unwrap_or_else(|| vertex.normal.any_orthonormal_vector());
        [tangent.x, tangent.y, tangent.z, 1.0]
    };
    block.vertices.iter().zip(along).map(at_right_angles).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::Vertex;
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
}
