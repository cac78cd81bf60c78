//! One convex or turned piece of a volume, in its own frame.

use super::outline::Outline;
use glam::{DVec3, dvec3};
use pleach_tree::math;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// A solid in its own frame: z is its axis.
#[derive(Clone, Debug)]
pub(crate) enum Solid {
    /// From the origin upwards.
    Cylinder { radius: f64, height: f64 },
    /// All points of a ball around the origin within an angle of the axis, given by its cosine.
    Portion { radius: f64, cos: f64 },
    /// A flat base around the origin, the apex above it.
    Cone { radius: f64, height: f64 },
    /// Around the origin, by its half axes.
    Ellipsoid { across: f64, along: f64 },
    /// A drawn outline around the axis, from the origin upwards.
    Turned { outline: Arc<Outline>, radius: f64, height: f64 },
}

impl Solid {
    /// Its content in cubic meters.
    pub(crate) fn content(&self) -> f64 {
        match self {
            Self::Cylinder { radius, height } => PI * radius * radius * height,
            Self::Portion { radius, cos } => TAU / 3.0 * math::powi(*radius, 3) * (1.0 - cos),
            Self::Cone { radius, height } => PI / 3.0 * radius * radius * height,
            Self::Ellipsoid { across, along } => 2.0 * TAU / 3.0 * across * across * along,
            Self::Turned { outline, radius, height } => outline.content() * radius * radius * height,
        }
    }

    /// The point that three uniform numbers stand for, so that equal parts of them are equal parts of
    /// the solid; `None` where they miss it.
    pub(crate) fn point(&self, [u, v, w]: [f64; 3]) -> Option<DVec3> {
        let around = |radius: f64, z: f64| {
            let (sin, cos) = pleach_tree::trig::sin_cos(TAU * v);
            dvec3(radius * cos, radius * sin, z)
        };
        Some(match self {
            Self::Cylinder { radius, height } => around(radius * w.sqrt(), height * u),
            Self::Portion { radius, cos } => {
                let along = 1.0 - u * (1.0 - cos);
                let across = (1.0 - along * along).max(0.0).sqrt();
                around(across, along) * (radius * math::cbrt(w))
            }
            Self::Cone { radius, height } => {
                let left = math::cbrt(u);
                around(radius * left * w.sqrt(), height * (1.0 - left))
            }
            Self::Ellipsoid { across, along } => {
                let z = 1.0 - 2.0 * u;
                let ball = around((1.0 - z * z).max(0.0).sqrt(), z) * math::cbrt(w);
                ball * dvec3(*across, *across, *along)
            }
            Self::Turned { outline, radius, height } => {
                let unit = around(outline.widest() * w.sqrt(), u);
                if !outline.holds(unit) {
                    return None;
                }
                unit * dvec3(*radius, *radius, *height)
            }
        })
    }

    /// Whether `p` is inside.
    pub(crate) fn holds(&self, p: DVec3) -> bool {
        let across = p.truncate().length_squared();
        match self {
            Self::Cylinder { radius, height } => (0.0..=*height).contains(&p.z) && across <= radius * radius,
            Self::Portion { radius, cos } => {
                let far = p.length_squared();
                far <= radius * radius && p.z >= far.sqrt() * cos
            }
            Self::Cone { radius, height } => {
                (0.0..=*height).contains(&p.z) && across.sqrt() <= radius * (1.0 - p.z / height)
            }
            Self::Ellipsoid { across: r, along } => across / (r * r) + math::powi(p.z / along, 2) <= 1.0,
            Self::Turned { outline, radius, height } => outline.holds(p / dvec3(*radius, *radius, *height)),
        }
    }

    /// Whether `p`, inside, is in the shell whose thickness over the solid's radius is `shell`. Flat
    /// undersides have none.
    pub(crate) fn in_shell(&self, p: DVec3, shell: f64) -> bool {
        let least = 1.0 - shell;
        let across = p.truncate().length();
        match self {
            Self::Cylinder { radius, .. } => across >= radius * least,
            Self::Portion { radius, .. } => p.length() >= radius * least,
            Self::Cone { radius, height } => {
                // Distance to the mantle.
                let slant = math::hypot(*radius, *height);
                (radius * (height - p.z) - across * height) / slant <= shell * radius
            }
            Self::Ellipsoid { across: r, along } => {
                (p / dvec3(*r, *r, *along)).length_squared() >= least * least
            }
            Self::Turned { outline, radius, height } => {
                let unit = p / dvec3(*radius, *radius, *height);
                unit.z >= 1.0 - shell / 2.0 || across / radius >= least * outline.radius(unit)
            }
        }
    }

