//! Crowns of fronds: palms, which the report leaves to future work.

use super::{RADIUS, Surface};
use crate::draws::FOLIAGE;
use crate::params::{Id, Numbers};
use crate::skeleton::Skeleton;
use crate::write::{Budget, Writer};
use glam::{DVec3, dvec3};
use pleach_tree::trig::sin_cos;
use pleach_tree::{GrowError, Key};
use std::f64::consts::{PI, TAU};

/// Rings of a frond at each level of detail.
const RINGS: [u32; 4] = [3, 6, 10, 16];
/// Length of a frond, over the radius of a blob.
const LENGTH: f64 = 2.6;
/// Half width in the middle, over the length.
const WIDTH: f64 = 0.11;
/// Degrees above level in which the youngest and the oldest frond start.
const ELEVATIONS: (f64, f64) = (65.0, -5.0);
/// Fronds of a crown: at the start of the slider and at its end.
const COUNTS: (f64, f64) = (5.0, 15.0);

/// What draws of a frond are for.
mod purpose {
    pub(super) const AZIMUTH: u32 = 0;
    pub(super) const LENGTH: u32 = 1;
    pub(super) const ELEVATION: u32 = 2;
}

/// Most fronds of a crown: by how much the addresses of two crowns differ.
const STRIDE: u32 = 16;

pub(super) fn grow(
    surface: &mut Surface,
    numbers: &Numbers,
    skeleton: &Skeleton,
    key: Key,
    budget: &mut Budget,
    writer: &mut Writer<'_>,
) -> Result<(), GrowError> {
    let (few, many) = COUNTS;
    let count = (few + (many - few) * numbers.leaves_quantity / 100.0).round() as u32;
    let rings = RINGS[numbers.subdivision.min(3) as usize];
    for trunk in 0..skeleton.trunk_count {
        let path = skeleton.trunk(trunk);
        let top = path.at(path.length()).point;
        for i in 0..count {
            let key = skeleton.key_on(trunk, key.child(FOLIAGE, STRIDE * trunk + i));
            let loose = |purpose: u32| numbers.leaves_randomness * key.signed(purpose, 0);
            let age = f64::from(i) / f64::from(count - 1);
            let frond = Frond {
                base: top,
                azimuth: f64::from(i) * (137.5 / 360.0) + 0.06 * loose(purpose::AZIMUTH),
                elevation: ELEVATIONS.0
                    + (ELEVATIONS.1 - ELEVATIONS.0) * age
                    + 12.0 * loose(purpose::ELEVATION),
                length: LENGTH * RADIUS * numbers.leaves_size * (1.0 + 0.25 * loose(purpose::LENGTH)),
                droop: 0.45 - 0.35 * numbers.tropism,
            };
            budget.spend(4 * u64::from(rings), Id::leaves_quantity)?;
            frond.build(rings, surface);
            writer.blob(trunk, &surface.vertices, &surface.triangles)?;
        }
    }
    Ok(())
}

/// A blade folded along its middle, which arches over.
struct Frond {
    base: DVec3,
    /// Part of a turn.
    azimuth: f64,
    /// Degrees above level at its base.
    elevation: f64,
    length: f64,
    /// How far the tip hangs below the straight line, over the length.
    droop: f64,
}

impl Frond {
    /// The middle so far along, from 0 to 1.
    fn middle(&self, t: f64) -> DVec3 {
        let (sin_a, cos_a) = sin_cos(TAU * self.azimuth);
        let (sin_e, cos_e) = sin_cos(self.elevation.to_radians());
        let along = dvec3(cos_e * cos_a, cos_e * sin_a, sin_e);
        let point = self.base + (along * t - DVec3::Z * (self.droop * t * t)) * self.length;
        // A tip that hangs to the ground lies on it.
        point.with_z(point.z.max(WIDTH * self.length))
    }

    fn build(&self, rings: u32, surface: &mut Surface) {
        surface.clear();
        let (sin_a, cos_a) = sin_cos(TAU * self.azimuth);
        let side = dvec3(-sin_a, cos_a, 0.0);
        for ring in 1..=rings {
            let t = f64::from(ring) / f64::from(rings + 1);
            let ahead = (self.middle(t + 0.02) - self.middle(t - 0.02)).normalize_or(DVec3::X);
            let up = ahead.cross(side);
            // Widest before the middle, pointed at both ends.
            let half = WIDTH * self.length * sin_cos(PI * t.sqrt()).0.max(0.05);
            let middle = self.middle(t);
            // Around the direction of growth: one edge, the underside, the other edge, the ridge.
            let corners = [(1.0, -0.3), (0.0, 0.2), (-1.0, -0.3), (0.0, -0.15)];
            surface.vertices.extend(corners.map(|(x, y)| middle + (side * x + up * y) * half));
        }
        surface.vertices.extend([self.middle(0.0), self.middle(1.0)]);
        surface.close_rings(rings, 4);
    }
}
