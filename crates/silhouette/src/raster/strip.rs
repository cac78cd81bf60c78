//! Stems as tapered strips.

pub(super) mod flat;

use super::grid::{Corner, Grid};
use crate::view::Camera;
use glam::{DVec3, Vec2};
use pleach_plant::math;
use pleach_plant::spline::Cubic;
use pleach_plant::{Knot, Stem, Tree};

/// Farthest that a chord may stray from the curve, in pixels.
const TOLERANCE: f64 = 0.1;
/// Cross-sections smaller than this many pixels to a side are not drawn at the ends of stems.
const MIN_CAP: f32 = 0.25;

/// Where a stem turns farther than this at a knot (23 degrees, by its cosine), what leaves the knot begins with a
/// rib of its own, and a ball joins it to what arrives. Below it one rib serves both: it is at most so
/// much narrower than what leaves, so that of a stroke of two equal pieces less than 2 % of the ink is missing.
const SHARP: f64 = 0.92;

/// A point of a stem's outline in pixels.
#[derive(Clone, Copy, Debug)]
struct Rib {
    center: Vec2,
    /// From the centre to the left rim.
    side: Vec2,
}

/// A part of a stem between two points of its axis, in metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chord {
    pub(super) from: DVec3,
    pub(super) to: DVec3,
    pub(super) radii: [f64; 2],
}

/// What stems are drawn on.
pub(super) trait Canvas {
    /// Fills a polygon, as [`Grid::fill`].
    fn fill(&mut self, corners: &[Corner]);

    /// The polygons that follow are seen of this part of a stem.
    fn begin(&mut self, _chord: impl FnOnce() -> Chord) {}
}

impl Canvas for Grid {
    #[inline]
    fn fill(&mut self, corners: &[Corner]) {
        Self::fill(self, corners);
    }
}

/// Draws `stem`; `scale` turns pixels into samples.
pub(super) fn draw(canvas: &mut impl Canvas, camera: &Camera, scale: Vec2, tree: &Tree, stem: &Stem) {
    let mut last: Option<Rib> = None;
    let knots = tree.knots_of(stem);
    let straight = knots[knots.len() - 1].point - knots[0].point;
    for (k, (piece, r0, r1)) in tree.pieces_of(stem).enumerate() {
        let chords = piece.chords(TOLERANCE / camera.pixels_per_meter());
        if last.is_none() {
            last = rib(camera, &piece, 0.0, r0, straight);
            canvas.begin(|| Chord { from: piece.at(0.0), to: piece.at(0.0), radii: [r0, r0] });
            cap(canvas, camera, scale, &piece, 0.0, r0);
        } else if k > 0 && is_sharp([&knots[k - 1], &knots[k], &knots[k + 1]]) {
            last = rib(camera, &piece, 0.0, r0, knots[k + 1].point - knots[k].point);
            if let Some(rib) = &last {
                canvas.begin(|| Chord { from: piece.at(0.0), to: piece.at(0.0), radii: [r0, r0] });
                ball(canvas, scale, rib);
            }
        }
        for i in 1..=chords {
            let t = f64::from(i) / f64::from(chords);
            let radius = |t: f64| r0 + (r1 - r0) * t;
            let next = rib(camera, &piece, t, radius(t), straight);
            if let (Some(from), Some(to)) = (last, next) {
                canvas.begin(|| {
                    let before = f64::from(i - 1) / f64::from(chords);
                    Chord { from: piece.at(before), to: piece.at(t), radii: [radius(before), radius(t)] }
                });
                quad(canvas, scale, &from, &to);
            }
            last = next;
        }
    }
    if let Some((piece, _, r1)) = tree.pieces_of(stem).last() {
        canvas.begin(|| Chord { from: piece.at(1.0), to: piece.at(1.0), radii: [r1, r1] });
        cap(canvas, camera, scale, &piece, 1.0, r1);
    }
}

/// Whether a stem turns sharply in space at the second of three knots in a row.
fn is_sharp([before, here, after]: [&Knot; 3]) -> bool {
    let way = |handle: DVec3, chord: DVec3| handle.try_normalize().or_else(|| chord.try_normalize());
    let arrives = way(here.point - here.handle_in, here.point - before.point);
    let leaves = way(here.handle_out - here.point, after.point - here.point);
    arrives.zip(leaves).is_some_and(|(arrives, leaves)| arrives.dot(leaves) < SHARP)
}

/// The rib at `t`; `None` behind a perspective camera. `fallback` is the way of a curve that stands
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
fn quad(canvas: &mut impl Canvas, scale: Vec2, from: &Rib, to: &Rib) {
    let corner = |p: Vec2| -> Corner { (p * scale).to_array() };
    let (a, b) = (from.center + from.side, from.center - from.side);
    let (c, d) = (to.center - to.side, to.center + to.side);
    let ahead = to.center - from.center;
    if (d - a).dot(ahead) >= 0.0 && (c - b).dot(ahead) >= 0.0 {
        canvas.fill(&[corner(a), corner(b), corner(c), corner(d)]);
    } else {
        canvas.fill(&[corner(a), corner(b), corner(c)]);
        canvas.fill(&[corner(a), corner(c), corner(d)]);
        canvas.fill(&[corner(a), corner(b), corner(d)]);
    }
}

/// The ball at a corner, as wide as `rib`.
fn ball(canvas: &mut impl Canvas, scale: Vec2, rib: &Rib) {
    const MAX_CORNERS: usize = 64;
    let radius = rib.side.length();
    // Edges stray from the circle by at most half of the tolerance, up to a radius of 40 pixels.
    let corners = (std::f32::consts::PI * (radius / TOLERANCE as f32).sqrt()).ceil();
    let count = corners.clamp(8.0, MAX_CORNERS as f32) as usize;
    let corners: [Corner; MAX_CORNERS] = std::array::from_fn(|i| {
        let (sin, cos) = math::sin_cos_f32(i as f32 * std::f32::consts::TAU / count as f32);
        ((rib.center + Vec2::new(cos, sin) * radius) * scale).to_array()
    });
    canvas.fill(&corners[..count]);
}

/// The cross-section at `t`, an ellipse where the stem points at the viewer or away.
fn cap(canvas: &mut impl Canvas, camera: &Camera, scale: Vec2, piece: &Cubic, t: f64, radius: f64) {
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
    canvas.fill(&corners);
}
