//! The visible triangles of a picture: few of a crown's.

use super::raster::{DepthBuffer, NONE};
use super::scene::Scene;
use glam::Vec3;
use pleach_mesh::Vertex;
use rayon::prelude::*;

/// The visible triangles of a scene through a camera.
#[derive(Debug)]
pub(super) struct Seen {
    /// Samples across the picture.
    width: usize,
    /// For each sample the index into `triangles` of the one that is visible there, or [`NONE`].
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
    /// The visible triangles of a picture of this many samples. `project` gives a point's samples right and down,
    /// and its nearness.
    pub(super) fn new(scene: &Scene<'_>, width: u32, height: u32, project: impl Fn(Vec3) -> Vec3) -> Self {
        let DepthBuffer { triangle, .. } = scene.draw(width, height, project);
        Self::gather(scene, width, triangle)
    }

    /// From samples that hold numbers of the scene's triangles.
    fn gather(scene: &Scene<'_>, width: u32, mut samples: Vec<u32>) -> Self {
        let seen = Numbers::new(samples.iter().copied().filter(|number| *number != NONE));
        let (mut triangles, mut vertices) = (Vec::new(), Vec::new());
        // Where the corners of a block have gone.
        let mut places: Vec<u32> = Vec::new();
        scene.each_block(|block| {
            places.clear();
            places.resize(block.vertices.len(), NONE);
            for (number, corners) in (block.first_triangle..).zip(block.triangles) {
                if !seen.has(number) {
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
        samples
            .par_iter_mut()
            .filter(|sample| **sample != NONE)
            .for_each(|sample| *sample = seen.place(*sample));
        Self { width: width as usize, samples, triangles, vertices }
    }

    /// The triangle that is visible at a sample.
    pub(super) fn at(&self, x: u32, y: u32) -> Option<&Triangle> {
        let place = self.samples[y as usize * self.width + x as usize];
        (place != NONE).then(|| &self.triangles[place as usize])
    }

    /// The corners of a triangle.
    pub(super) fn corners(&self, triangle: &Triangle) -> [&Vertex; 3] {
        triangle.corners.map(|corner| &self.vertices[corner as usize])
    }
}

/// A set of numbers that knows the rank of each.
#[derive(Debug, Default)]
struct Numbers {
    /// A bit for each number.
    words: Vec<u64>,
    /// How many there are before each word.
    before: Vec<u32>,
}

impl Numbers {
    fn new(numbers: impl Iterator<Item = u32>) -> Self {
        let mut words = Vec::new();
        for number in numbers {
            let word = number as usize / 64;
            if word >= words.len() {
                words.resize(word + 1, 0_u64);
            }
            words[word] |= 1 << (number % 64);
        }
        let mut count = 0;
        let before = words
            .iter()
            .map(|word| {
                count += word.count_ones();
                count - word.count_ones()
            })
            .collect();
        Self { words, before }
    }

    fn has(&self, number: u32) -> bool {
        self.words.get(number as usize / 64).is_some_and(|word| word >> (number % 64) & 1 == 1)
    }

    /// How many of the set are less than `number`, which is in it.
    fn place(&self, number: u32) -> u32 {
        let word = number as usize / 64;
        self.before[word] + (self.words[word] & ((1 << (number % 64)) - 1)).count_ones()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_know_their_places() {
        let list = [0, 3, 63, 64, 127, 128, 700];
        let numbers = Numbers::new(list.into_iter().rev().chain(list));
        assert!(list.into_iter().map(|number| numbers.place(number)).eq(0..7));
        let there: Vec<u32> = (0..1000).filter(|number| numbers.has(*number)).collect();
        assert_eq!(there, list);
    }
}