    /// Two opposite corners of a box that holds it.
    pub(crate) fn bounds(&self) -> (DVec3, DVec3) {
        let around = |r: f64, low: f64, high: f64| (dvec3(-r, -r, low), dvec3(r, r, high));
        match self {
            Self::Cylinder { radius, height } | Self::Cone { radius, height } => {
                around(*radius, 0.0, *height)
            }
            Self::Portion { radius, cos } => {
                let across = if *cos > 0.0 { (1.0 - cos * cos).max(0.0).sqrt() } else { 1.0 };
                around(radius * across, radius * cos.min(0.0), *radius)
            }
            Self::Ellipsoid { across, along } => around(*across, -along, *along),
            Self::Turned { outline, radius, height } => around(radius * outline.widest(), 0.0, *height),
        }
    }

    /// How far it reaches along its axis.
    pub(crate) fn top(&self) -> f64 {
        self.bounds().1.z
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pleach_tree::Key;

    fn solids() -> Vec<Solid> {
        let outline = Arc::new(Outline::of_radii(&[0.2, 1.0, 0.5, 0.0]));
        vec![
            Solid::Cylinder { radius: 0.5, height: 2.0 },
            Solid::Portion { radius: 2.0, cos: (0.3 * PI).cos() },
            Solid::Portion { radius: 1.0, cos: (0.7 * PI).cos() },
            Solid::Cone { radius: 1.0, height: 3.0 },
            Solid::Ellipsoid { across: 1.0, along: 2.0 },
            Solid::Turned { outline, radius: 1.5, height: 2.0 },
        ]
    }

    #[test]
    fn contents_are_what_darts_in_the_box_find() {
        let n = 40_000;
        for solid in solids() {
            let (low, high) = solid.bounds();
            let size = high - low;
            let hits = (0..n).filter(|&i| {
                let key = Key::root(5);
                let at = dvec3(key.unit(0, i), key.unit(1, i), key.unit(2, i));
                solid.holds(low + at * size)
            });
            let found = hits.count() as f64 / f64::from(n) * size.x * size.y * size.z;
            assert!((found / solid.content() - 1.0).abs() < 0.03, "{solid:?}: {found}, {}", solid.content());
        }
    }

    #[test]
    fn parts_of_the_ball_have_the_published_contents() {
        let table = [(0.25, 0.146_447), (0.3, 0.206_107), (0.4, 0.345_492), (0.5, 0.5), (0.7, 0.793_893)];
        for (alpha, fraction) in table {
            let part = Solid::Portion { radius: 3.0, cos: f64::cos(alpha * PI) }.content();
            let ball = Solid::Portion { radius: 3.0, cos: -1.0 }.content();
            assert!((part / ball - fraction).abs() < 1e-6, "{alpha}");
        }
    }

    #[test]
    fn points_fill_their_solid_evenly() {
        for solid in solids() {
            // Of points spread over the solid, as many are in its lower half as of darts in the box.
            let middle = solid.top() / 2.0;
            let key = Key::root(6);
            let n = 20_000;
            let thrown = (0..n).filter_map(|i| solid.point([key.unit(0, i), key.unit(1, i), key.unit(2, i)]));
            let thrown: Vec<DVec3> = thrown.collect();
            let (low, high) = solid.bounds();
            assert!(thrown.iter().all(|p| solid.holds(*p * (1.0 - 1e-12))), "{solid:?}");
            let boxed =
                (0..n).map(|i| low + dvec3(key.unit(3, i), key.unit(4, i), key.unit(5, i)) * (high - low));
            let boxed: Vec<DVec3> = boxed.filter(|p| solid.holds(*p)).collect();
            let share = |points: &[DVec3]| {
                points.iter().filter(|p| p.z < middle && p.truncate().length() < 0.5).count() as f64
                    / points.len() as f64
            };
            assert!((share(&thrown) - share(&boxed)).abs() < 0.03, "{solid:?}");
        }
    }

    #[test]
    fn shells_hold_the_published_shares() {
        let ball = Solid::Portion { radius: 2.0, cos: 0.0 };
        let key = Key::root(7);
        let points: Vec<DVec3> = (0..20_000)
            .filter_map(|i| ball.point([key.unit(0, i), key.unit(1, i), key.unit(2, i)]))
            .collect();
        for (shell, share, mean) in
            [(0.1, 0.271, 0.951_753), (0.2, 0.488, 0.907_377), (0.5, 0.875, 0.803_571)]
        {
            let inside: Vec<f64> =
                points.iter().filter(|p| ball.in_shell(**p, shell)).map(|p| p.length() / 2.0).collect();
            assert!((inside.len() as f64 / points.len() as f64 - share).abs() < 0.015, "{shell}");
            let found = inside.iter().sum::<f64>() / inside.len() as f64;
            assert!((found - mean).abs() < 5e-3, "{shell}: {found}");
        }
        assert!(points.iter().all(|p| ball.in_shell(*p, 1.0)));
    }
}
