//! Stems as closed tubes: a Bézier spline bevelled by its radius (Hewitt 2017, Figure 2.1).
//!
//! Rings of corners stand along the spline, close enough for a tolerance in metres; their frames are
//! carried along without twist; faces join neighbouring rings. The base is closed by a flat cap
//! inside the parent (or below a trunk), the tip by a point or a low dome. Where a stem turns sharply it is
//! several tubes, each but the last closed by half a ball. A polygon's corners stand a
//! little outside the model's circle, so that the mean width of the tube, and so its ink in a
//! silhouette, is the model's. Where a branch leaves the side of its parent it is wider, see [`collar`].

mod collar;
mod frame;
mod path;
mod rings;
#[cfg(test)]
#[path = "tests.rs"]
mod shape_tests;
mod unroll;

pub(crate) use frame::{perpendicular, transport};
pub(crate) use path::Path;
pub(crate) use rings::Rings;
pub use unroll::TILE;
pub(crate) use unroll::unroll;

use crate::block::{Block, Vertex};
use crate::part::Count;
use crate::settings::MeshSettings;
use glam::{DVec3, Vec2, Vec3, vec2};
use path::Ring;
use pleach_plant::trig::sin_cos;
use rings::{End, Run};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A regular polygon that stands for a circle.
#[derive(Clone, Debug)]
struct Polygon {
    /// Directions of the corners, the first again at the end.
    corners: Vec<(f64, f64)>,
    /// Corners stand at this times the radius.
    reach: f64,
}

impl Polygon {
    /// Appends the corners of `ring`; `slope` is by how much the radius grows per metre there.
    fn push(&self, ring: &Ring, slope: f64, bark: &Bark, corners: &mut Corners<'_>) {
        let (x, y) = (ring.side, ring.tangent.cross(ring.side));
        let radius = ring.radius * self.reach;
        let level = 1.0 / (1.0 + slope * slope).sqrt();
        let n = self.corners.len() - 1;
        for (j, &(cos, sin)) in self.corners.iter().enumerate() {
            let out = x * cos + y * sin;
            let normal = (out - ring.tangent * slope) * level;
            let vertex = Vertex {
                position: (ring.center + out * radius).as_vec3(),
                normal: normal.as_vec3(),
                uv: bark.uv(j as f64 / n as f64, ring.tiles),
            };
            corners.push(vertex, ring.along, ring.center);
        }
    }
}

/// Where a stem is on its bark's picture.
#[derive(Clone, Copy, Debug)]
struct Bark {
    /// Tiles around it.
    around: f64,
    /// Tiles before its base.
    before: f64,
}

impl Bark {
    /// The texture coordinates after this part of a turn, so many tiles from the base: a picture stands upright, its
    /// v from top to bottom.
    fn uv(&self, turn: f64, tiles: f64) -> Vec2 {
        vec2((turn * self.around) as f32, -(self.before + tiles) as f32)
    }
}

/// The place of a stem's axis around which a corner is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spot {
    /// Metres from the base of the stem.
    pub(crate) along: f32,
    pub(crate) center: Vec3,
}

/// Takes the corners of tubes, and where on its stem each is.
struct Corners<'a> {
    vertices: &'a mut Vec<Vertex>,
    spots: &'a mut Vec<Spot>,
}

impl Corners<'_> {
    fn push(&mut self, vertex: Vertex, along: f64, center: DVec3) {
        self.vertices.push(vertex);
        self.spots.push(Spot { along: along as f32, center: center.as_vec3() });
    }
}

/// Builds tubes after fixed settings.
#[derive(Clone, Debug)]
pub(crate) struct Tubes {
    settings: MeshSettings,
    polygons: Vec<Polygon>,
}

