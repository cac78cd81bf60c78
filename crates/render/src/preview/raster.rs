//! Triangles into a depth buffer that remembers which one is nearest.

use glam::Vec3;
use rayon::prelude::*;

/// Nothing was drawn here.
pub(crate) const NONE: u32 = u32::MAX;

/// For each sample how near the nearest triangle is, and its number.
#[derive(Clone, Debug)]
pub(crate) struct DepthBuffer {
    width: u32,
    height: u32,
    /// Larger is nearer; 0 is nothing.
    pub(crate) near: Vec<f32>,
    /// [`NONE`] is nothing.
    pub(crate) triangle: Vec<u32>,
    /// For each band of rows the triangles that reach into it, while they are drawn.
    bins: Vec<Vec<u32>>,
}

/// Rows that one thread draws at a time.
const BAND: usize = 64;

impl DepthBuffer {
    /// An empty buffer of this many samples.
    pub(crate) fn new(width: u32, height: u32) -> Self {
        let size = width as usize * height as usize;
        let bands = (height as usize).div_ceil(BAND);
        Self {
            width,
            height,
            near: vec![0.0; size],
            triangle: vec![NONE; size],
            bins: vec![Vec::new(); bands],
        }
    }

    /// Draws triangles, numbered from `first`, between `corners`: in samples, x right, y down, z the nearness. Where
    /// two are equally near, the one that was drawn first stays, whatever the number of threads.
    pub(crate) fn draw(&mut self, corners: &[Vec3], triangles: &[[u32; 3]], first: u32) {
        self.sort(corners, triangles);
        let Self { width, near, triangle, bins, .. } = self;
        let rows = BAND * *width as usize;
        near.par_chunks_mut(rows).zip(triangle.par_chunks_mut(rows)).zip(bins).enumerate().for_each(
            |(band, ((near, triangle), bin))| {
                let mut target = Band { width: *width as i32, first: (band * BAND) as i32, near, triangle };
                for i in bin.drain(..) {
                    target.fill(first + i, triangles[i as usize].map(|corner| corners[corner as usize]));
                }
            },
        );
    }

    /// Sorts triangles into the bands that they reach into.
    fn sort(&mut self, corners: &[Vec3], triangles: &[[u32; 3]]) {
        let height = self.height as usize;
        for (i, triangle) in triangles.iter().enumerate() {
            let [a, b, c] = triangle.map(|corner| corners[corner as usize]);
            let (top, bottom) = (a.y.min(b.y).min(c.y), a.y.max(b.y).max(c.y));
            // Written so that NaN is left out.
            if !(bottom > 0.0 && top < height as f32) || a.z.min(b.z).min(c.z) <= 0.0 {
                continue;
            }
            let first = top.max(0.0) as usize / BAND;
            let last = (bottom as usize).min(height - 1) / BAND;
            for bin in &mut self.bins[first..=last] {
                bin.push(i as u32);
            }
        }
    }
}

struct Band<'a> {
    width: i32,
    first: i32,
    near: &'a mut [f32],
    triangle: &'a mut [u32],
}

