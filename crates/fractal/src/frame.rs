//! Where a branch points, and the plane from which its daughters' azimuths are counted.
//!
//! Coffey 2025, Appendix, builds a branch RS from three points: PQ and QR are the two branches before it,
//! and its azimuth is counted from the plane PQR, which does not exist where the three are in line.
//! The same rule on two carried axes has no such case: `along` is the direction of QR, and `across` is
//! at right angles to it in that plane. A new branch's own axes follow from the angles without any
//! division. The trees are the same.

use glam::DVec3;
use pleach_tree::trig::sin_cos;

/// A branch's direction and the direction from which azimuths of its daughters are counted; both of
/// length 1, at right angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// From the branch's foot to its tip.
    pub along: DVec3,
    /// Azimuth 0: in the plane of the branch and its parent, on the parent's side.
    pub across: DVec3,
}

/// An angle as its sine and cosine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Angle {
    /// Its sine.
    pub sin: f64,
    /// Its cosine.
    pub cos: f64,
}

impl Angle {
    /// An angle in radians.
    #[must_use]
    pub fn new(radians: f64) -> Self {
        let (sin, cos) = sin_cos(radians);
        Self { sin, cos }
    }
}

impl Frame {
    /// A trunk: upwards, azimuth 0 to the east (+x).
    pub const TRUNK: Self = Self { along: DVec3::Z, across: DVec3::X };

    /// The frame of two axes that are of length 1 but for rounding.
    fn new(along: DVec3, across: DVec3) -> Self {
        // Newton's step towards length 1. Without it errors double with each generation, since the third
        // axis is a product of the two.
        let unit = |axis: DVec3| axis * (1.5 - 0.5 * axis.dot(axis));
        Self { along: unit(along), across: unit(across) }
    }

    /// The third axis. Seen from the branch's foot to its tip, azimuths run clockwise from
    /// [`Frame::across`] to it.
    #[must_use]
    pub fn side(&self) -> DVec3 {
        self.along.cross(self.across)
    }

    /// The direction at right angles to the branch that has this azimuth.
    fn at(&self, azimuth: Angle) -> DVec3 {
        self.across * azimuth.cos + self.side() * azimuth.sin
    }

    /// The frame of a branch that leaves this one at the angle `polar` and at `azimuth`.
    #[must_use]
    pub fn branch(&self, polar: Angle, azimuth: Angle) -> Self {
        let out = self.at(azimuth);
        Self::new(self.along * polar.cos + out * polar.sin, self.along * polar.sin - out * polar.cos)
    }

    /// The same direction with azimuths counted from `azimuth` on: the leader's frame at a node, so
    /// that whorls advance.
    #[must_use]
    pub fn turned(&self, azimuth: Angle) -> Self {
        Self::new(self.along, self.at(azimuth))
    }

    /// The frame leaning by `lean` towards `azimuth`, carried along with the rotation that takes the old
    /// direction to the new one, so that a small lean does not spin what grows on the branch.
    #[must_use]
    pub fn leaning(&self, lean: Angle, azimuth: Angle) -> Self {
        let towards = self.at(azimuth);
        let still = self.along.cross(towards);
        let level = towards * lean.cos - self.along * lean.sin;
        Self::new(self.along * lean.cos + towards * lean.sin, level * azimuth.cos - still * azimuth.sin)
    }

    /// The frame turned by `angle` towards [`Frame::across`], within the plane of the two axes: a branch
    /// of a tree in the plane, where the right stays the right.
    #[must_use]
    pub fn in_plane(&self, angle: Angle) -> Self {
        Self::new(
            self.along * angle.cos + self.across * angle.sin,
            self.across * angle.cos - self.along * angle.sin,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    fn degrees(angle: f64) -> Angle {
        Angle::new(angle.to_radians())
    }

    fn is_near(a: DVec3, b: DVec3) -> bool {
        (a - b).length() < 1e-6
    }

    /// The frame of the Appendix's example: P, Q and R are given.
    fn example() -> (DVec3, Frame) {
        let (p, q, r) = (dvec3(1.0, 0.0, 2.0), dvec3(1.5, 0.0, 2.4), dvec3(1.7, 0.3, 2.6));
        let (before, last) = (q - p, r - q);
        let along = last.normalize();
        let across = (before - along * before.dot(along)).normalize();
        (r, Frame { along, across })
    }

    #[test]
    fn the_worked_example_of_the_appendix() {
        let (r, frame) = example();
        assert!(is_near(frame.along, dvec3(0.485_071, 0.727_607, 0.485_071)));
        assert!(is_near(frame.across, dvec3(0.615_343, -0.678_133, 0.401_857)));
        assert!(is_near(frame.side(), dvec3(0.621_336, 0.103_556, -0.776_671)));
        let branch = frame.branch(degrees(30.0), degrees(50.0));
        let length = 0.8 * dvec3(0.2, 0.3, 0.2).length();
        assert!(is_near(r + branch.along * length, dvec3(1.982_297, 0.449_040, 2.683_041)));
        assert!(is_near(branch.across, dvec3(-0.512_211, 0.672_599, 0.534_088)));
    }

    #[test]
    fn azimuth_0_bends_back_and_180_bends_on() {
        let (_, frame) = example();
        let before = dvec3(0.5, 0.0, 0.4).normalize();
        for (azimuth, expected) in
            [(0.0, 17.015_646), (50.0, 34.353_949), (90.0, 53.810_702), (180.0, 77.015_646)]
        {
            let branch = frame.branch(degrees(30.0), degrees(azimuth));
            let angle = branch.along.dot(before).acos().to_degrees();
            assert!((angle - expected).abs() < 1e-4, "{azimuth}: {angle}");
        }
    }

    #[test]
    fn axes_stay_at_right_angles_wherever_a_branch_points() {
        for polar in [0.0, 1e-9, 35.0, 90.0, 180.0] {
            let mut frame = Frame::TRUNK;
            for step in 0..60 {
                let azimuth = degrees(40.0 + f64::from(step));
                frame = match step % 4 {
                    0 => frame.turned(azimuth),
                    1 => frame.leaning(degrees(polar), azimuth),
                    2 => frame.in_plane(degrees(polar)),
                    _ => frame.branch(degrees(polar), azimuth),
                };
                assert!((frame.along.length() - 1.0).abs() < 1e-9, "{polar}: {frame:?}");
                assert!((frame.across.length() - 1.0).abs() < 1e-9, "{polar}: {frame:?}");
                assert!(frame.along.dot(frame.across).abs() < 1e-9, "{polar}: {frame:?}");
            }
        }
    }

    #[test]
    fn a_small_lean_hardly_moves_the_axes() {
        let (_, frame) = example();
        for azimuth in [0.0, 70.0, 200.0] {
            let leaning = frame.leaning(degrees(0.01), degrees(azimuth));
            assert!((leaning.along - frame.along).length() < 2e-4);
            assert!((leaning.across - frame.across).length() < 2e-4);
            assert!((leaning.side() - frame.side()).length() < 2e-4);
        }
    }

    #[test]
    fn in_the_plane_the_right_stays_the_right() {
        let right = Frame::TRUNK.in_plane(degrees(30.0)).in_plane(degrees(30.0));
        assert!(is_near(right.along, dvec3(60_f64.to_radians().sin(), 0.0, 0.5)));
    }
}
