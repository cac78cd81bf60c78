//! Stems without perspective: their splines are projected first, and evaluated in the picture's plane.
//!
//! A Bézier curve's projection is the Bézier curve of its projected control points, so that all that is left to do
//! is in two dimensions and, at a picture's size, in single precision.

use super::{Rib, SHARP, TOLERANCE, ball, cap, is_sharp, quad};
use crate::raster::grid::Grid;
use crate::raster::occlusion::Occlusion;
use crate::view::Camera;
use glam::{DVec3, Vec2};
use pleach_plant::piece;
use pleach_plant::{Knot, Stem, Tree};

/// Bends below the root of this, in pixels, are one chord: a little less than 4/3 of [`TOLERANCE`].
const STRAIGHT: f32 = 0.99 * (TOLERANCE / 0.75 * TOLERANCE / 0.75) as f32;

/// A knot in pixels.
#[derive(Clone, Copy)]
struct FlatKnot {
    point: Vec2,
    handle_in: Vec2,
    handle_out: Vec2,
    radius: f32,
}

impl FlatKnot {
    fn new(camera: &Camera, knot: &Knot) -> Self {
        let flat = |point: DVec3| {
            let (x, y) = camera.project(point, 1.0);
            Vec2::new(x as f32, y as f32)
        };
        Self {
            point: flat(knot.point),
            handle_in: flat(knot.handle_in),
            handle_out: flat(knot.handle_out),
            radius: (knot.radius * camera.pixels_per_meter()) as f32,
        }
    }

    /// Whether what arrives at the knot and what leaves it are seen as a sharp turn; or not at all, along the
    /// line of sight. What is smooth in space may seem so, too.
    fn seems_sharp(&self) -> bool {
        const SQUARE: f32 = (SHARP * SHARP) as f32;
        let (arrives, leaves) = (self.point - self.handle_in, self.handle_out - self.point);
        let dot = arrives.dot(leaves);
        dot <= 0.0 || dot * dot < SQUARE * arrives.length_squared() * leaves.length_squared()
    }
}

/// Draws `stem` as [`super::draw`] does, up to rounding, without the pieces that are known to be hidden. `camera` is
/// without perspective.
pub(in crate::raster) fn draw(
    grid: &mut Grid,
    occlusion: &mut Occlusion,
    camera: &Camera,
    scale: Vec2,
    tree: &Tree,
    stem: &Stem,
) {
    let knots = tree.knots_of(stem);
    let [first, second, ..] = knots else { return };
    let mut from = FlatKnot::new(camera, first);
    let last_point = FlatKnot::new(camera, &knots[knots.len() - 1]).point;
    // The way of a curve that stands still.
    let straight = (last_point - from.point).try_normalize().unwrap_or(Vec2::Y);
    let rib = |center: Vec2, along: Vec2, width: f32| {
        let along = along.try_normalize().unwrap_or(straight);
        Rib { center, side: along.perp() * width }
    };
    let mut last = Some(rib(from.point, from.handle_out - from.point, from.radius));
    cap(grid, camera, scale, &piece(first, second), 0.0, first.radius);
    for (k, knot) in knots.iter().enumerate().skip(1) {
        let to = FlatKnot::new(camera, knot);
        if occlusion.is_known() && is_hidden(occlusion, scale, &from, &to) {
            (last, from) = (None, to);
            continue;
        }
        occlusion.add(1);
        // After a hidden piece the rib that would have been its last.
        let mut before = last.unwrap_or_else(|| rib(from.point, from.point - from.handle_in, from.radius));
        if k > 1 && from.seems_sharp() && is_sharp([&knots[k - 2], &knots[k - 1], knot]) {
            let leaves = from.handle_out - from.point;
            let leaves = if leaves == Vec2::ZERO { to.point - from.point } else { leaves };
            before = rib(from.point, leaves, from.radius);
            ball(grid, scale, &before);
        }
        let (a, b, c, d) = (from.point, from.handle_out, to.handle_in, to.point);
        // As `Cubic::chords`, of the bend that can be seen.
        let (bend, bend_after) = (a - b * 2.0 + c, b - c * 2.0 + d);
        let squared = bend.length_squared().max(bend_after.length_squared());
        // Most are nearly straight, which is known without a square root.
        let chords = if squared < STRAIGHT {
            1.0
        } else {
            (0.75 / TOLERANCE as f32 * squared.sqrt()).sqrt().ceil().clamp(1.0, 1024.0)
        };
        let mut step = 1.0;
        while step < chords {
            let t = step / chords;
            let s = 1.0 - t;
            let (ab, bc, cd) = (a * s + b * t, b * s + c * t, c * s + d * t);
            let (abc, bcd) = (ab * s + bc * t, bc * s + cd * t);
            let next = rib(abc * s + bcd * t, bcd - abc, from.radius + (to.radius - from.radius) * t);
            quad(grid, scale, &before, &next);
            before = next;
            step += 1.0;
        }
        let next = rib(d, d - c, to.radius);
        quad(grid, scale, &before, &next);
        (last, from) = (Some(next), to);
    }
    let [.., before, tip] = knots else { return };
    cap(grid, camera, scale, &piece(before, tip), 1.0, tip.radius);
}

/// Whether the piece between two knots is known to be hidden. It lies in the box of its control points, grown by its
/// radius.
fn is_hidden(occlusion: &Occlusion, scale: Vec2, from: &FlatKnot, to: &FlatKnot) -> bool {
    let (a, b, c, d) = (from.point, from.handle_out, to.handle_in, to.point);
    let reach = from.radius.max(to.radius);
    let low = (a.min(b).min(c.min(d)) - reach) * scale;
    let high = (a.max(b).max(c.max(d)) + reach) * scale;
    occlusion.hides([low.x, high.x], [low.y, high.y], 1.0 / scale.y)
}
