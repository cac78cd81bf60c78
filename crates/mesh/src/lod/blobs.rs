//! Closed surfaces of foliage with fewer triangles.

use glam::Vec3;
use pleach_plant::{Blob, Tree};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Fewest triangles of a closed surface that is more than two faces.
const FEWEST: usize = 4;

/// Collapses edges of all blobs of `tree`, the shortest first, until together they have at most `triangles`, as far as
/// surfaces stay closed. What a surface loses in volume its size gives back.
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

struct Surface {
    positions: Vec<Vec3>,
    /// Those that are left.
    faces: Vec<Option<[u32; 3]>>,
    left: usize,
    /// The faces at each vertex; some may be gone.
    at: Vec<Vec<u32>>,
    /// How often each vertex has moved.
    moved: Vec<u32>,
}

impl Surface {
    fn new(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Self {
        let mut at = vec![Vec::new(); positions.len()];
        for (i, triangle) in (0..).zip(&triangles) {
            triangle.iter().for_each(|&vertex| at[vertex as usize].push(i));
        }
        let (left, moved) = (triangles.len(), vec![0; positions.len()]);
        Self { positions, faces: triangles.into_iter().map(Some).collect(), left, at, moved }
    }

    fn neighbours(&self, vertex: u32) -> Vec<u32> {
        let faces = self.at[vertex as usize].iter().filter_map(|&face| self.faces[face as usize]);
        let mut found: Vec<u32> = faces.flatten().filter(|&other| other != vertex).collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    fn edge(&self, a: u32, b: u32) -> Reverse<Edge> {
        let length = self.positions[a as usize].distance_squared(self.positions[b as usize]);
        // Lengths are not negative, so that their bits are in their order.
        Reverse(Edge {
            length: length.to_bits(),
            ends: [a, b],
            moved: [a, b].map(|end| self.moved[end as usize]),
        })
    }

    fn collapse(&mut self, target: usize) {
        let mut edges = BinaryHeap::new();
        for [a, b, c] in self.faces.iter().flatten().copied() {
            for (a, b) in [(a, b), (b, c), (c, a)].into_iter().filter(|(a, b)| a < b) {
                edges.push(self.edge(a, b));
            }
        }
        while self.left > target {
            let Some(Reverse(edge)) = edges.pop() else { break };
            let [a, b] = edge.ends;
            if edge.moved != edge.ends.map(|end| self.moved[end as usize]) {
                continue;
            }
            let near = [a, b].map(|end| self.neighbours(end));
            let shared: Vec<u32> = near[0].iter().filter(|n| near[1].contains(n)).copied().collect();
            // Without more than these two a collapse would pinch the surface.
            if shared.len() != 2 || near.iter().any(|near| near.len() < 4) && self.left <= FEWEST {
                continue;
            }
            if shared.iter().any(|&corner| self.neighbours(corner).len() <= 3) {
                continue;
            }
            self.positions[a as usize] = (self.positions[a as usize] + self.positions[b as usize]) / 2.0;
            for face in std::mem::take(&mut self.at[b as usize]) {
                let Some(corners) = &mut self.faces[face as usize] else { continue };
                if corners.contains(&a) {
                    self.faces[face as usize] = None;
                    self.left -= 1;
                } else {
                    corners.iter_mut().filter(|corner| **corner == b).for_each(|corner| *corner = a);
                    self.at[a as usize].push(face);
                }
            }
            self.moved[a as usize] += 1;
            self.moved[b as usize] += 1;
            for other in self.neighbours(a) {
                edges.push(self.edge(a.min(other), a.max(other)));
            }
        }
    }

    /// Six times what is enclosed.
    fn volume(&self) -> f32 {
        let at = |i: u32| self.positions[i as usize];
        self.faces.iter().flatten().map(|&[a, b, c]| at(a).dot(at(b).cross(at(c)))).sum()
    }

    /// Scales about the middle so that it encloses `volume`.
    fn grow(&mut self, volume: f32) {
        let now = self.volume();
        let ratio = volume / now;
        if !(ratio.is_finite() && ratio > 0.0) {
            return;
        }
        let scale = pleach_plant::math::powf(ratio, 1.0 / 3.0).clamp(1.0, 1.5);
        let used: Vec<u32> = self.faces.iter().flatten().flatten().copied().collect();
        let middle =
            used.iter().map(|&i| self.positions[i as usize]).sum::<Vec3>() / used.len().max(1) as f32;
        self.positions.iter_mut().for_each(|position| *position = middle + (*position - middle) * scale);
    }

    fn compact(self) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let mut number = vec![u32::MAX; self.positions.len()];
        let mut positions = Vec::new();
        let triangles = self.faces.into_iter().flatten().map(|face| {
            face.map(|corner| {
                let number = &mut number[corner as usize];
                if *number == u32::MAX {
                    *number = positions.len() as u32;
                    positions.push(self.positions[corner as usize]);
                }
                *number
            })
        });
        let triangles = triangles.collect();
        (positions, triangles)
    }
}

/// An edge as it was when it was noted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Edge {
    length: u32,
    ends: [u32; 2],
    moved: [u32; 2],
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
