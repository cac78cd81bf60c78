//! Leaves in a fan at the tip of a stem, eight at a time.
//!
//! All leaves of a fan start at the same point, so the end of the stem is evaluated once. The rest is the arithmetic of
//! [`crate::spacing::Spacing::child_frame`] and [`Turtle::face_the_light`], operation by operation, so that the bits
//! are those of one leaf after another, but in lockstep and without branches, so that the compiler vectorises it.

use glam::{DVec3, Vec3};
use pleach_tree::trig::{atan2, is_near, near_sin_cos};
use pleach_tree::turtle::Turtle;

/// Leaves in a batch.
pub(crate) const LANES: usize = 8;

type Lane = [f64; LANES];
type Lane3 = [Lane; 3];

/// Up to eight leaves of a fan.
#[derive(Clone, Debug)]
pub(crate) struct LeafFan {
    /// The end of the stem, with the axes of a member in the middle that does not lean.
    tip: Turtle,
    /// Radius of the stem there, metres.
    radius: f64,
    /// `leaf_bend`.
    bend: f64,
    /// Turn to the right, radians.
    turn: Lane,
    /// Angle away from the stem, radians.
    down_angle: Lane,
    len: usize,
    position: Lane3,
    along: Lane3,
    across: Lane3,
}

impl LeafFan {
    pub(crate) const fn new(tip: Turtle, radius: f64, bend: f64) -> Self {
        const NONE: Lane3 = [[0.0; LANES]; 3];
        let (turn, down_angle) = ([0.0; LANES], [0.0; LANES]);
        Self { tip, radius, bend, turn, down_angle, len: 0, position: NONE, along: NONE, across: NONE }
    }

    pub(crate) const fn len(&self) -> usize {
        self.len
    }

    pub(crate) const fn clear(&mut self) {
        self.len = 0;
    }

    /// Adds a member, turned and leaning by these angles in radians.
    pub(crate) const fn push(&mut self, turn: f64, down_angle: f64) {
        self.turn[self.len] = turn;
        self.down_angle[self.len] = down_angle;
        self.len += 1;
    }

    /// Places every leaf.
    pub(crate) fn site(&mut self) {
        let is_near = |angles: &Lane| angles.iter().all(|&angle| is_near(angle));
        if is_near(&self.turn) && is_near(&self.down_angle) {
            self.lean();
            if self.bend > 0.0 {
                self.face_the_light();
            }
        } else {
            (0..self.len).for_each(|lane| self.site_alone(lane));
        }
    }

    /// Position, direction and right-hand axis (both of unit length) of leaf `lane`.
    pub(crate) fn leaf(&self, lane: usize) -> (Vec3, Vec3, Vec3) {
        let get = |lanes: &Lane3| lanes.map(|axis| axis[lane] as f32).into();
        (get(&self.position), get(&self.along), get(&self.across))
    }

    /// Turns each leaf to its place in the fan, moves it to the surface and leans it away.
    #[inline(never)]
    fn lean(&mut self) {
        let Self { tip, radius, turn, down_angle, position, along, across, .. } = self;
        let (direction, right) = (tip.direction.to_array(), tip.right.to_array());
        let at = tip.position.to_array();
        for i in 0..LANES {
            let (sin, cos) = near_sin_cos(turn[i]);
            let ahead = unit(plus(times(direction, cos), times(right, sin)));
            let aside = unit(minus(times(right, cos), times(direction, sin)));
            let down = cross(ahead, aside);
            let (sin, cos) = near_sin_cos(down_angle[i]);
            let leaf = unit(plus(times(ahead, cos), times(down, sin)));
            let outward = times(down, *radius);
            for k in 0..3 {
                position[k][i] = at[k] + outward[k];
                along[k][i] = leaf[k];
                across[k][i] = aside[k];
            }
        }
    }

