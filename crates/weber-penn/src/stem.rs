//! A stem before its path is walked.

use crate::model::{Model, power_bounds};
use crate::purpose;
use crate::radius::Profile;
use pleach_tree::math;
use pleach_tree::turtle::Turtle;
use pleach_tree::{Address, Draw, Growth, Key};

/// A stem about to grow.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StemSpec {
    /// The key of its random numbers.
    pub(crate) key: Key,
    /// The key of its forks' random numbers: `key`, or the one that `key` was before the stem was given draws
    /// of its own. Forks carry rounding errors from one to the next, and a fork's own draws must not change
    /// the others.
    pub(crate) fork_key: Key,
    /// Where it is in the tree.
    pub(crate) address: Address,
    /// Its number among the children, or the forks, of its parent.
    pub(crate) number: u32,
    /// Level, 0 for trunks.
    pub(crate) level: usize,
    /// Where it starts and how it is turned.
    pub(crate) turtle: Turtle,
    /// Index in the tree of the stem that it grows from.
    pub(crate) parent: Option<u32>,
    /// Metres along the parent at which it starts.
    pub(crate) offset: f64,
    /// Length of the whole stem in metres. A fork has its origin's.
    pub(crate) length: f64,
    /// Nominal radius at the base of the whole stem in metres. A fork has its origin's.
    pub(crate) radius: f64,
    /// Largest radius that the base may have: the parent's where it starts.
    pub(crate) radius_limit: f64,
    /// The parent's length in metres.
    pub(crate) parent_length: f64,
    /// The parent's nominal base radius in metres.
    pub(crate) parent_radius: f64,
    /// The parent's draw of the greatest relative length of its children.
    pub(crate) parent_child_length: f64,
    /// The scale of the tree that it is part of, in metres.
    pub(crate) scale: f64,
    /// Set for stems that fork off another one.
    pub(crate) forked: Option<ForkStart>,
}

/// What a fork inherits from the stem that it leaves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ForkStart {
    /// The point of the whole stem at which it starts, 1 or more.
    pub(crate) start: u32,
    /// Direction along which the old stem arrived there: the fork leaves along it.
    pub(crate) first_handle: Option<glam::DVec3>,
    /// The whole stem's draw of the greatest relative length of its children.
    pub(crate) child_length: f64,
    /// Fork state at that point.
    pub(crate) fork: ForkState,
}

/// Fork probability and accumulated penalties.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ForkState {
    /// Probability of the next fork.
    pub(crate) probability: f64,
    /// Part of its children that a forked stem keeps at each segment.
    pub(crate) branch_factor: f64,
    /// Radians that each segment still turns back after a fork.
    pub(crate) correction: f64,
}

impl ForkState {
    pub(crate) const UNFORKED: Self = Self { probability: 1.0, branch_factor: 1.0, correction: 0.0 };
}

impl StemSpec {
    /// The first point of the path, 0 unless it forks off another stem.
    pub(crate) fn start(&self) -> u32 {
        self.forked.map_or(0, |c| c.start)
    }

    pub(crate) fn fork(&self) -> ForkState {
        self.forked.map_or(ForkState::UNFORKED, |c| c.fork)
    }

    /// Radius along the stem.
    pub(crate) fn profile(&self, model: &Model) -> Profile {
        let flare = if self.level == 0 { model.flare } else { 0.0 };
        Profile { base: self.radius, length: self.length, taper: model.levels[self.level].taper, flare }
    }

    /// Whether it is long enough to be made.
    pub(crate) fn is_made(&self) -> bool {
        self.length.is_finite() && self.length >= MIN_LENGTH
    }

    /// The greatest relative length of its children.
    pub(crate) fn child_length(&self, model: &Model) -> f64 {
        let next = model.child_level(self.level);
        self.forked.map_or_else(
            || (next.length + self.key.signed(purpose::CHILD_LENGTH, 0) * next.length_v).max(0.0),
            |fork| fork.child_length,
        )
    }

    /// Points of the path.
    pub(crate) fn points(&self, model: &Model) -> u32 {
        model.levels[self.level].curve_res - self.start() + 1
    }

    /// Whether the radius changes faster than the path bends, by flare and beads: more knots on the same path.
    pub(crate) fn is_fine(&self, model: &Model) -> bool {
        self.level == 0 || model.levels[self.level].taper > 1.0
    }

    /// Knots for a piece of the path, both ends included; two are the path's own.
    pub(crate) fn knots_a_piece(&self, model: &Model) -> u32 {
        let curve_res = model.levels[self.level].curve_res;
        if self.is_fine(model) { 100_u32.div_ceil(curve_res).max(2) } else { 2 }
    }

