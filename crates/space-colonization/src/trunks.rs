//! Trunks and limbs: the axes that stand before points are colonised.
//!
//! Pictures show a trunk's lean, its bow, its first fork and how far a leader goes, so these are numbers and not what
//! happens to come out of growing. Runions and others let the trunk grow up until it comes near to the points.

use crate::nodes::{NONE, Nodes};
use crate::params::Numbers;
use crate::purpose::{CROOK, LIMB, LIMB_DRAW, STAND, TRUNK};
use crate::rules::Rules;
use crate::volume::{Volume, lean_at};
use glam::{DVec2, DVec3};
use pleach_tree::trig::sin_cos;
use pleach_tree::{Key, math};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Most nodes of a trunk or a limb.
const MAX_STEPS: u32 = 1000;
/// Longest step of a trunk or a limb over the tree's height.
const MAX_STEP: f64 = 0.1;
/// How many limbs on is the next one counted around the trunk, for each number of limbs: neighbours in height are
/// not neighbours around the trunk.
const AROUND: [f64; 10] = [1.0, 1.0, 1.0, 1.0, 1.0, 2.0, 1.0, 3.0, 3.0, 4.0];
/// Deviations of a limb: of its turn in parts of the angle between limbs, of its angle, its length and its height.
const LIMB_V: [f64; 4] = [0.3, 0.22, 0.12, 0.3];
/// Waves in which a stem wanders, over the tree's height.
const WAVES: [f64; 2] = [2.3, 5.1];

/// Grows the trunks and limbs of a tree.
pub(crate) fn stand(n: &Numbers, volume: &Volume<'_>, rules: &Rules, key: Key, nodes: &mut Nodes) {
    for number in 0..n.trunks {
        Trunk::new(n, volume, rules, key, number).grow(nodes);
    }
}

struct Trunk<'a> {
    n: &'a Numbers,
    volume: &'a Volume<'a>,
    step: f64,
    key: Key,
    crook: Crook,
    /// Horizontal direction in which it leaves the other trunks; zero for a single one.
    away: DVec2,
}

impl<'a> Trunk<'a> {
    fn new(n: &'a Numbers, volume: &'a Volume<'a>, rules: &Rules, key: Key, number: u32) -> Self {
        let own = key.child(TRUNK, number);
        let away = if n.trunks > 1 {
            let turn = (f64::from(number) + 0.25 * own.signed(STAND, 0)) / f64::from(n.trunks);
            let (sin, cos) = sin_cos(TAU * (turn + key.unit(STAND, 1)));
            DVec2::new(cos, sin)
        } else {
            DVec2::ZERO
        };
        // A trunk of more than a thousand steps is one of longer steps, and one of few points still has its form.
        let step = rules.step.clamp(1.2 / f64::from(MAX_STEPS), MAX_STEP);
        Self { n, volume, step, key: own, crook: Crook::new(n.crook, own), away }
    }

    fn grow(&self, nodes: &mut Nodes) {
        let n = self.n;
        let axis = nodes.trunk();
        // Several trunks stand around a stool as wide as they are thick.
        let foot = (self.away * (1.3 * n.thickness * f64::from(n.trunks).sqrt())).extend(0.0);
        let mut node = nodes.push(foot, self.direction(0.0), NONE, axis);
        let crown_top = n.bare_height + (1.0 - n.bare_height) * n.leader;
        let top = if n.has_limbs() { n.first_fork + n.fork_spread } else { crown_top.max(n.bare_height) };
        let top = top.min(self.volume.top()).clamp(2.0 * self.step, 1.0);
        let mut limbs = Limbs::new(n, self.key);
        for _ in 0..MAX_STEPS {
            let from = nodes.all[node as usize];
            let left = top - from.place.z;
            limbs.leave(self, node, nodes);
            if left < 0.25 * self.step || self.is_beyond(from.place, n.leader) {
                break;
            }
            let heading = self.direction(from.place.z);
            let length = self.step.min(left / heading.z.max(0.2));
            node = nodes.push(from.place + heading * length, heading, node, axis);
        }
        limbs.leave_all(self, node, nodes);
    }

