//! Closed surfaces of foliage with fewer triangles.

use crate::decimate::{FEWEST, Surface};
use pleach_plant::{Blob, Tree};

/// Collapses edges of all blobs of `tree` until together they have at most `triangles`, as far as surfaces stay closed. What a surface loses in volume its size gives back.
pub(super) fn reduce(tree: &mut Tree, triangles: usize) {
    let whole = tree.blob_triangles.len();
    if whole <= triangles {
        return;
    }
    let (mut blobs, mut vertices, mut faces) = (Vec::new(), Vec::new(), Vec::new());
    for blob in &tree.blobs {
        let own = &tree.blob_triangles[blob.triangles()];
        let target = (own.len() * triangles / whole).max(FEWEST);
        let mut surface = Surface::new(tree.blob_vertices[blob.vertices()].to_vec(), own.to_vec());
        let before = surface.volume();
        surface.collapse(target);
        surface.grow(before);
        let (positions, triangles) = surface.compact();
        blobs.push(Blob {
            first_vertex: vertices.len() as u32,
            vertex_count: positions.len() as u32,
            first_triangle: faces.len() as u32,
            triangle_count: triangles.len() as u32,
            ..*blob
        });
        vertices.extend(positions);
        faces.extend(triangles);
    }
    (tree.blobs, tree.blob_vertices, tree.blob_triangles) = (blobs, vertices, faces);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fewer_triangles_still_close_the_surface() {
        for name in ["stylised_oak", "stylised_cherry", "stylised_fir"] {
            let Some(species) = pleach_generators::preset(name) else { continue };
            let tree = species.grow(1).unwrap();
            let surface = |tree: &Tree| -> f32 {
                let of = |blob: &Blob| {
                    let own = &tree.blob_vertices[blob.vertices()];
                    Surface::new(own.to_vec(), tree.blob_triangles[blob.triangles()].to_vec()).volume()
                };
                tree.blobs.iter().map(of).sum()
            };
            for part in [2, 4, 10] {
                let mut coarse = tree.clone();
                let target = tree.blob_triangles.len() / part;
                reduce(&mut coarse, target);
                coarse.well_formed().unwrap();
                let least = (target * 8 / 10)..=target.max(FEWEST * tree.blobs.len());
                assert!(
                    least.contains(&coarse.blob_triangles.len()),
                    "{name} {part}: {}",
                    coarse.blob_triangles.len()
                );
                let ratio = surface(&coarse) / surface(&tree);
                assert!((0.85..1.05).contains(&ratio), "{name} {part}: {ratio}");
            }
        }
    }
}
