//! How far a tree is from the viewer: the nearest surface in each pixel.
//!
//! The shapes are those of the silhouette, filled on the same samples, so that each pixel of ink has a distance. One
//! number is kept for each pixel, the least of all surfaces that cover any of its samples: foliage far behind a twig
//! does not show through beside it.

use super::Rasterizer;
use super::grid::{ACROSS, Corner, SKEW};
use super::outline::{Blade, look_alike};
use super::strip::{self, Canvas, Chord};
use super::{Placer, Scene};
use crate::bitmap::Bitmap;
use crate::view::{Camera, Frame, View};
use glam::{DVec3, Vec2, Vec3};
use pleach_plant::{Leaf, Parts, Tree};

/// How far beyond a shape a sample may lie and still be covered by it, in samples: more than rounding in the
/// silhouette's arithmetic.
const MARGIN: f32 = 0.02;
/// Smallest cosine between the axis of a stem and the picture: what points at the viewer is seen by its end.
const MIN_COSINE: f32 = 1e-3;

impl Rasterizer {
    /// How far `parts` of `tree` are from the viewer, pixel by pixel and row by row, into `out`.
    ///
    /// Distances are metres along the direction of view from the plane through the trunk's foot that faces the viewer:
    /// negative in front of it, positive behind. Of all surfaces in a pixel the nearest counts, in the middle of the
    /// pixel where it reaches that far. Leaves, blossoms and blobs are planes; stems are round, and exact where they do
    /// not taper. NaN where `picture`, the silhouette of the same parts in the same frame, has no ink.
    ///
    /// ```
    /// use pleach_plant::Parts;
    /// use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
    ///
    /// let tree = pleach_generators::species("palm")?.grow(1)?;
    /// let (view, parts) = (View::FRONT, Parts::LEAFY);
    /// let frame = Frame::automatic(&tree, &view, parts, 64, 64);
    /// let (mut rasterizer, mut picture, mut depth) = (Rasterizer::new(), Bitmap::default(), Vec::new());
    /// rasterizer.draw(&tree, &view, &frame, parts, &mut picture);
    /// rasterizer.depth(&tree, &view, &frame, parts, &picture, &mut depth);
    /// assert_eq!(depth.iter().filter(|depth| depth.is_finite()).count() as u64, picture.ink());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn depth(
        &mut self,
        tree: &Tree,
        view: &View,
        frame: &Frame,
        parts: Parts,
        picture: &Bitmap,
        out: &mut Vec<f32>,
    ) {
        let (camera, down) = self.begin(tree, view, frame, parts);
        let scale = Vec2::new(ACROSS as f32, down as f32);
        let mut canvas = Nearest::new(&camera, frame, down);
        for stem in tree.stems.iter().filter(|stem| parts.has_stem(stem.kind)) {
            strip::draw(&mut canvas, &camera, scale, tree, stem);
        }
        let placer = Placer::new(&Scene::new(tree, &camera, down, parts));
        if parts.contains(Parts::LEAVES) {
            self.leaf_depths(tree, &placer, &mut canvas);
        }
        if parts.contains(Parts::BLOSSOMS) {
            blossom_depths(tree, &placer, &mut canvas);
        }
        if parts.contains(Parts::BLOBS) {
            blob_depths(tree, &placer, &mut canvas);
        }
        out.clear();
        let pixels = (0..frame.height).flat_map(|y| (0..frame.width).map(move |x| (x, y)));
        out.extend(
            canvas.nearest.iter().zip(pixels).map(|(&depth, (x, y))| {
                if picture.get(x, y) && depth.is_finite() { depth } else { f32::NAN }
            }),
        );
    }

    fn leaf_depths(&mut self, tree: &Tree, placer: &Placer<'_>, canvas: &mut Nearest<'_>) {
        let pixels = placer.camera.pixels_per_meter() as f32;
        let mut corners = Vec::new();
        for run in tree.leaves.chunk_by(look_alike) {
            let size = [run[0].across.length() * pixels, run[0].along.length() * pixels];
            let Blade { outline, .. } = self.sheet.outlines.get(tree.outline_of(&run[0]), size);
            for leaf in run {
                let vertices = outline.iter().map(|&[u, v]| [u, v, 0.0]);
                canvas.leaf(placer, leaf, vertices, &mut corners);
            }
        }
    }
}

fn blossom_depths(tree: &Tree, placer: &Placer<'_>, canvas: &mut Nearest<'_>) {
    let mut corners = Vec::new();
    for blossom in &tree.blossoms {
        let faces = tree.blossom_shapes[usize::from(blossom.shape)].faces();
        for polygon in faces.petals {
            let vertices = polygon.iter().map(|&vertex| faces.vertices[usize::from(vertex)]);
            canvas.leaf(placer, blossom, vertices, &mut corners);
        }
    }
}

