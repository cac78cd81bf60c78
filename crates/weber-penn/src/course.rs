//! The course of the trunk: lean and bow.
//!
//! A tree grows upright, and is then displaced towards +x, everything at one height by the same distance. So lean
//! changes no draw, no length of a draw and no height, and a crown stays above its trunk. A turn about the foot would
//! tilt the crown, which trees right again, and forks would lose it: they spread about the vertical.

use crate::model::Model;
use glam::DVec3;
use pleach_tree::{Tree, math};

/// By how far what grew at a height is displaced.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Course {
    /// Height of the tree in metres.
    height: f64,
    /// Slope at the foot.
    foot: f64,
    /// By how much the slope at the top exceeds it.
    gain: f64,
}

impl Course {
    /// The course of trees of these numbers; `None` if they are upright.
    pub(crate) fn new(model: &Model) -> Option<Self> {
        if model.lean == 0.0 && model.bow == 0.0 {
            return None;
        }
        let half = math::tan(model.bow / 2.0);
        Some(Self { height: model.g_scale, foot: math::tan(model.lean) - half, gain: 2.0 * half })
    }

    /// Displacement and slope at height `z`. Below the ground and above the height the course is straight.
    fn at(&self, z: f64) -> (f64, f64) {
        let t = (z / self.height).clamp(0.0, 1.0);
        let slope = self.foot + self.gain * t;
        let within = self.height * (self.foot + self.gain * t / 2.0) * t;
        (within + slope * (z - self.height * t), slope)
    }

    /// Where `point` of the upright tree comes to lie.
    pub(crate) fn place(&self, point: DVec3) -> DVec3 {
        DVec3 { x: point.x + self.at(point.z).0, ..point }
    }

    /// Displaces an upright tree. Leaves keep their directions.
    pub(crate) fn bend(&self, tree: &mut Tree) {
        for knot in &mut tree.knots {
            let (off, slope) = self.at(knot.point.z);
            let point = knot.point;
            // Handles follow the tangent at their knot, so pieces meet as smoothly as before.
            let handle = |h: DVec3| DVec3 { x: h.x + off + slope * (h.z - point.z), ..h };
            (knot.handle_in, knot.handle_out) = (handle(knot.handle_in), handle(knot.handle_out));
            knot.point.x += off;
        }
        for leaf in tree.leaves.iter_mut().chain(&mut tree.blossoms) {
            let at = leaf.position.as_dvec3();
            leaf.position.x = (at.x + self.at(at.z).0) as f32;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::space;
    use crate::params::table::Id;
    use pleach_tree::param::table::Parameters;

    fn course(lean: f64, bow: f64) -> Course {
        let mut values = space().defaults();
        values[Id::lean.slot(0).index()] = lean;
        values[Id::bow.slot(0).index()] = bow;
        values[Id::g_scale.slot(0).index()] = 10.0;
        Course::new(&Model::read(&values)).unwrap()
    }

    #[test]
    fn a_lean_is_straight_and_a_bow_comes_back() {
        let lean = course(20.0, 0.0);
        for z in [-1.0, 0.0, 4.0, 10.0, 12.0] {
            let place = lean.place(DVec3::new(0.5, 1.0, z));
            let expected = DVec3::new(0.5 + z * 20.0_f64.to_radians().tan(), 1.0, z);
            assert!(place.distance(expected) < 1e-12, "{place}");
        }
        let bow = course(0.0, 60.0);
        let slope = |z: f64| bow.at(z).1.atan().to_degrees();
        assert!((slope(0.0) + 30.0).abs() < 1e-9 && (slope(10.0) - 30.0).abs() < 1e-9);
        assert!((slope(15.0) - 30.0).abs() < 1e-9 && (slope(-1.0) + 30.0).abs() < 1e-9);
        assert!(bow.place(DVec3::Z * 10.0).x.abs() < 1e-12 && bow.place(DVec3::Z * 5.0).x < -1.0);
        // The slope is that of the displacement, beyond the ends too.
        for z in [-2.0, 0.1, 3.0, 9.9, 11.0] {
            let by_difference = (bow.at(z + 1e-6).0 - bow.at(z - 1e-6).0) / 2e-6;
            assert!((by_difference - bow.at(z).1).abs() < 1e-6, "{z}");
        }
    }
}
