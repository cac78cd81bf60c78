//! Silhouettes of meshes by an independent path: every triangle filled by tiny-skia.

#![allow(clippy::unwrap_used, unreachable_pub, reason = "shared by tests and an example")]

use pleach_mesh::Mesh;
use pleach_silhouette::{Bitmap, Camera, Frame, View};
use tiny_skia::{FillRule, Mask, PathBuilder, Transform};

/// Samples across and down a pixel: those of the silhouettes that meshes are compared with, since a
/// pixel that is about half covered hangs on where the samples are.
const SAMPLES: (u32, u32) = (8, 4);

/// Ink where at least half of a pixel's samples lie in some triangle.
pub fn silhouette(mesh: &Mesh, view: &View, frame: &Frame) -> Bitmap {
    let (width, height) = (frame.width, frame.height);
    let (across, down) = SAMPLES;
    let camera = Camera::new(view, frame);
    let mut mask = Mask::new(width * across, height * down).unwrap();
    for (_, block) in &mesh.parts {
        let corners: Vec<(f32, f32)> = block
            .vertices
            .iter()
            .map(|v| {
                let (x, y) = camera.project(v.position.as_dvec3(), 1.0);
                ((x * f64::from(across)) as f32, (y * f64::from(down)) as f32)
            })
            .collect();
        for triangle in &block.triangles {
            let [a, b, c] = triangle.map(|i| corners[i as usize]);
            let mut path = PathBuilder::new();
            path.move_to(a.0, a.1);
            path.line_to(b.0, b.1);
            path.line_to(c.0, c.1);
            path.close();
            if let Some(path) = path.finish() {
                mask.fill_path(&path, FillRule::Winding, false, Transform::identity());
            }
        }
    }
    let data = mask.data();
    Bitmap::from_fn(width, height, |x, y| {
        let row = |j: u32| ((y * down + j) * width * across + x * across) as usize;
        let set = |j: u32| data[row(j)..row(j) + across as usize].iter().filter(|v| **v > 127).count();
        2 * (0..down).map(set).sum::<usize>() >= (across * down) as usize
    })
}

/// Pixels in both over pixels in either.
pub fn iou(a: &Bitmap, b: &Bitmap) -> f64 {
    let both = a.intersection(b);
    both as f64 / (a.ink() + b.ink() - both).max(1) as f64
}