    /// Where the trunk grows to at height `z`.
    fn direction(&self, z: f64) -> DVec3 {
        let n = self.n;
        // Of several trunks a picture shows one.
        if let (1, Some(slope)) = (n.trunks, self.volume.shown_slope(z)) {
            return slope.extend(1.0).normalize();
        }
        let (sin, cos) = sin_cos(n.lean_azimuth);
        let lean = DVec2::new(cos, sin) * math::tan(lean_at(n, z));
        // Trunks that stand apart turn upwards with height.
        let apart = self.away * (math::tan(n.trunk_spread) * (1.0 - 0.6 * z));
        (lean + apart + self.crook.at(z)).extend(1.0).normalize()
    }

    /// Whether a stem that began inside the crown has left the part `reach` of it to the side.
    fn is_beyond(&self, place: DVec3, reach: f64) -> bool {
        let inside = self.volume.inside(place);
        self.n.trunks > 1 && inside.rise > 0.0 && inside.out > reach.max(0.4)
    }
}

/// The limbs of a trunk, those lowest first.
struct Limbs<'a> {
    n: &'a Numbers,
    key: Key,
    count: u32,
    next: u32,
}

impl<'a> Limbs<'a> {
    fn new(n: &'a Numbers, key: Key) -> Self {
        Self { n, key, count: if n.has_limbs() { n.limbs } else { 0 }, next: 0 }
    }

    /// Height at which the next limb leaves.
    fn height(&self) -> f64 {
        let last = f64::from(self.count.max(2) - 1);
        let own = self.key.child(LIMB, self.next);
        // The last two leave together at the top, as the arms of a fork.
        let part = (f64::from(self.next) / (last - 1.0).max(1.0)).min(1.0);
        self.n.first_fork
            + self.n.fork_spread * (part + LIMB_V[3] * own.signed(LIMB_DRAW, 3) / last).clamp(0.0, 1.0)
    }

    fn leave(&mut self, trunk: &Trunk<'_>, node: u32, nodes: &mut Nodes) {
        while self.next < self.count && self.height() <= nodes.all[node as usize].place.z + 1e-9 {
            self.limb(trunk, node, nodes);
        }
    }

    fn leave_all(&mut self, trunk: &Trunk<'_>, node: u32, nodes: &mut Nodes) {
        while self.next < self.count {
            self.limb(trunk, node, nodes);
        }
    }

    /// Grows the next limb from `node`.
    fn limb(&mut self, trunk: &Trunk<'_>, node: u32, nodes: &mut Nodes) {
        let (n, number) = (self.n, self.next);
        let own = self.key.child(LIMB, number);
        self.next += 1;
        let draw = |index: u32| LIMB_V[index as usize] * own.signed(LIMB_DRAW, index);
        let around = AROUND[(self.count as usize).min(AROUND.len() - 1)];
        let turn = (f64::from(number) * around + draw(0)) / f64::from(self.count);
        let azimuth = TAU * (turn + self.key.unit(LIMB_DRAW, 0));
        let angle = n.fork_angle * (1.0 + draw(1));
        let reach = (n.leader * (1.0 + draw(2))).min(1.0);
        let crook = Crook::new(n.crook, own);
        let (sin, cos) = sin_cos(azimuth);
        let aside = DVec3::new(cos, sin, 0.0);
        let axis = nodes.axis(1.0, DVec3::Z);
        let mut node = node;
        let parent = nodes.all[node as usize].heading;
        for number in 0..MAX_STEPS {
            let from = nodes.all[node as usize];
            let inside = trunk.volume.inside(from.place);
            let out = if inside.rise < 0.0 { 0.5 * inside.out } else { inside.out };
            let progress = inside.rise.max(out) / reach.max(0.02);
            let length = f64::from(number) * trunk.step;
            if number > 1 && (progress >= 1.0 || from.place.z < 0.02 || length > 1.2) {
                break;
            }
            let lean = (angle * (1.0 - n.fork_rise * progress.clamp(0.0, 1.0))).clamp(0.0, 2.2);
            let (sin, cos) = sin_cos(lean);
            // A limb keeps less and less of the trunk's direction.
            let upright = parent.lerp(DVec3::Z, progress.clamp(0.0, 1.0)).normalize_or(DVec3::Z);
            let course = upright * cos + aside * sin;
            let (x, y) = course.normalize_or(DVec3::Z).any_orthonormal_pair();
            let wander = crook.at(length);
            let heading = (course + x * wander.x + y * wander.y).normalize_or(DVec3::Z);
            node = nodes.push(from.place + heading * trunk.step, heading, node, axis);
        }
    }
}