    #[inline(never)]
    fn face_the_light(&mut self) {
        let Self { bend, position, along, across, .. } = self;
        for i in 0..LANES {
            let at = |lanes: &Lane3| [lanes[0][i], lanes[1][i], lanes[2][i]];
            let (p, ahead, aside) = (at(position), at(along), at(across));
            let n = cross(ahead, aside);
            let outwards = atan2(n[0] * p[1] - n[1] * p[0], n[0] * p[0] + n[1] * p[1]);
            let (sin, cos) = near_sin_cos(*bend * outwards);
            let about_z = |v: [f64; 3]| [v[0] * cos - v[1] * sin, v[0] * sin + v[1] * cos, v[2]];
            let (ahead, aside, n) = (about_z(ahead), about_z(aside), about_z(n));
            let level = (n[0] * n[0] + n[1] * n[1]).sqrt();
            let axis = [n[1] / level, -n[0] / level, 0.0];
            let (sin, cos) = near_sin_cos(*bend * atan2(level, n[2]));
            let lift = |v: [f64; 3]| {
                let kept = dot(axis, v) * (1.0 - cos);
                plus(plus(times(v, cos), times(cross(axis, v), sin)), times(axis, kept))
            };
            let (lifted, lifted_aside) = (lift(ahead), lift(aside));
            // Where the leaf lies level already its axis is no number.
            let stays = level < 1e-9;
            for k in 0..3 {
                along[k][i] = if stays { ahead[k] } else { lifted[k] };
                across[k][i] = if stays { aside[k] } else { lifted_aside[k] };
            }
        }
    }

    /// Any angles, one leaf after another.
    fn site_alone(&mut self, lane: usize) {
        let mut turtle = self.tip;
        turtle.turn_right(self.turn[lane]);
        let outward = turtle.down();
        turtle.pitch_down(self.down_angle[lane]);
        turtle.position += outward * self.radius;
        if self.bend > 0.0 {
            turtle.face_the_light(self.bend);
        }
        let set = |lanes: &mut Lane3, v: DVec3| {
            lanes.iter_mut().zip(v.to_array()).for_each(|(axis, value)| axis[lane] = value);
        };
        set(&mut self.position, turtle.position);
        set(&mut self.along, turtle.direction);
        set(&mut self.across, turtle.right);
    }
}

#[inline(always)]
fn plus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
fn times(a: [f64; 3], by: f64) -> [f64; 3] {
    [a[0] * by, a[1] * by, a[2] * by]
}

#[inline(always)]
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - b[1] * a[2], a[2] * b[0] - b[2] * a[0], a[0] * b[1] - b[0] * a[1]]
}

/// As the turtle does: of a length that is nearly 1.
#[inline(always)]
fn unit(v: [f64; 3]) -> [f64; 3] {
    times(v, 1.5 - 0.5 * dot(v, v))
}

#[cfg(test)]
mod tests {
    use super::*;
    use pleach_tree::Key;
    use std::f64::consts::PI;

    #[test]
    fn eight_at_a_time_are_the_bits_of_one_by_one() {
        for case in 0..2000_u32 {
            let key = Key::root(u64::from(case));
            let vector = |i: u32| DVec3::new(key.signed(i, 0), key.signed(i, 1), key.signed(i, 2));
            // Some stand exactly upright on the axis, where there is no way outwards.
            let (position, direction) = if case % 50 == 0 {
                (DVec3::ZERO, DVec3::Z)
            } else {
                (vector(0) * 5.0, vector(1).normalize())
            };
            let right = direction.cross(vector(2)).normalize();
            let bend = [0.0, 0.4, 1.0][case as usize % 3];
            let mut fan = LeafFan::new(Turtle { position, direction, right }, 0.02, bend);
            for i in 0..LANES as u32 {
                let far = if case % 100 == 7 && i == 3 { 1e6 } else { 1.0 };
                let level = if case % 20 == 0 { 0.0 } else { PI };
                fan.push(level * key.signed(10, i) * far, level * key.signed(11, i));
            }
            fan.site();
            let batch = fan.clone();
            for lane in 0..LANES {
                fan.site_alone(lane);
                let bits = |fan: &LeafFan| {
                    let (position, along, across) = fan.leaf(lane);
                    [position, along, across].map(|v| v.to_array().map(f32::to_bits))
                };
                assert_eq!(bits(&batch), bits(&fan), "case {case}, leaf {lane}");
                for (one, other) in [(&batch.along, &fan.along), (&batch.across, &fan.across)] {
                    assert!(
                        (0..3).all(|k| one[k][lane].to_bits() == other[k][lane].to_bits()),
                        "case {case}"
                    );
                }
            }
        }
    }
}
