//! The triangles that a picture shows: of a crown's, those are few.

use super::raster::{DepthBuffer, NONE};
use super::scene::Scene;
use glam::Vec3;
use pleach_mesh::Vertex;

/// What is seen of a scene through a camera.
#[derive(Debug)]
pub(super) struct Seen {
    /// Samples across the picture.
    width: usize,
    /// For each sample the place in `triangles` of what is seen there, or [`NONE`].
    samples: Vec<u32>,
    triangles: Vec<Triangle>,
    vertices: Vec<Vertex>,
}

/// A triangle that is seen.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    corners: [u32; 3],
    /// Its number in the scene.
    pub(super) number: u32,
    /// The number of its first corner in the scene.
    pub(super) first_corner: u32,
}

impl Seen {
    /// What is seen in a picture of so many samples, where `project` says where a point is in it: samples right and
    /// down, and the nearness.
    pub(super) fn new(scene: &Scene<'_>, width: u32, height: u32, project: impl Fn(Vec3) -> Vec3) -> Self {
        let DepthBuffer { triangle, .. } = scene.draw(width, height, project);
        Self::gather(scene, width, triangle)
    }

    /// From samples that hold numbers of the scene's triangles.
    fn gather(scene: &Scene<'_>, width: u32, mut samples: Vec<u32>) -> Self {
        let mut is_seen = vec![false; scene.count().triangles as usize];
        samples.iter().filter(|number| **number != NONE).for_each(|number| is_seen[*number as usize] = true);
        let count = is_seen.iter().filter(|seen| **seen).count();
        let (mut triangles, mut vertices) = (Vec::with_capacity(count), Vec::new());
        // Where the corners of a block have gone.
        let mut places: Vec<u32> = Vec::new();
        scene.each_block(|block| {
            places.clear();
            places.resize(block.vertices.len(), NONE);
            for (number, corners) in (block.first_triangle..).zip(block.triangles) {
                if !is_seen[number as usize] {
                    continue;
                }
                let corners_kept = corners.map(|corner| {
                    let place = &mut places[corner as usize];
                    if *place == NONE {
                        *place = vertices.len() as u32;
                        vertices.push(block.vertices[corner as usize]);
                    }
                    *place
                });
                let first_corner = block.first_corner + corners[0];
                triangles.push(Triangle { corners: corners_kept, number, first_corner });
            }
        });
        for sample in samples.iter_mut().filter(|sample| **sample != NONE) {
            *sample = triangles.partition_point(|triangle: &Triangle| triangle.number < *sample) as u32;
        }
        Self { width: width as usize, samples, triangles, vertices }
    }

    /// What is seen at a sample.
    pub(super) fn at(&self, x: u32, y: u32) -> Option<&Triangle> {
        let place = self.samples[y as usize * self.width + x as usize];
        (place != NONE).then(|| &self.triangles[place as usize])
    }

    /// The corners of a triangle.
    pub(super) fn corners(&self, triangle: &Triangle) -> [&Vertex; 3] {
        triangle.corners.map(|corner| &self.vertices[corner as usize])
    }
}
