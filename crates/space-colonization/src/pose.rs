//! How draws of single stems turn what they carry.

use glam::{DMat3, DVec3};
use pleach_tree::Draw;
use pleach_tree::trig::sin_cos;

/// A turn and a scale about some place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pose {
    linear: DMat3,
    offset: DVec3,
    is_still: bool,
}

impl Pose {
    /// Everything stays where it is.
    pub(crate) const STILL: Self = Self { linear: DMat3::IDENTITY, offset: DVec3::ZERO, is_still: true };

    /// Where `place` comes to lie.
    pub(crate) fn place(&self, place: DVec3) -> DVec3 {
        // The same bits as without draws.
        if self.is_still { place } else { self.linear * place + self.offset }
    }

    /// What a stem and all that it carries come to with its `draw`: turned about `parent`, leaned away from the
    /// parent's tip, and scaled, about its foot. `along` is the stem's direction.
    pub(crate) fn then(&self, draw: &Draw, foot: DVec3, parent: DVec3, along: DVec3) -> Self {
        if draw.azimuth == 0.0 && draw.pitch == 0.0 && draw.length == 1.0 {
            return *self;
        }
        let sideways = parent.cross(along).try_normalize().unwrap_or_else(|| parent.any_orthonormal_vector());
        let own = turn(parent, draw.azimuth) * turn(sideways, draw.pitch) * draw.length;
        Self {
            linear: self.linear * own,
            offset: self.linear * (foot - own * foot) + self.offset,
            is_still: false,
        }
    }
}

/// The turn about the unit vector `axis` by `angle` radians, right-handed.
fn turn(axis: DVec3, angle: f64) -> DMat3 {
    let (sin, cos) = sin_cos(angle);
    let turned = |v: DVec3| v * cos + axis.cross(v) * sin + axis * (axis.dot(v) * (1.0 - cos));
    DMat3::from_cols(turned(DVec3::X), turned(DVec3::Y), turned(DVec3::Z))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn a_stem_turns_about_its_foot() {
        let foot = DVec3::Z;
        let draw = Draw { azimuth: FRAC_PI_2, length: 2.0, ..Draw::OWN };
        let pose = Pose::STILL.then(&draw, foot, DVec3::Z, DVec3::X);
        assert_eq!(pose.place(foot), foot);
        assert!(pose.place(foot + DVec3::X).distance(foot + DVec3::Y * 2.0) < 1e-12);
        let lean = Draw { pitch: FRAC_PI_2, ..Draw::OWN };
        let leaned = Pose::STILL.then(&lean, foot, DVec3::Z, DVec3::X);
        assert!(leaned.place(foot + DVec3::X).distance(DVec3::ZERO) < 1e-12, "away from the parent's tip");
        let both = pose.then(&lean, foot + DVec3::X, DVec3::X, DVec3::Y);
        assert!(both.place(foot + DVec3::X).distance(pose.place(foot + DVec3::X)) < 1e-12);
    }
}
