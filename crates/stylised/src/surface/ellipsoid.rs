//! How far a point is from ellipsoids that flow into each other.

use glam::{DMat3, DVec3};

/// An ellipsoid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ellipsoid {
    pub(crate) center: DVec3,
    /// Half axes, positive.
    radii: DVec3,
    /// Into the axes' frame.
    turn: DMat3,
}

impl Ellipsoid {
    /// The ellipsoid with half axes of `radii` along the columns of the rotation `axes`.
    pub(crate) fn new(center: DVec3, radii: DVec3, axes: DMat3) -> Self {
        Self { center, radii, turn: axes.transpose() }
    }

    /// About how far `p` is from the surface, negative inside. The sign is exact.
    fn distance(&self, p: DVec3) -> f64 {
        let local = self.turn * (p - self.center) / self.radii;
        let level = local.length();
        let slope = (local / self.radii).length();
        // In the middle the slope is 0: the nearest surface is at the end of the shortest axis.
        if slope > 1e-9 { level * (level - 1.0) / slope } else { -self.radii.min_element() }
    }
}

/// Ellipsoids with the width of the fillet between them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Union<'a> {
    /// At least one.
    pub(crate) parts: &'a [Ellipsoid],
    /// Where two distances differ by less than this, their union is rounded; positive.
    pub(crate) fillet: f64,
}

impl Union<'_> {
    /// About how far `p` is from the surface, negative inside.
    pub(crate) fn distance(&self, p: DVec3) -> f64 {
        self.parts.iter().fold(f64::INFINITY, |least, part| self.joined(least, part.distance(p)))
    }

    /// The smooth minimum: the lesser of both, less up to a quarter of the fillet where they are alike.
    fn joined(&self, a: f64, b: f64) -> f64 {
        let near = (self.fillet - (a - b).abs()).max(0.0) / self.fillet;
        a.min(b) - near * near * self.fillet / 4.0
    }

    /// Towards greater distance at `p`, of length 1 or 0.
    pub(crate) fn outwards(&self, p: DVec3, step: f64) -> DVec3 {
        let slope = |axis: DVec3| self.distance(p + axis * step) - self.distance(p - axis * step);
        DVec3::new(slope(DVec3::X), slope(DVec3::Y), slope(DVec3::Z)).normalize_or_zero()
    }

    /// Smallest and largest coordinates of what may be inside.
    pub(crate) fn bounds(&self) -> (DVec3, DVec3) {
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = self.parts.iter().fold(start, |(low, high), part| {
            let reach = DVec3::splat(part.radii.max_element());
            (low.min(part.center - reach), high.max(part.center + reach))
        });
        // Every join moves the surface outwards by a quarter of the fillet at most.
        let margin = self.fillet * self.parts.len() as f64 / 4.0;
        (low - margin, high + margin)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    #[test]
    fn the_surface_of_an_ellipsoid_is_where_its_axes_end() {
        let axes = DMat3::from_rotation_z(0.7);
        let ellipsoid = Ellipsoid::new(dvec3(1.0, 2.0, 3.0), dvec3(0.5, 1.0, 2.0), axes);
        for (axis, radius) in [(axes.x_axis, 0.5), (axes.y_axis, 1.0), (axes.z_axis, 2.0)] {
            let at = |t: f64| ellipsoid.distance(ellipsoid.center + axis * radius * t);
            assert!(at(1.0).abs() < 1e-12 && at(0.9) < 0.0 && at(1.1) > 0.0);
        }
        assert_eq!(ellipsoid.distance(ellipsoid.center), -0.5);
    }

    #[test]
    fn a_union_is_rounded_only_where_both_are_near() {
        let ball = |x: f64| Ellipsoid::new(dvec3(x, 0.0, 0.0), DVec3::ONE, DMat3::IDENTITY);
        let parts = [ball(-0.8), ball(0.8)];
        let union = Union { parts: &parts, fillet: 0.2 };
        let seam = dvec3(0.0, 0.0, 0.6);
        assert!((parts[0].distance(seam)).abs() < 1e-12);
        assert!((union.distance(seam) + 0.05).abs() < 1e-12, "a quarter of the fillet");
        let far = dvec3(-1.8, 0.0, 0.0);
        assert!(union.distance(far).abs() < 1e-12);
        assert!((union.outwards(far, 1e-4) - DVec3::NEG_X).length() < 1e-6);
    }
}
