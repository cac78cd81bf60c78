//! Stems as closed tubes: a Bézier spline bevelled by its radius (Hewitt 2017, Figure 2.1).
//!
//! Rings of corners stand along the spline, close enough for a tolerance in metres; their frames are
//! carried along without twist; faces join neighbouring rings. The base is closed by a flat cap
//! inside the parent (or below a trunk), the tip by a point or a low dome. A polygon's corners stand a
//! little outside the model's circle, so that the mean width of the tube, and so its ink in a
//! silhouette, is the model's.

mod frame;
mod rings;
#[cfg(test)]
#[path = "tests.rs"]
mod shape_tests;

pub(crate) use rings::Rings;

use crate::block::{Block, Vertex};
use crate::part::Count;
use crate::settings::MeshSettings;
use glam::{DVec3, vec2};
use pleach_tree::trig::sin_cos;
use std::f64::consts::{PI, TAU};

/// A regular polygon that stands for a circle.
#[derive(Clone, Debug)]
struct Polygon {
    /// Directions of the corners, the first again at the end.
    corners: Vec<(f64, f64)>,
    /// Corners stand at this times the radius.
    reach: f64,
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
        let widest = rings.rings.iter().map(|r| r.radius).fold(0.0, f64::max);
        sides(widest, self.settings.tolerance).clamp(self.settings.min_sides, self.settings.max_sides)
    }

    /// Whether a blunt tip gets a ring of its own below the top of its dome.
    fn domed(&self, rings: &Rings) -> bool {
        rings.rings.last().is_some_and(|tip| tip.radius > 2.0 * self.settings.tolerance)
    }

    /// Size of the tube over `rings`.
    pub(crate) fn count(&self, rings: &Rings) -> Count {
        if rings.rings.is_empty() {
            return Count::default();
        }
        let n = u64::from(self.sides(rings));
        let wide = rings.rings.len() as u64 - u64::from(rings.pointed) + u64::from(self.domed(rings));
        Count { vertices: wide * (n + 1) + 1, triangles: (wide - 1) * 2 * n + n + (n - 2) }
    }

    /// Appends the tube over `rings`; its corners count from `base`, and v starts at `along`.
    pub(crate) fn push(&self, rings: &Rings, base: u32, along: f64, block: &mut Block) {
        let Some(tip) = rings.rings.last().copied() else { return };
        let n = self.sides(rings);
        let polygon = &self.polygons[n as usize];
        let mut wide = 0;
        let mut ring =
            |center: DVec3, (x, y): (DVec3, DVec3), tangent: DVec3, radius: f64, slope: f64, v: f64| {
                let radius = radius * polygon.reach;
                let level = 1.0 / (1.0 + slope * slope).sqrt();
                for (j, &(cos, sin)) in polygon.corners.iter().enumerate() {
                    let out = x * cos + y * sin;
                    let normal = (out - tangent * slope) * level;
                    let u = j as f32 / n as f32;
                    block.vertices.push(Vertex {
                        position: (center + out * radius).as_vec3(),
                        normal: normal.as_vec3(),
                        uv: vec2(u, v as f32),
                    });
                }
                wide += 1;
            };
        let blunt = usize::from(!rings.pointed);
        for (i, r) in rings.rings[..rings.rings.len() - 1 + blunt].iter().enumerate() {
            let axes = (r.side, r.tangent.cross(r.side));
            ring(r.center, axes, r.tangent, r.radius, rings.slope(i), along + r.along);
        }
        let mut top = tip.center;
        if !rings.pointed {
            // A low dome: half an ellipsoid whose height is half the radius.
            let axes = (tip.side, tip.tangent.cross(tip.side));
            let height = tip.radius * 0.5;
            if self.domed(rings) {
                let half = std::f64::consts::FRAC_1_SQRT_2;
                let center = tip.center + tip.tangent * (height * half);
                ring(center, axes, tip.tangent, tip.radius * half, -2.0, along + tip.along + height * half);
            }
            top += tip.tangent * height;
        }
        block.vertices.push(Vertex {
            position: top.as_vec3(),
            normal: tip.tangent.as_vec3(),
            uv: vec2(0.5, (along + tip.along) as f32),
        });
        faces(base, n, wide, &mut block.triangles);
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
