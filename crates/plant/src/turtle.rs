//! A turtle in space: a position, a direction and a right-hand axis.
//!
//! Hewitt 2017, §3.1.2. The third axis, [`Turtle::down`], is the one that a child leaves its parent
//! towards, so for a branch it points away from the parent's tip.

use crate::trig::{atan2, sin_cos};
use glam::DVec3;

/// Position and orientation while a stem is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turtle {
    /// Where it stands, in metres.
    pub position: DVec3,
    /// Unit vector that it walks along.
    pub direction: DVec3,
    /// Unit vector to its right, at right angles to `direction`.
    pub right: DVec3,
}

impl Turtle {
    /// A turtle at the origin that looks up, with +x on its right.
    pub const UP: Self = Self { position: DVec3::ZERO, direction: DVec3::Z, right: DVec3::X };

    /// The axis that positive pitch turns the direction towards: `direction × right`.
    #[must_use]
    #[inline]
    pub fn down(&self) -> DVec3 {
        self.direction.cross(self.right)
    }

    /// Walks `length` metres ahead.
    #[inline]
    pub fn walk(&mut self, length: f64) {
        self.position += self.direction * length;
    }

    /// Leans the direction towards [`Turtle::down`] by `angle` radians.
    #[inline]
    pub fn pitch_down(&mut self, angle: f64) {
        let (sin, cos) = sin_cos(angle);
        self.direction = unit(self.direction * cos + self.down() * sin);
    }

    /// Leans the direction towards `right` by `angle` radians.
    #[inline]
    pub fn turn_right(&mut self, angle: f64) {
        let (sin, cos) = sin_cos(angle);
        let Self { direction, right, .. } = *self;
        self.direction = unit(direction * cos + right * sin);
        self.right = unit(right * cos - direction * sin);
    }

    /// Turns `right` about the direction, towards [`Turtle::down`], by `angle` radians.
    #[inline]
    pub fn roll_right(&mut self, angle: f64) {
        let (sin, cos) = sin_cos(angle);
        self.right = unit(self.right * cos + self.down() * sin);
    }

    /// Turns both axes about the unit vector `axis` by `angle` radians (right-hand rule).
    pub fn rotate_about(&mut self, axis: DVec3, angle: f64) {
        let turn = turn_about(axis, angle);
        self.direction = unit(turn(self.direction));
        self.right = unit(turn(self.right));
    }

    /// Turns both axes towards `pull`, about the axis at right angles to it and to the direction, by `rate` radians
    /// for each unit of `pull` that is at right angles to the direction.
    #[inline]
    pub fn lean(&mut self, pull: DVec3, rate: f64) {
        let axis = self.direction.cross(pull);
        let squared = axis.length_squared();
        let angle_squared = rate * rate * squared;
        // An axis of no length has no direction.
        if squared <= 1e-24 {
            return;
        }
        // sin a / |axis| and (1 − cos a) / |axis|²: for small angles by their series, which want no root and no
        // division.
        let (by_sin, cos, by_cos) = if angle_squared < SMALL_ANGLE * SMALL_ANGLE {
            let u = angle_squared;
            let sin = 1.0
                + u * (-1.0 / 6.0
                    + u * (1.0 / 120.0 + u * (-1.0 / 5040.0 + u * (1.0 / 362_880.0 - u / 39_916_800.0))));
            let versine =
                0.5 + u * (-1.0 / 24.0 + u * (1.0 / 720.0 + u * (-1.0 / 40_320.0 + u / 3_628_800.0)));
            (rate * sin, 1.0 - u * versine, rate * rate * versine)
        } else {
            let length = squared.sqrt();
            let (sin, cos) = sin_cos(rate * length);
            (sin / length, cos, (1.0 - cos) / squared)
        };
        let turn = |v: DVec3| v * cos + axis.cross(v) * by_sin + axis * (axis.dot(v) * by_cos);
        self.direction = unit(turn(self.direction));
        self.right = unit(turn(self.right));
    }