fn blob_depths(tree: &Tree, placer: &Placer<'_>, canvas: &mut Nearest<'_>) {
    for blob in &tree.blobs {
        let vertices = &tree.blob_vertices[blob.vertices()];
        for triangle in &tree.blob_triangles[blob.triangles()] {
            let corner = |i: u32| {
                let vertex = vertices[i as usize];
                Some(Place { at: placer.point(vertex)?, depth: canvas.depth_of(vertex.as_dvec3()) })
            };
            if let [Some(a), Some(b), Some(c)] = triangle.map(corner) {
                canvas.plane(&[a, b, c]);
            }
        }
    }
}

/// A corner of a shape: where it is in samples, and how far away.
#[derive(Clone, Copy, Debug)]
struct Place {
    at: Corner,
    depth: f32,
}

/// A part of a stem as it is seen.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    /// The ends of the axis in pixels.
    from: Vec2,
    ahead: Vec2,
    /// One over the square of the length of `ahead`, or 0.
    inverse: f32,
    /// Distances of the ends.
    depths: [f32; 2],
    radii: [f32; 2],
    /// Of the axis and the picture.
    cosine: f32,
    meters_per_pixel: f32,
}

impl Seen {
    /// Distance of the surface at a place in pixels.
    fn depth(&self, at: Vec2) -> f32 {
        let t = ((at - self.from).dot(self.ahead) * self.inverse).clamp(0.0, 1.0);
        let mix = |[from, to]: [f32; 2]| from + (to - from) * t;
        let off = at.distance(self.from + self.ahead * t) * self.meters_per_pixel;
        let radius = mix(self.radii);
        let half = (radius * radius - off * off).max(0.0).sqrt();
        // In front of the axis by more, the more it points at the viewer; but no more than its nearer end is.
        let nearest = self.depths[0].min(self.depths[1]) - self.radii[0].max(self.radii[1]);
        (mix(self.depths) - half / self.cosine).max(nearest)
    }
}

/// The distance of the nearest surface in each pixel.
struct Nearest<'a> {
    camera: &'a Camera,
    width: usize,
    height: usize,
    /// Samples down each pixel.
    down: usize,
    nearest: Vec<f32>,
    /// The part of a stem that is being drawn.
    stem: Seen,
}

impl<'a> Nearest<'a> {
    fn new(camera: &'a Camera, frame: &Frame, down: u32) -> Self {
        let (width, height) = (frame.width as usize, frame.height as usize);
        let nearest = vec![f32::INFINITY; width * height];
        Self { camera, width, height, down: down as usize, nearest, stem: Seen::default() }
    }

    fn depth_of(&self, point: DVec3) -> f32 {
        point.dot(self.camera.away) as f32
    }

    /// A flat part of a leaf or a blossom, whose corners are `vertices` of its unit shape.
    fn leaf(
        &mut self,
        placer: &Placer<'_>,
        leaf: &Leaf,
        vertices: impl Iterator<Item = [f32; 3]>,
        corners: &mut Vec<Place>,
    ) {
        let Some([at, across, along]) = placer.place(leaf) else { return };
        let normal = placer.normal(leaf);
        let away = self.camera.away.as_vec3();
        let base = self.depth_of(leaf.position.as_dvec3());
        let [across_depth, along_depth, normal_depth] =
            [leaf.across, leaf.along, leaf.normal()].map(|axis: Vec3| axis.dot(away));
        corners.clear();
        corners.extend(vertices.map(|[u, v, w]| Place {
            at: [
                at[0] + across[0] * u + along[0] * v + normal[0] * w,
                at[1] + across[1] * u + along[1] * v + normal[1] * w,
            ],
            depth: base + across_depth * u + along_depth * v + normal_depth * w,
        }));
        self.plane(corners);
    }

