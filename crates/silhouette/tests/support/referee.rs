//! The same silhouettes drawn by tiny-skia, many times as fine: slow, simple, and not ours.
//!
//! Every shape at full detail (splines flattened to a fiftieth of a pixel, leaves with all their
//! corners, blossoms with all their faces), each as a path of its own, since overlapping shapes of
//! one path would cancel. The fast path is judged by it in the tests.

#![allow(dead_code, unreachable_pub, reason = "a test and a bench share it, and each uses half")]

use glam::{DVec2, DVec3};
use pleach_silhouette::{Bitmap, Camera, Frame, View};
use pleach_tree::spline::Cubic;
use pleach_tree::{Leaf, Parts, Tree};
use tiny_skia::{FillRule, Mask, PathBuilder, Transform};

/// What the referee saw.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// Black from half coverage.
    pub bitmap: Bitmap,
    /// Covered area in pixels: the sum of all pixels' coverage.
    pub coverage: f64,
}

/// A frame was too large to be drawn so finely.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{width} × {height} pixels, {fineness} times as fine, are more than the referee's {MAX_SIDE}")]
pub struct TooFine {
    /// Width of the frame in pixels.
    pub width: u32,
    /// Height of the frame in pixels.
    pub height: u32,
    /// Samples along each side of a pixel.
    pub fineness: u32,
}

/// Longest side, in samples: 256 megabytes.
pub const MAX_SIDE: u32 = 16_384;

/// Farthest that a chord strays from its curve, in pixels.
const TOLERANCE: f64 = 0.02;

/// Draws `tree` with `fineness` × `fineness` samples per pixel and without anti-aliasing.
///
/// # Errors
/// If a side of the picture has more than [`MAX_SIDE`] samples.
pub fn draw(
    tree: &Tree,
    view: &View,
    frame: &Frame,
    parts: Parts,
    fineness: u32,
) -> Result<Verdict, TooFine> {
    let Frame { width, height, .. } = *frame;
    let too_fine = TooFine { width, height, fineness };
    let (wide, high) = (width.saturating_mul(fineness), height.saturating_mul(fineness));
    if wide.max(high) > MAX_SIDE {
        return Err(too_fine);
    }
    let mask = filled(tree, view, frame, parts, fineness).ok_or(too_fine)?;
    let mut counts = vec![0_u32; width as usize * height as usize];
    for (y, row) in mask.data().chunks_exact(wide as usize).enumerate() {
        let first = y / fineness as usize * width as usize;
        for (count, samples) in counts[first..].iter_mut().zip(row.chunks_exact(fineness as usize)) {
            *count += samples.iter().map(|&s| u32::from(s >> 7)).sum::<u32>();
        }
    }
    let whole = fineness * fineness;
    let bitmap = Bitmap::from_fn(width, height, |x, y| 2 * counts[(y * width + x) as usize] >= whole);
    let coverage = counts.iter().map(|&c| f64::from(c)).sum::<f64>() / f64::from(whole);
    Ok(Verdict { bitmap, coverage })
}

/// A camera and its axes in the world.
struct Eye {
    camera: Camera,
    right: DVec3,
    down: DVec3,
    away: DVec3,
}

/// Calls `fill` with the corners, in pixels, of every polygon of `parts` of `tree`.
pub fn shapes(tree: &Tree, view: &View, frame: &Frame, parts: Parts, mut fill: impl FnMut(&[DVec2])) {
    let [right, up, away] = view.axes();
    let eye = &Eye { camera: Camera::new(view, frame), right, down: -up, away };
    for stem in tree.stems.iter().filter(|stem| parts.has_stem(stem.kind)) {
        let knots = tree.knots_of(stem);
        let straight = knots[knots.len() - 1].point - knots[0].point;
        let pieces: Vec<_> = tree.pieces_of(stem).collect();
        for (i, (piece, r0, r1)) in pieces.iter().enumerate() {
            strip(eye, piece, *r0, *r1, straight, &mut fill);
            if i > 0 {
                joint(eye, &pieces[i - 1].0, piece, *r0, &mut fill);
            }
            if i == 0 {
                disc(eye, piece, 0.0, *r0, &mut fill);
            }
            if i + 1 == pieces.len() {
                disc(eye, piece, 1.0, *r1, &mut fill);
            }
        }
    }
    if parts.contains(Parts::LEAVES) {
        for leaf in &tree.leaves {
            let corner = |p: &[f32; 2]| DVec3::new(f64::from(p[0]), f64::from(p[1]), 0.0);
            let outline: Vec<DVec3> = tree.outline_of(leaf).corners().iter().map(corner).collect();
            blade(eye, leaf, &outline, &mut fill);
        }
    }
    if parts.contains(Parts::BLOSSOMS) {
        for blossom in &tree.blossoms {
            let faces = tree.blossom_shapes[usize::from(blossom.shape)].faces();
            let corner = |&i: &u8| glam::Vec3::from(faces.vertices[usize::from(i)]).as_dvec3();
            for face in faces.polygons {
                let corners: Vec<DVec3> = face.iter().map(corner).collect();
                blade(eye, blossom, &corners, &mut fill);
            }
        }
    }
    if parts.contains(Parts::BLOBS) {
        for blob in &tree.blobs {
            let vertices = &tree.blob_vertices[blob.vertices()];
            for triangle in &tree.blob_triangles[blob.triangles()] {
                let corners = triangle.map(|i| seen(eye, vertices[i as usize].as_dvec3()));
                if let [Some(a), Some(b), Some(c)] = corners {
                    fill(&[a, b, c]);
                }
            }
        }
    }
}