    /// Knots of the whole stem.
    pub(crate) fn knots(&self, model: &Model) -> usize {
        (self.points(model) as usize - 1) * (self.knots_a_piece(model) as usize - 1) + 1
    }

    /// The error of `seg_splits` with which a branch begins: in mid-pattern.
    pub(crate) fn first_carry(&self, model: &Model) -> f64 {
        let splits = model.levels[self.level].seg_splits > 0.0;
        if splits { self.key.unit(purpose::SPLIT_PHASE, 0) } else { 0.0 }
    }

    /// Fork `index` of this stem, which leaves in `state`, and its draws; its turtle is still this stem's.
    pub(crate) fn fork_at(&self, growth: &Growth<'_>, state: ForkStart, index: u32) -> (Self, Draw) {
        let address = self.address.fork(index);
        let draw = growth.draw(address, self.level);
        let fork = Self {
            key: draw.key(self.key.child(purpose::FORK, index)),
            fork_key: self.fork_key.child(purpose::FORK, index),
            address,
            number: index,
            forked: Some(state),
            ..*self
        };
        (fork, draw)
    }

    /// Makes this a fork of `origin`, as that has grown.
    pub(crate) fn adopt(&mut self, model: &Model, origin: &Self) {
        // Where the fork is on the stem that it leaves, in metres from that stem's own first point.
        let from_start = f64::from(self.start() - origin.start());
        self.offset = origin.length * from_start / f64::from(model.levels[self.level].curve_res);
        self.length = origin.length;
        self.radius = origin.radius;
    }

    /// Base radius of a branch of this length (Weber and Penn 1995, §4.4; `radius_mod` and the floor
    /// are Hewitt's): thinner by a power of the length ratio, never thicker than its parent there.
    pub(crate) fn branch_radius(&self, model: &Model) -> f64 {
        // Twigs on twigs: whatever the power is, the floor or the parent decides.
        if self.radius_limit <= MIN_RADIUS {
            return self.radius_limit;
        }
        let part = self.length / self.parent_length;
        let whole = model.levels[self.level].radius_mod * self.parent_radius;
        // A power takes longer than all else that is known of a twig, and for most the bounds are enough.
        if let Some((least, most)) = power_bounds(part, model.ratio_power) {
            if whole * most < (1.0 - 1e-9) * MIN_RADIUS {
                return MIN_RADIUS;
            }
            if whole * least > (1.0 + 1e-9) * self.radius_limit {
                return self.radius_limit;
            }
        }
        (whole * math::pow(part, model.ratio_power)).max(MIN_RADIUS).min(self.radius_limit)
    }
}

/// Stems shorter than this, in metres, are not made.
const MIN_LENGTH: f64 = 1e-4;

/// Branches are at least this thick, in metres, unless their parent is thinner.
const MIN_RADIUS: f64 = 0.005;

#[cfg(test)]
impl StemSpec {
    /// A branch ten metres long on a trunk of twenty, straight up from the origin.
    pub(crate) fn test_stem() -> Self {
        Self {
            key: Key::root(1),
            fork_key: Key::root(1),
            address: Address::trunk(0),
            number: 0,
            level: 1,
            turtle: Turtle::UP,
            parent: None,
            offset: 0.0,
            length: 10.0,
            radius: 0.1,
            radius_limit: 0.1,
            parent_length: 20.0,
            parent_radius: 0.2,
            parent_child_length: 0.5,
            scale: 20.0,
            forked: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::space;
    use pleach_tree::param::table::Parameters;

    #[test]
    fn radii_are_those_of_the_power() {
        let mut model = Model::read(&space().defaults());
        let (mut floored, mut limited, mut free) = (0, 0, 0);
        for case in 0..20_000 {
            let key = Key::root(case);
            let unit = |i| key.unit(0, i);
            model.ratio_power = 3.0 * unit(0);
            model.levels[1].radius_mod = 2.0 * unit(1);
            let stem = StemSpec {
                length: 11.0 * unit(2),
                parent_length: 10.0,
                parent_radius: 0.3 * unit(3) * unit(4),
                radius_limit: 0.3 * unit(5) * unit(6),
                ..StemSpec::test_stem()
            };
            let power = math::pow(stem.length / stem.parent_length, model.ratio_power);
            let radius = model.levels[1].radius_mod * stem.parent_radius * power;
            let expected = radius.max(MIN_RADIUS).min(stem.radius_limit);
            assert_eq!(stem.branch_radius(&model).to_bits(), expected.to_bits(), "case {case}");
            floored += u32::from(expected == MIN_RADIUS);
            limited += u32::from(expected == stem.radius_limit);
            free += u32::from(expected == radius);
        }
        assert!(floored > 1000 && limited > 1000 && free > 1000, "{floored}, {limited}, {free}");
    }
}