/// How a stem wanders: a slow wave and a quick one in each direction.
#[derive(Clone, Copy, Debug)]
struct Crook {
    tangent: f64,
    phases: [f64; 4],
}

impl Crook {
    fn new(angle: f64, key: Key) -> Self {
        let phase = |i: usize| TAU * key.unit(CROOK, i as u32);
        Self { tangent: math::tan(angle), phases: std::array::from_fn(phase) }
    }

    /// What is added to a direction of length 1, `far` along the stem.
    fn at(&self, far: f64) -> DVec2 {
        if self.tangent == 0.0 {
            return DVec2::ZERO;
        }
        let wave = |phase: f64, wave: f64, turn: f64| sin_cos(TAU * wave * far + phase + turn).0;
        let [a, b, c, d] = self.phases;
        let x = 0.6 * wave(a, WAVES[0], 0.0) + 0.4 * wave(b, WAVES[1], 0.0);
        let y = 0.6 * wave(c, WAVES[0], FRAC_PI_2) + 0.4 * wave(d, WAVES[1], FRAC_PI_2);
        DVec2::new(x, y) * self.tangent
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Id;
    use pleach_tree::param::table::Parameters;

    fn standing(set: &[(Id, f64)]) -> Nodes {
        let mut values = Numbers::space().defaults();
        set.iter().for_each(|&(id, value)| values[id.slot(0).index()] = value);
        let n = Numbers::read(&values);
        let volume = Volume::new(&n, None, Key::root(1));
        let mut nodes = Nodes::default();
        stand(&n, &volume, &Rules::new(&n, 0.08), Key::root(2), &mut nodes);
        nodes
    }

    fn tips(nodes: &Nodes) -> Vec<DVec3> {
        nodes.all.iter().filter(|node| node.next == NONE).map(|node| node.place).collect()
    }

    #[test]
    fn a_leader_goes_as_far_as_it_is_told() {
        for (leader, top) in [(1.0, 1.0), (0.5, 0.65), (0.0, 0.3)] {
            let set = [(Id::limbs, 1.0), (Id::leader, leader), (Id::bare_height, 0.3), (Id::crook, 0.0)];
            let nodes = standing(&set);
            let tip = tips(&nodes)[0];
            assert!((tip.z - top).abs() < 0.012 && tip.truncate().length() < 1e-9, "{leader}: {tip}");
        }
    }

    #[test]
    fn limbs_leave_at_their_heights_and_stay_in_the_crown() {
        let set = [(Id::limbs, 4.0), (Id::first_fork, 0.2), (Id::fork_spread, 0.1), (Id::leader, 0.8)];
        let nodes = standing(&set);
        assert_eq!(nodes.axes.len(), 5);
        let mut forks: Vec<f64> = Vec::new();
        for node in &nodes.all {
            if let Some(parent) = nodes.all.get(node.parent as usize)
                && parent.axis != node.axis
            {
                forks.push(parent.place.z);
            }
        }
        assert_eq!(forks.len(), 4);
        assert!(forks.iter().all(|z| (0.15..0.34).contains(z)), "{forks:?}");
        assert!(tips(&nodes).iter().all(|tip| (0.2..0.95).contains(&tip.z)));
    }

    #[test]
    fn several_trunks_stand_apart_and_lean_away() {
        let nodes = standing(&[(Id::trunks, 4.0), (Id::trunk_spread, 20.0), (Id::limbs, 1.0)]);
        let feet: Vec<DVec3> =
            nodes.all.iter().filter(|node| node.parent == NONE).map(|node| node.place).collect();
        assert_eq!(feet.len(), 4);
        assert!(feet[0].distance(feet[1]) > 0.02);
        let tips = tips(&nodes);
        assert!(feet.iter().zip(&tips).all(|(foot, tip)| tip.length() > foot.length() + 0.1));
    }

    #[test]
    fn lean_and_bow_move_the_top() {
        let top =
            |set: &[(Id, f64)]| tips(&standing(&[&[(Id::limbs, 1.0), (Id::crook, 0.0)], set].concat()))[0];
        let leaning = top(&[(Id::lean, 20.0), (Id::leader, 1.0)]);
        assert!((leaning.x - math::tan(20.0_f64.to_radians())).abs() < 0.02 && leaning.y.abs() < 1e-9);
        let bowed = top(&[(Id::bow, 40.0), (Id::leader, 1.0)]);
        assert!(bowed.x.abs() < 0.02, "it leans back first");
    }
}