    /// A flat polygon.
    fn plane(&mut self, places: &[Place]) {
        let [low, high] = places.iter().fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], place| {
            [low.min(place.depth), high.max(place.depth)]
        });
        let Some(origin) = places.first() else { return };
        // The gradient by the largest of the triangles at the first corner.
        let (mut largest, mut gradient) = (0.0, [0.0; 2]);
        for pair in places[1..].windows(2) {
            let side = |place: &Place| {
                [place.at[0] - origin.at[0], place.at[1] - origin.at[1], place.depth - origin.depth]
            };
            let ([ax, ay, az], [bx, by, bz]) = (side(&pair[0]), side(&pair[1]));
            let area = ax * by - ay * bx;
            if area.abs() > largest {
                largest = area.abs();
                gradient = [(az * by - bz * ay) / area, (bz * ax - az * bx) / area];
            }
        }
        // Seen edge on, rounding decides on the gradient, and no part is nearer than the nearest corner.
        let depth = move |x: f32, y: f32| {
            let [right, below] = gradient;
            let depth = origin.depth + right * (x - origin.at[0]) + below * (y - origin.at[1]);
            if depth.is_nan() { low } else { depth.clamp(low, high) }
        };
        if low <= high {
            self.cover(|i| places[i].at, places.len(), depth);
        }
    }

    /// Keeps the distances of a polygon (even-odd) of which `depth` is one at each place in samples, where it is the
    /// nearest.
    fn cover(&mut self, corner: impl Fn(usize) -> Corner, count: usize, depth: impl Fn(f32, f32) -> f32) {
        let (mut top, mut bottom) = (f32::INFINITY, f32::NEG_INFINITY);
        for i in 0..count {
            let [x, y] = corner(i);
            if !(x.is_finite() && y.is_finite()) {
                return;
            }
            (top, bottom) = (top.min(y), bottom.max(y));
        }
        let rows = (self.height * self.down) as f32;
        let columns = (self.width * ACROSS as usize) as f32;
        let first = (top - 0.5 - MARGIN).ceil().clamp(0.0, rows) as usize;
        let last = (bottom - 0.5 + MARGIN).ceil().clamp(0.0, rows) as usize;
        let mut crossings: Vec<f32> = Vec::with_capacity(count);
        for row in first..last {
            // A row that misses the shape by a rounding error is one that the silhouette may have met.
            let y = (row as f32 + 0.5).clamp(top, bottom);
            crossings.clear();
            for i in 0..count {
                let (p, q) = (corner(i), corner((i + 1) % count));
                if (p[1] < y) != (q[1] < y) {
                    crossings.push(p[0] + (y - p[1]) * (q[0] - p[0]) / (q[1] - p[1]));
                }
            }
            crossings.sort_unstable_by(f32::total_cmp);
            let skew = 0.5 + SKEW[row % SKEW.len()] as f32 / 65536.0;
            let line = row / self.down * self.width;
            // In the middle of the pixel, so that what slopes is not nearer because a pixel is large.
            let level = ((row / self.down * self.down) as f32 + self.down as f32 / 2.0).clamp(top, bottom);
            for &[enter, leave] in crossings.as_chunks().0 {
                let from = (enter - skew - MARGIN).ceil().clamp(0.0, columns) as usize;
                let to = (leave - skew + MARGIN).ceil().clamp(0.0, columns) as usize;
                if from >= to {
                    continue;
                }
                for pixel in from / ACROSS as usize..=(to - 1) / ACROSS as usize {
                    let middle = (pixel as f32 + 0.5) * ACROSS as f32;
                    let depth = depth(middle.max(enter).min(leave), level);
                    let nearest = &mut self.nearest[line + pixel];
                    *nearest = nearest.min(depth);
                }
            }
        }
    }
}

impl Canvas for Nearest<'_> {
    fn fill(&mut self, corners: &[Corner]) {
        let (stem, down) = (self.stem, self.down as f32);
        let pixel = move |x: f32, y: f32| Vec2::new(x / ACROSS as f32, y / down);
        self.cover(|i| corners[i], corners.len(), |x, y| stem.depth(pixel(x, y)));
    }

    fn begin(&mut self, chord: impl FnOnce() -> Chord) {
        let Chord { from, to, radii } = chord();
        let place = |point: DVec3| {
            let magnification = self.camera.magnification(point).unwrap_or(1.0);
            let (x, y) = self.camera.project(point, magnification);
            (Vec2::new(x as f32, y as f32), magnification)
        };
        let ((start, magnification), (end, _)) = (place(from), place(to));
        let ahead = end - start;
        let length = from.distance(to) as f32;
        let meters_per_pixel = (1.0 / (self.camera.pixels_per_meter() * magnification)) as f32;
        let squared = ahead.length_squared();
        let cosine = if length > 0.0 { squared.sqrt() * meters_per_pixel / length } else { 1.0 };
        self.stem = Seen {
            from: start,
            ahead,
            inverse: if squared > 0.0 { 1.0 / squared } else { 0.0 },
            depths: [self.depth_of(from), self.depth_of(to)],
            radii: radii.map(|radius| radius as f32),
            cosine: cosine.clamp(MIN_COSINE, 1.0),
            meters_per_pixel,
        };
    }
}

#[cfg(test)]
mod tests;
