//! How shoots of a tree grow: the numbers of its species, as lengths over its height.

use crate::params::{EVEN, Numbers};
use glam::DVec3;
use pleach_tree::math;
use pleach_tree::trig::sin_cos;

/// Largest bend of a shoot without inertia in one step, radians.
const MAX_TURN: f64 = 0.5;

/// Lengths and habits of growth; lengths over the tree's height.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rules {
    pub(crate) step: f64,
    pub(crate) influence: f64,
    pub(crate) kill: f64,
    pub(crate) inertia: f64,
    pub(crate) tropism: f64,
    pub(crate) outward: f64,
    pub(crate) dominance: f64,
    pub(crate) control: f64,
    pub(crate) crown_width: f64,
    pub(crate) bud_spacing: u32,
}

impl Rules {
    /// The rules of a tree whose points lie `spacing` apart.
    pub(crate) fn new(n: &Numbers, spacing: f64) -> Self {
        let step = n.step * spacing;
        Self {
            step,
            influence: (n.influence * spacing).max(1.2 * step),
            // A point that is passed at less than half a step would pull back for ever.
            kill: (n.kill * spacing).max(0.6 * step),
            inertia: n.inertia,
            tropism: n.tropism,
            outward: n.outward,
            dominance: n.dominance,
            control: n.apical_control,
            crown_width: n.crown_width,
            bud_spacing: n.bud_spacing,
        }
    }

    /// Whether resource is divided among buds. It is not where each gets as much as it can use.
    pub(crate) fn divides(&self) -> bool {
        self.control != EVEN
    }

    /// `wish`, or as much of the way to it from `heading` as a shoot can bend in one step.
    pub(crate) fn bent(&self, heading: DVec3, wish: DVec3) -> DVec3 {
        let (sin, cos) = sin_cos(MAX_TURN / (1.0 + self.inertia));
        let along = heading.dot(wish);
        if along >= cos {
            return wish;
        }
        let aside = (wish - heading * along).normalize_or_zero();
        (heading * cos + aside * sin).normalize_or(heading)
    }

    /// The mean spacing of `count` points in a volume of `size`.
    pub(crate) fn spacing(size: f64, count: u32) -> f64 {
        math::cbrt(size / f64::from(count)).max(1e-4)
    }
}
