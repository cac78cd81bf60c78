//! The modules of a tree, by which the draws of its parts are addressed.

use glam::{DQuat, DVec3, dvec3};
use pleach_tree::random::Purpose;
use pleach_tree::trig::sin_cos;
use pleach_tree::{Draw, Key};
use std::f64::consts::TAU;

/// The module of a part, which is the purpose of its key.
pub(crate) const TRUNKS: Purpose = 1;
pub(crate) const ROOTS: Purpose = 2;
pub(crate) const SEGMENTS: Purpose = 3;
pub(crate) const BRANCHES: Purpose = 4;
pub(crate) const FOLIAGE: Purpose = 5;
pub(crate) const SPHERES: Purpose = 6;

/// The rotation of a trunk with this draw.
pub(crate) fn turned(draw: &Draw) -> DQuat {
    let ((sin_a, cos_a), (sin_p, cos_p)) = (sin_cos(draw.azimuth / 2.0), sin_cos(draw.pitch / 2.0));
    DQuat::from_xyzw(0.0, 0.0, sin_a, cos_a) * DQuat::from_xyzw(0.0, sin_p, 0.0, cos_p)
}

/// Three uniform numbers in [−1, 1).
pub(crate) fn signed3(key: Key, purpose: Purpose, index: u32) -> DVec3 {
    let at = |i: u32| key.signed(purpose, 3 * index + i);
    dvec3(at(0), at(1), at(2))
}

/// A direction, all alike.
pub(crate) fn direction(key: Key, purpose: Purpose) -> DVec3 {
    let z = key.signed(purpose, 0);
    let (sin, cos) = sin_cos(TAU * key.unit(purpose, 1));
    let level = (1.0 - z * z).max(0.0).sqrt();
    dvec3(level * cos, level * sin, z)
}

/// A rotation, all alike (Shoemake 1992).
pub(crate) fn rotation(key: Key, purpose: Purpose) -> DQuat {
    let u = key.unit(purpose, 0);
    let (a, b) = ((1.0 - u).sqrt(), u.sqrt());
    let (sin_v, cos_v) = sin_cos(TAU * key.unit(purpose, 1));
    let (sin_w, cos_w) = sin_cos(TAU * key.unit(purpose, 2));
    DQuat::from_xyzw(a * sin_v, a * cos_v, b * sin_w, b * cos_w).normalize()
}