impl Band<'_> {
    fn fill(&mut self, number: u32, [a, b, c]: [Vec3; 3]) {
        let rows = self.near.len() as i32 / self.width;
        let (left, right) = (a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x));
        let (top, bottom) = (a.y.min(b.y).min(c.y), a.y.max(b.y).max(c.y));
        let x0 = ((left - 0.5).ceil() as i32).max(0);
        let x1 = ((right - 0.5).floor() as i32).min(self.width - 1);
        let y0 = ((top - 0.5).ceil() as i32).max(self.first);
        let y1 = ((bottom - 0.5).floor() as i32).min(self.first + rows - 1);
        if x0 > x1 || y0 > y1 {
            return;
        }
        let area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if area == 0.0 || !area.is_finite() {
            return;
        }
        // Edge functions, positive inside whichever way round the triangle is.
        let edge = |p: Vec3, q: Vec3| {
            let (dx, dy) = ((q.x - p.x) / area, (q.y - p.y) / area);
            (-dy, dx, dy * p.x - dx * p.y)
        };
        let edges = [edge(b, c), edge(c, a), edge(a, b)];
        let sx = edges[0].0 * a.z + edges[1].0 * b.z + edges[2].0 * c.z;
        let sy = edges[0].1 * a.z + edges[1].1 * b.z + edges[2].1 * c.z;
        let s0 = edges[0].2 * a.z + edges[1].2 * b.z + edges[2].2 * c.z;
        for y in y0..=y1 {
            let py = y as f32 + 0.5;
            // The span in which all three are positive.
            let (mut from, mut to) = (x0 as f32, x1 as f32);
            for (ex, ey, e0) in edges {
                let rest = ey * py + e0;
                let cross = -rest / ex - 0.5;
                if ex > 0.0 {
                    from = from.max(cross.ceil());
                } else if ex < 0.0 {
                    to = to.min(cross.floor());
                } else if rest < 0.0 {
                    to = -1.0;
                }
            }
            if from > to {
                continue;
            }
            let row = ((y - self.first) * self.width) as usize;
            let span = row + from as usize..row + to as usize + 1;
            let mut near = sx * (from + 0.5) + sy * py + s0;
            for (depth, triangle) in self.near[span.clone()].iter_mut().zip(&mut self.triangle[span]) {
                if near > *depth {
                    (*depth, *triangle) = (near, number);
                }
                near += sx;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

    #[test]
    fn the_nearer_triangle_is_seen() {
        let points = [
            vec3(0.0, 0.0, 1.0),
            vec3(8.0, 0.0, 1.0),
            vec3(0.0, 8.0, 1.0),
            vec3(0.0, 0.0, 2.0),
            vec3(0.0, 4.0, 2.0),
            vec3(4.0, 0.0, 2.0),
        ];
        let mut buffer = DepthBuffer::new(8, 8);
        buffer.draw(&points, &[[0, 1, 2], [3, 4, 5]], 0);
        let at = |x: usize, y: usize| buffer.triangle[y * 8 + x];
        assert_eq!((at(0, 0), at(5, 1), at(7, 7)), (1, 0, NONE));
        let seen = buffer.triangle.iter().filter(|t| **t != NONE).count();
        assert!((28..=36).contains(&seen), "half of 64 samples: {seen}");
    }

    #[test]
    fn of_two_that_are_equally_near_the_first_stays() {
        let points = [vec3(0.0, 0.0, 1.0), vec3(8.0, 0.0, 1.0), vec3(0.0, 8.0, 1.0)];
        let mut buffer = DepthBuffer::new(8, 8);
        buffer.draw(&points, &[[0, 1, 2], [0, 1, 2]], 4);
        buffer.draw(&points, &[[2, 1, 0]], 6);
        assert!(buffer.triangle.iter().all(|number| [4, NONE].contains(number)));
        assert_eq!(buffer.triangle[0], 4);
    }

    #[test]
    fn a_mesh_covers_every_sample_once() {
        // A fan around a point: no gap at the seams.
        let rim = |i: u32| {
            let a = i as f32 * 0.7;
            vec3(50.0 + 60.0 * a.cos(), 50.0 + 60.0 * a.sin(), 1.0)
        };
        let points: Vec<Vec3> = std::iter::once(vec3(50.3, 49.8, 1.0)).chain((0..9).map(rim)).collect();
        let triangles: Vec<[u32; 3]> = (1..10).map(|i| [0, i, i % 9 + 1]).collect();
        let mut buffer = DepthBuffer::new(100, 100);
        buffer.draw(&points, &triangles, 0);
        let holes = (30..70).flat_map(|y| (30..70).map(move |x| (x, y)));
        assert_eq!(holes.filter(|(x, y)| buffer.triangle[y * 100 + x] == NONE).count(), 0);
    }
}