    /// Turns the axes of a leaf outwards from the z axis and then up, each by the part `leaf_bend` of
    /// what is missing (Weber and Penn 1995, §4.9). Outwards goes the shorter way round.
    pub fn face_the_light(&mut self, leaf_bend: f64) {
        let (p, n) = (self.position, self.down());
        let outwards = atan2(n.x * p.y - n.y * p.x, n.x * p.x + n.y * p.y);
        let (sin, cos) = sin_cos(leaf_bend * outwards);
        let about_z = |v: DVec3| DVec3::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos, v.z);
        let (direction, right, n) = (about_z(self.direction), about_z(self.right), about_z(n));

        // Up is a turn from the normal towards +z, about the level axis at right angles to both.
        let level = (n.x * n.x + n.y * n.y).sqrt();
        if level < 1e-9 {
            (self.direction, self.right) = (direction, right);
            return;
        }
        let axis = DVec3::new(n.y / level, -n.x / level, 0.0);
        let (sin, cos) = sin_cos(leaf_bend * atan2(level, n.z));
        let lift = |v: DVec3| v * cos + axis.cross(v) * sin + axis * (axis.dot(v) * (1.0 - cos));
        (self.direction, self.right) = (lift(direction), lift(right));
    }
}

/// Radians up to which a turn's series are exact to the last bits.
const SMALL_ANGLE: f64 = 0.5;

/// `v` at length 1, if it is nearly that long already: one step of Newton's method, without a root or a division.
/// Turns keep lengths but for rounding, which is all that is taken away.
#[inline]
fn unit(v: DVec3) -> DVec3 {
    v * (1.5 - 0.5 * v.length_squared())
}

/// `v` turned about the unit vector `axis` by `angle` radians (Rodrigues' formula, right-hand rule).
#[must_use]
pub fn rotate(v: DVec3, axis: DVec3, angle: f64) -> DVec3 {
    turn_about(axis, angle)(v)
}

/// Turns vectors about the unit vector `axis` by `angle` radians, as [`rotate`] does.
#[inline]
pub fn turn_about(axis: DVec3, angle: f64) -> impl Fn(DVec3) -> DVec3 {
    let (sin, cos) = sin_cos(angle);
    move |v| v * cos + axis.cross(v) * sin + axis * (axis.dot(v) * (1.0 - cos))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    fn close(a: DVec3, b: DVec3) {
        assert!((a - b).length() < 1e-12, "{a} is not {b}");
    }

    #[test]
    fn turns_go_where_they_say() {
        let mut turtle = Turtle::UP;
        close(turtle.down(), DVec3::Y);
        turtle.pitch_down(FRAC_PI_2);
        close(turtle.direction, DVec3::Y);
        close(turtle.right, DVec3::X);

        let mut turtle = Turtle::UP;
        turtle.turn_right(FRAC_PI_2);
        close(turtle.direction, DVec3::X);
        close(turtle.right, -DVec3::Z);

        let mut turtle = Turtle::UP;
        turtle.roll_right(FRAC_PI_2);
        close(turtle.direction, DVec3::Z);
        close(turtle.right, DVec3::Y);

        let mut turtle = Turtle::UP;
        turtle.rotate_about(DVec3::Z, FRAC_PI_2);
        close(turtle.right, DVec3::Y);
    }

    #[test]
    fn axes_stay_orthonormal_over_many_turns() {
        let mut turtle = Turtle::UP;
        for i in 0..10_000 {
            let angle = f64::from(i).sin();
            turtle.pitch_down(angle);
            turtle.turn_right(angle * 0.7);
            turtle.roll_right(angle * 1.3);
            turtle.walk(0.1);
        }
        assert!((turtle.direction.length() - 1.0).abs() < 1e-9);
        assert!((turtle.right.length() - 1.0).abs() < 1e-9);
        assert!(turtle.direction.dot(turtle.right).abs() < 1e-6);
    }
}