impl Tubes {
    pub(crate) fn new(settings: MeshSettings) -> Self {
        let polygon = |n: u32| {
            let corner = |j: u32| {
                let (sin, cos) = sin_cos(TAU * f64::from(j % n) / f64::from(n));
                (cos, sin)
            };
            Polygon { corners: (0..=n).map(corner).collect(), reach: reach(n) }
        };
        Self { settings, polygons: (0..=settings.max_sides).map(|n| polygon(n.max(3))).collect() }
    }

    pub(crate) const fn tolerance(&self) -> f64 {
        self.settings.tolerance
    }

    /// How many sides these rings get: by their widest.
    fn sides(&self, rings: &Rings) -> u32 {
        let sides = sides(rings.widest(), self.settings.tolerance);
        sides.clamp(self.settings.min_sides, self.settings.max_sides)
    }

    /// The rings of `n` sides between the last ring of a run and the vertex that closes it.
    fn cap(&self, run: &Run<'_>, n: u32) -> u32 {
        let Some(tip) = run.rings.last() else { return 0 };
        let is_wide = tip.radius > 2.0 * self.settings.tolerance;
        match run.end {
            End::Point => 0,
            End::Dome => u32::from(is_wide),
            // As many around a quarter of the ball as around a quarter of the stem.
            End::Ball => {
                if is_wide {
                    n.div_ceil(4).max(2) - 1
                } else {
                    0
                }
            }
        }
    }

    /// How many rings of `n` sides a run has.
    fn wide(&self, run: &Run<'_>, n: u32) -> u32 {
        run.rings.len() as u32 - u32::from(run.end == End::Point) + self.cap(run, n)
    }

    /// Size of the tubes over `rings`.
    pub(crate) fn count(&self, rings: &Rings) -> Count {
        let n = self.sides(rings);
        let mut count = Count::default();
        for run in rings.runs() {
            let (n, wide) = (u64::from(n), u64::from(self.wide(&run, n)));
            let triangles = (wide - 1) * 2 * n + n + (n - 2);
            count += Count { vertices: wide * (n + 1) + 1, triangles };
        }
        count
    }

    /// Appends the tubes over `rings`; their corners count from `base`, and `before` texture tiles are below them.
    /// `spots` become where on the stem each corner is.
    pub(crate) fn push(
        &self,
        rings: &Rings,
        base: u32,
        before: f64,
        block: &mut Block,
        spots: &mut Vec<Spot>,
    ) {
        let n = self.sides(rings);
        let bark = Bark { around: f64::from(rings.tiles_around()), before };
        spots.clear();
        for run in rings.runs() {
            let first = base + spots.len() as u32;
            self.push_run(&run, n, &bark, &mut Corners { vertices: &mut block.vertices, spots });
            faces(first, n, self.wide(&run, n), &mut block.triangles);
        }
    }

    /// Appends the vertices of one tube.
    fn push_run(&self, run: &Run<'_>, n: u32, bark: &Bark, corners: &mut Corners<'_>) {
        let Some(tip) = run.rings.last() else { return };
        let polygon = &self.polygons[n as usize];
        let body = run.rings.len() - usize::from(run.end == End::Point);
        for (i, r) in run.rings[..body].iter().enumerate() {
            polygon.push(r, run.slope(i), bark, corners);
        }
        // The end is half an ellipsoid: its height, in radii.
        let height = match run.end {
            End::Point => 0.0,
            End::Dome => 0.5,
            End::Ball => 1.0,
        };
        let between = self.cap(run, n);
        for i in 1..=between {
            let (sin, cos) = sin_cos(FRAC_PI_2 * f64::from(i) / f64::from(between + 1));
            let ahead = tip.radius * height * sin;
            let ring = Ring {
                center: tip.center + tip.tangent * ahead,
                radius: tip.radius * cos,
                along: tip.along + ahead,
                tiles: tip.tiles + ahead * bark.around / (TAU * tip.radius),
                ..*tip
            };
            polygon.push(&ring, -sin / (cos * height), bark, corners);
        }
        let ahead = tip.radius * height;
        let tiles = if ahead > 0.0 { tip.tiles + height * bark.around / TAU } else { tip.tiles };
        let point = tip.center + tip.tangent * ahead;
        let vertex =
            Vertex { position: point.as_vec3(), normal: tip.tangent.as_vec3(), uv: bark.uv(0.5, tiles) };
        corners.push(vertex, tip.along + ahead, point);
    }
}

