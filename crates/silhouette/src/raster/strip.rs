//! Stems as tapered strips.

pub(super) mod flat;

use super::grid::{Corner, Grid};
use crate::view::Camera;
use glam::{DVec3, Vec2};
use pleach_tree::math;
use pleach_tree::spline::Cubic;
use pleach_tree::{Stem, Tree};

/// Farthest that a chord may stray from the curve, in pixels.
const TOLERANCE: f64 = 0.1;
/// Cross-sections smaller than this many pixels to a side are not drawn at the ends of stems.
const MIN_CAP: f32 = 0.25;

/// A point of a stem's outline in pixels.
#[derive(Clone, Copy, Debug)]
struct Rib {
    center: Vec2,
    /// From the centre to the left rim.
    side: Vec2,
}

/// Draws `stem`; `scale` turns pixels into samples.
pub(super) fn draw(grid: &mut Grid, camera: &Camera, scale: Vec2, tree: &Tree, stem: &Stem) {
    let mut last: Option<Rib> = None;
    let knots = tree.knots_of(stem);
    let straight = knots[knots.len() - 1].point - knots[0].point;
    for (piece, r0, r1) in tree.pieces_of(stem) {
        let chords = piece.chords(TOLERANCE / camera.pixels_per_meter());
        if last.is_none() {
            last = rib(camera, &piece, 0.0, r0, straight);
            cap(grid, camera, scale, &piece, 0.0, r0);
        }
        for i in 1..=chords {
            let t = f64::from(i) / f64::from(chords);
            let next = rib(camera, &piece, t, r0 + (r1 - r0) * t, straight);
            if let (Some(from), Some(to)) = (last, next) {
                quad(grid, scale, &from, &to);
            }
            last = next;
        }
    }
    if let Some((piece, _, r1)) = tree.pieces_of(stem).last() {
        cap(grid, camera, scale, &piece, 1.0, r1);
    }
}

/// The rib at `t`; none behind a perspective camera. `fallback` is the way of a curve that stands
/// still there.
fn rib(camera: &Camera, piece: &Cubic, t: f64, radius: f64, fallback: DVec3) -> Option<Rib> {
    let point = piece.at(t);
    let magnification = camera.magnification(point)?;
    let (x, y) = camera.project(point, magnification);
    let seen = |v: DVec3| Vec2::new(v.dot(camera.right) as f32, v.dot(camera.down) as f32);
    let along = seen(piece.derivative(t)).try_normalize();
    let along = along.or_else(|| seen(fallback).try_normalize()).unwrap_or(Vec2::Y);
    let width = (radius * camera.pixels_per_meter() * magnification) as f32;
    Some(Rib { center: Vec2::new(x as f32, y as f32), side: along.perp() * width })
}

/// The strip between two ribs; where it bends more sharply than it is wide, two triangles, since the
/// quadrilateral would cross itself.
fn quad(grid: &mut Grid, scale: Vec2, from: &Rib, to: &Rib) {
    let corner = |p: Vec2| -> Corner { (p * scale).to_array() };
    let (a, b) = (from.center + from.side, from.center - from.side);
    let (c, d) = (to.center - to.side, to.center + to.side);
    let ahead = to.center - from.center;
    if (d - a).dot(ahead) >= 0.0 && (c - b).dot(ahead) >= 0.0 {
        grid.fill(&[corner(a), corner(b), corner(c), corner(d)]);
    } else {
        grid.fill(&[corner(a), corner(b), corner(c)]);
        grid.fill(&[corner(a), corner(c), corner(d)]);
        grid.fill(&[corner(a), corner(b), corner(d)]);
    }
}

/// The cross-section at `t`, an ellipse where the stem points at the viewer or away.
fn cap(grid: &mut Grid, camera: &Camera, scale: Vec2, piece: &Cubic, t: f64, radius: f64) {
    const CORNERS: usize = 16;
    // Most stems are thinner than this, and need no more than a look.
    let widest = radius * camera.pixels_per_meter();
    if camera.is_orthographic() && widest < 0.99 * f64::from(MIN_CAP) {
        return;
    }
    let Some(tangent) = piece.derivative(t).try_normalize() else { return };
    let Some(rib) = rib(camera, piece, t, radius, tangent) else { return };
    let wide = rib.side.length();
    let high = wide * tangent.dot(camera.away).abs() as f32;
    if high < MIN_CAP {
        return;
    }
    let short = rib.side.perp() * (high / wide);
    let corners: [Corner; CORNERS] = std::array::from_fn(|i| {
        let (sin, cos) = math::sin_cos_f32(i as f32 * std::f32::consts::TAU / CORNERS as f32);
        ((rib.center + rib.side * cos + short * sin) * scale).to_array()
    });
    grid.fill(&corners);
}
