//! Frames that do not twist along a curve.

use glam::DVec3;

/// Carries `side`, at right angles to `t0`, from point `p0` to `p1` with the least twist.
///
/// Double reflection: Wang, Jüttler, Zheng and Liu 2008, *Computation of rotation minimizing frames*,
/// §4. `t0` and `t1` are unit tangents; so is the result a unit vector at right angles to `t1`.
pub(crate) fn transport(side: DVec3, p0: DVec3, t0: DVec3, p1: DVec3, t1: DVec3) -> DVec3 {
    let reflect = |v: DVec3, axis: DVec3| {
        let c = axis.length_squared();
        if c < 1e-24 { v } else { v - axis * (2.0 * axis.dot(v) / c) }
    };
    let v1 = p1 - p0;
    let (side, t0) = (reflect(side, v1), reflect(t0, v1));
    let side = reflect(side, t1 - t0);
    // Rounding is pulled straight, so that long stems stay orthonormal.
    (side - t1 * side.dot(t1)).try_normalize().unwrap_or_else(|| perpendicular(t1))
}

/// Some unit vector at right angles to the unit vector `t`.
pub(crate) fn perpendicular(t: DVec3) -> DVec3 {
    let least = if t.x.abs() <= t.y.abs() && t.x.abs() <= t.z.abs() {
        DVec3::X
    } else if t.y.abs() <= t.z.abs() {
        DVec3::Y
    } else {
        DVec3::Z
    };
    (least - t * least.dot(t)).try_normalize().unwrap_or(DVec3::X)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Around a plane circle the normal of the plane must stay where it is; the whole turn of the
    /// other axis is the circle's own.
    #[test]
    fn a_plane_curve_keeps_its_normal() {
        let at = |a: f64| (DVec3::new(a.cos(), a.sin(), 0.0), DVec3::new(-a.sin(), a.cos(), 0.0));
        let mut side = DVec3::Z;
        for i in 0..64 {
            let (a, b) = (f64::from(i) * 0.1, f64::from(i + 1) * 0.1);
            side = transport(side, at(a).0, at(a).1, at(b).0, at(b).1);
        }
        assert!((side - DVec3::Z).length() < 1e-12, "{side}");
    }

    /// The twist of a helix's frame is known: after one turn of a helix with slope angle φ the
    /// rotation-minimising frame has turned against the Frenet frame by 2π·sin φ.
    #[test]
    fn a_helix_turns_the_frame_by_its_torsion() {
        let (radius, rise) = (1.0, 0.5);
        let speed = f64::hypot(radius, rise);
        let point = |a: f64| DVec3::new(radius * a.cos(), radius * a.sin(), rise * a);
        let tangent = |a: f64| DVec3::new(-radius * a.sin(), radius * a.cos(), rise) / speed;
        let steps = 2000;
        let mut side = DVec3::new(-1.0, 0.0, 0.0);
        for i in 0..steps {
            let turn = |i: i32| f64::from(i) / f64::from(steps) * std::f64::consts::TAU;
            let (a, b) = (turn(i), turn(i + 1));
            side = transport(side, point(a), tangent(a), point(b), tangent(b));
        }
        let normal = DVec3::new(-1.0, 0.0, 0.0);
        let binormal = tangent(0.0).cross(normal);
        let expected = -std::f64::consts::TAU * rise / speed;
        let found = side.dot(binormal).atan2(side.dot(normal));
        let off = (found - expected).rem_euclid(std::f64::consts::TAU);
        assert!(!(1e-4..=std::f64::consts::TAU - 1e-4).contains(&off), "{found} {expected}");
    }

    #[test]
    fn reversed_and_standing_steps_stay_orthonormal() {
        for (p1, t1) in [(DVec3::ZERO, DVec3::Z), (DVec3::Z, -DVec3::Z), (DVec3::ZERO, -DVec3::Z)] {
            let side = transport(DVec3::X, DVec3::ZERO, DVec3::Z, p1, t1);
            assert!((side.length() - 1.0).abs() < 1e-12 && side.dot(t1).abs() < 1e-12, "{side}");
        }
    }
}