/// Joins `wide` rings of `n` sides, closes the base with a fan and the tip with the corner after them.
fn faces(base: u32, n: u32, wide: u32, triangles: &mut Vec<[u32; 3]>) {
    let corner = |ring: u32, j: u32| base + ring * (n + 1) + j;
    for j in 1..n - 1 {
        triangles.push([corner(0, 0), corner(0, j + 1), corner(0, j)]);
    }
    for ring in 0..wide - 1 {
        for j in 0..n {
            let (a, b) = (corner(ring, j), corner(ring, j + 1));
            let (c, d) = (corner(ring + 1, j + 1), corner(ring + 1, j));
            triangles.push([a, b, c]);
            triangles.push([a, c, d]);
        }
    }
    let apex = corner(wide, 0);
    for j in 0..n {
        triangles.push([corner(wide - 1, j), corner(wide - 1, j + 1), apex]);
    }
}

/// The corners of a regular polygon with `n` sides stand at this times the radius of the circle of
/// the same mean width (Cauchy: the mean width of a convex figure is its perimeter over π).
fn reach(n: u32) -> f64 {
    let half = PI / f64::from(n);
    half / sin_cos(half).0
}

/// Fewest sides for which the middles of a polygon's edges stray at most `tolerance` metres from a
/// circle of `radius` metres; 3 or more.
///
/// The corners stray less. With x = π/n the stray is radius·(1 − x/tan x), and x/tan x ≥ 1 − x²/3 − x⁴/30
/// to the order that matters here, so this solves a square root and looks at the neighbour.
pub(crate) fn sides(radius: f64, tolerance: f64) -> u32 {
    let stray = |n: u32| {
        let half = PI / f64::from(n);
        let (sin, cos) = sin_cos(half);
        radius * (1.0 - half * cos / sin)
    };
    let guess = PI * (radius / (3.0 * tolerance)).max(0.0).sqrt();
    let mut n = (guess.min(1e4) as u32).max(3);
    while n < 10_000 && stray(n) > tolerance {
        n += 1;
    }
    n
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides_are_the_fewest_that_keep_the_tolerance() {
        for radius in [0.001, 0.01, 0.05, 0.4, 2.0] {
            for tolerance in [0.0001, 0.001, 0.01, 0.1] {
                let n = sides(radius, tolerance);
                let stray = |n: u32| radius * (1.0 - reach(n) * (PI / f64::from(n)).cos());
                assert!(stray(n) <= tolerance + 1e-12, "{radius} {tolerance}: {n}");
                assert!(n == 3 || stray(n - 1) > tolerance, "{radius} {tolerance}: {n} is one too many");
                assert!(radius * (reach(n) - 1.0) <= tolerance.max(0.21 * radius), "corners stray less");
            }
        }
    }

    #[test]
    fn polygons_keep_the_mean_width_of_the_circle() {
        for n in 3..20 {
            let corner = |j: u32| {
                let a = TAU * f64::from(j) / f64::from(n);
                (reach(n) * a.cos(), reach(n) * a.sin())
            };
            let width = |turn: f64| {
                let across = (0..n).map(|j| corner(j).0 * turn.cos() + corner(j).1 * turn.sin());
                let (low, high) = across.fold((0.0_f64, 0.0_f64), |(l, h), x| (l.min(x), h.max(x)));
                high - low
            };
            let mean = (0..3600).map(|i| width(f64::from(i) * TAU / 3600.0)).sum::<f64>() / 3600.0;
            assert!((mean - 2.0).abs() < 1e-4, "{n}: {mean}");
        }
    }
}