fn blade(eye: &Eye, leaf: &Leaf, corners: &[DVec3], fill: &mut impl FnMut(&[DVec2])) {
    let (at, across, along) = (leaf.position.as_dvec3(), leaf.across.as_dvec3(), leaf.along.as_dvec3());
    let normal = leaf.normal().as_dvec3();
    let place = |c: &DVec3| seen(eye, at + across * c.x + along * c.y + normal * c.z);
    if let Some(corners) = corners.iter().map(place).collect::<Option<Vec<DVec2>>>() {
        fill(&corners);
    }
}

fn seen(eye: &Eye, point: DVec3) -> Option<DVec2> {
    eye.camera.magnification(point).map(|m| eye.camera.project(point, m).into())
}

/// Centre and left rim of the stem at `t`, in pixels.
fn rib(eye: &Eye, piece: &Cubic, t: f64, radius: f64, straight: DVec3) -> Option<(DVec2, DVec2)> {
    let point = piece.at(t);
    let center = seen(eye, point)?;
    let ahead = |v: DVec3| DVec2::new(v.dot(eye.right), v.dot(eye.down)).try_normalize();
    let along = ahead(piece.derivative(t)).or_else(|| ahead(straight)).unwrap_or(DVec2::Y);
    let wide = radius * eye.camera.pixels_per_meter() * eye.camera.magnification(point)?;
    Some((center, along.perp() * wide))
}

fn strip(eye: &Eye, piece: &Cubic, r0: f64, r1: f64, straight: DVec3, fill: &mut impl FnMut(&[DVec2])) {
    let chords = piece.chords(TOLERANCE / eye.camera.pixels_per_meter());
    let at = |i: u32| {
        let t = f64::from(i) / f64::from(chords);
        rib(eye, piece, t, r0 + (r1 - r0) * t, straight)
    };
    for i in 0..chords {
        let (Some((p, u)), Some((q, v))) = (at(i), at(i + 1)) else { continue };
        // As two triangles, which cannot cross themselves.
        fill(&[p + u, p - u, q - v]);
        fill(&[p + u, q - v, q + v]);
    }
}

/// The ball between two pieces of a stem that turns there.
fn joint(eye: &Eye, before: &Cubic, after: &Cubic, radius: f64, fill: &mut impl FnMut(&[DVec2])) {
    let ways = before.derivative(1.0).try_normalize().zip(after.derivative(0.0).try_normalize());
    // Smooth stems have none, up to rounding.
    if ways.is_none_or(|(arrives, leaves)| arrives.distance(leaves) < 0.01) {
        return;
    }
    let point = after.at(0.0);
    let Some((center, magnification)) = seen(eye, point).zip(eye.camera.magnification(point)) else { return };
    let wide = radius * eye.camera.pixels_per_meter() * magnification;
    let corners: [DVec2; 64] =
        std::array::from_fn(|i| center + DVec2::from_angle(i as f64 * std::f64::consts::TAU / 64.0) * wide);
    fill(&corners);
}

/// The round end of a stem, seen at an angle.
fn disc(eye: &Eye, piece: &Cubic, t: f64, radius: f64, fill: &mut impl FnMut(&[DVec2])) {
    let Some(tangent) = piece.derivative(t).try_normalize() else { return };
    let Some((center, side)) = rib(eye, piece, t, radius, tangent) else { return };
    let short = side.perp() * tangent.dot(eye.away).abs();
    let corners: [DVec2; 64] = std::array::from_fn(|i| {
        let (sin, cos) = (i as f64 * std::f64::consts::TAU / 64.0).sin_cos();
        center + side * cos + short * sin
    });
    fill(&corners);
}

/// The polygons of [`shapes`], filled by tiny-skia with `fineness` × `fineness` samples per pixel and without
/// anti-aliasing; with one it is what our own drawing is timed against. None if the frame is empty or too large.
pub fn filled(tree: &Tree, view: &View, frame: &Frame, parts: Parts, fineness: u32) -> Option<Mask> {
    let mut mask = Mask::new(frame.width.checked_mul(fineness)?, frame.height.checked_mul(fineness)?)?;
    let scale = Transform::from_scale(fineness as f32, fineness as f32);
    shapes(tree, view, frame, parts, |corners| {
        let mut path = PathBuilder::new();
        for (i, p) in corners.iter().enumerate() {
            let (x, y) = (p.x as f32, p.y as f32);
            if i == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
        }
        path.close();
        if let Some(path) = path.finish() {
            mask.fill_path(&path, FillRule::EvenOdd, false, scale);
        }
    });
    Some(mask)
}
