//! Where subgraphs point.

use crate::purpose::DIRECTION;
use glam::{DVec3, dvec3};
use pleach_tree::Key;
use pleach_tree::trig::{atan2, sin_cos};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Where a graph points before it is turned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Orientation {
    /// On from the root of the graph before, through the endpoint.
    Outward,
    Down,
    Up,
    Random,
}

impl Orientation {
    pub(crate) fn from_number(number: f64) -> Self {
        match number as u32 {
            0 => Self::Outward,
            1 => Self::Down,
            2 => Self::Up,
            _ => Self::Random,
        }
    }

    /// The direction of the graph of `key` around the end of a branch that came along `outward`.
    pub(crate) fn direction(self, outward: DVec3, key: Key) -> DVec3 {
        match self {
            Self::Outward => outward,
            Self::Down => DVec3::NEG_Z,
            Self::Up => DVec3::Z,
            Self::Random => {
                let z = key.signed(DIRECTION, 1);
                let (sin, cos) = sin_cos(TAU * key.unit(DIRECTION, 2));
                let across = (1.0 - z * z).max(0.0).sqrt();
                dvec3(across * cos, across * sin, z)
            }
        }
    }
}

/// `v` turned by `angle` radians in its vertical plane, upwards where positive, and never past the
/// vertical. What is vertical already goes in a direction drawn from `key`.
pub(crate) fn turned(v: DVec3, angle: f64, key: Key) -> DVec3 {
    if angle == 0.0 {
        return v;
    }
    let across = v.truncate().length();
    let elevation = (atan2(v.z, across) + angle).clamp(-FRAC_PI_2, FRAC_PI_2);
    let (sin, cos) = sin_cos(elevation);
    let azimuth = if across > 1e-9 {
        v.truncate() / across
    } else {
        let (sin, cos) = sin_cos(TAU * key.unit(DIRECTION, 0));
        glam::dvec2(cos, sin)
    };
    (azimuth * cos).extend(sin)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_are_as_worked_out() {
        let v = dvec3(0.866_025, 0.0, 0.5);
        let down = turned(v, -21.6_f64.to_radians(), Key::root(1));
        assert!((down - dvec3(0.989_272, 0.0, 0.146_083)).length() < 2e-6, "{down}");
        let mut weeping = DVec3::X;
        for _ in 0..7 {
            weeping = turned(weeping, -21.6_f64.to_radians(), Key::root(1));
        }
        assert!((weeping - DVec3::NEG_Z).length() < 1e-9, "it hangs and does not curl: {weeping}");
    }

    #[test]
    fn what_is_vertical_turns_somewhere() {
        let lean = turned(DVec3::Z, -0.5, Key::root(1));
        assert!((lean.length() - 1.0).abs() < 1e-9 && (lean.z - 0.5_f64.cos()).abs() < 1e-9);
    }

    #[test]
    fn random_directions_are_of_unit_length() {
        for i in 0..100 {
            let v = Orientation::Random.direction(DVec3::X, Key::root(i));
            assert!((v.length() - 1.0).abs() < 1e-9);
        }
    }
}
