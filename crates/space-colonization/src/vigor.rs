//! Apical control: how much of a tree's resource each bud gets.
//!
//! The extended model of Borchert and Honda 1984, as Pałubicki and others 2009, §4.2, have it. A bud with space to grow
//! into has Q = 1. The sums of Q flow to the foot of the trunk (basipetally). There they become the resource v = α Q,
//! which flows back up (acropetally) and is divided where a side shoot leaves an axis:
//!
//! ```text
//! v_m = v λ Q_m / (λ Q_m + (1 − λ) Q_l)        v_l = v (1 − λ) Q_l / (λ Q_m + (1 − λ) Q_l)
//! ```
//!
//! λ is apical control: above 0.5 axes that go on get more than their side shoots, below it less.
//!
//! Ours: α is 1, so that with λ = 0.5 every bud has a step in each round, as without the model. A bud saves what is
//! less than a step, where the papers let ⌊v⌋ metamers grow at once, and uses at most one step in a round: points are
//! reached after each. What a bud cannot use is lost, as it is in the papers to those with v < 1. Several side shoots of
//! one node share by their Q. A crown's volume is bounded, and slow shoots would fill it in the end, so a tree has an
//! age, after which none grows.

use crate::nodes::{NONE, Nodes};

/// Age of a tree, in rounds: those in which a shoot of full vigour grows this many times the greater of its height and
/// its crown's width.
const AGE: f64 = 1.5;
/// Least age, for trees of few and long steps.
const MIN_AGE: f64 = 40.0;
/// What has been saved for a step, but for rounding.
const READY: f64 = 1.0 - 1e-9;

/// How a node is joined to its parent.
#[derive(Clone, Copy, Debug)]
struct Link {
    parent: u32,
    /// Whether it continues its parent's axis.
    goes_on: bool,
}

/// Memory that is kept from tree to tree.
#[derive(Debug, Default)]
pub(crate) struct Vigor {
    links: Vec<Link>,
    /// Q of what each node bears, its own bud included, and the part of it on the axis that goes on.
    space: Vec<f64>,
    space_ahead: Vec<f64>,
    /// What a Q of 1 gets beyond each node: on the axis that goes on, and on its sides.
    ahead: Vec<f64>,
    aside: Vec<f64>,
    /// What the bud of each node has saved, in steps.
    saved: Vec<f64>,
    /// Rounds that have gone by, those in which no bud had its turn included.
    time: f64,
}

impl Vigor {
    /// Begins a tree.
    pub(crate) fn clear(&mut self) {
        self.links.clear();
        self.saved.clear();
        self.time = 0.0;
    }

    /// Whether a tree that grows by `step` has its age. `step` and `crown_width` are over its height.
    pub(crate) fn is_of_age(&self, step: f64, crown_width: f64) -> bool {
        self.time > (AGE * crown_width.max(1.0) / step).max(MIN_AGE)
    }

    /// Divides the resource of `nodes` among the buds `pulled`, which have space, and lets rounds go by until at least
    /// one of them has saved a step. `control` is λ.
    pub(crate) fn divide(&mut self, control: f64, pulled: &[u32], nodes: &Nodes) {
        self.link(nodes);
        self.flow(control, pulled, nodes);
        // What flows is as much as there are buds, so one of them gets at least 1, and the wait is short.
        let mut wait = f64::INFINITY;
        for &bud in pulled {
            wait = wait.min((READY - self.saved[bud as usize]) / self.rate(bud, nodes));
        }
        let rounds = wait.ceil().max(1.0);
        self.time += rounds;
        for &bud in pulled {
            let rate = self.rate(bud, nodes);
            let saved = &mut self.saved[bud as usize];
            *saved += rate * rounds;
        }
    }

    /// Whether `bud` has saved a step. It is then used, and the rest is kept.
    pub(crate) fn takes_step(&mut self, bud: u32) -> bool {
        let saved = &mut self.saved[bud as usize];
        let is_ready = *saved >= READY;
        if is_ready {
            *saved = (*saved - 1.0).max(0.0);
        }
        is_ready
    }

    /// Parts of a step that `bud` saves in a round: its share, and of that, for a tip, the part that `dominance` leaves it.
    fn rate(&self, bud: u32, nodes: &Nodes) -> f64 {
        let node = &nodes.all[bud as usize];
        let (share, part) = if nodes.is_tip(node) {
            (self.ahead[bud as usize], nodes.axes[node.axis as usize].vigor)
        } else {
            (self.aside[bud as usize], 1.0)
        };
        share.min(1.0) * part
    }

    /// Takes note of new nodes.
    fn link(&mut self, nodes: &Nodes) {
        for node in &nodes.all[self.links.len()..] {
            let goes_on = nodes.all.get(node.parent as usize).is_some_and(|parent| parent.axis == node.axis);
            // What a tip has left goes with the tip.
            let left = if goes_on { std::mem::take(&mut self.saved[node.parent as usize]) } else { 0.0 };
            self.links.push(Link { parent: node.parent, goes_on });
            self.saved.push(left);
        }
    }

    /// Q to the feet, and vigour back to the buds.
    fn flow(&mut self, control: f64, pulled: &[u32], nodes: &Nodes) {
        let Self { links, space, space_ahead, ahead, aside, .. } = self;
        let count = links.len();
        for list in [&mut *space, &mut *space_ahead] {
            list.clear();
            list.resize(count, 0.0);
        }
        for list in [&mut *ahead, &mut *aside] {
            list.resize(count, 0.0);
        }
        for &bud in pulled {
            space[bud as usize] = 1.0;
            if nodes.is_tip(&nodes.all[bud as usize]) {
                space_ahead[bud as usize] = 1.0;
            }
        }
        // Parents come before their children.
        for (index, link) in links.iter().enumerate().rev() {
            let own = space[index];
            if own > 0.0 && link.parent != NONE {
                space[link.parent as usize] += own;
                if link.goes_on {
                    space_ahead[link.parent as usize] += own;
                }
            }
        }
        for (index, link) in links.iter().enumerate() {
            let own = space[index];
            if own == 0.0 {
                continue;
            }
            let each = match (link.parent, link.goes_on) {
                (NONE, _) => 1.0,
                (parent, true) => ahead[parent as usize],
                (parent, false) => aside[parent as usize],
            };
            let on = space_ahead[index];
            let [main, side] = divided(each * own, control, on, own - on);
            (ahead[index], aside[index]) = (main / on.max(1.0), side / (own - on).max(1.0));
        }
    }
}

/// The parts of `vigor` for the axis that goes on and for its sides, by their Q. They add up to `vigor` where any Q is
/// greater than 0.
fn divided(vigor: f64, control: f64, ahead: f64, aside: f64) -> [f64; 2] {
    let (main, side) = (control * ahead, (1.0 - control) * aside);
    let sum = main + side;
    if sum > 0.0 {
        [vigor * (main / sum), vigor * (side / sum)]
    } else if ahead > 0.0 {
        // With λ = 0 and nothing on the sides, or λ = 1 and nothing ahead, all goes where there is space.
        [vigor, 0.0]
    } else {
        [0.0, vigor]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::EVEN;
    use glam::DVec3;

    /// A trunk of `count` nodes, each of which but the first and the last bears a shoot of three nodes.
    fn herringbone(count: u32) -> Nodes {
        let mut nodes = Nodes::default();
        let trunk = nodes.trunk();
        let mut node = NONE;
        let mut feet = Vec::new();
        for i in 0..count {
            node = nodes.push(DVec3::Z * f64::from(i), DVec3::Z, node, trunk);
            feet.push(node);
        }
        for &foot in &feet[1..feet.len() - 1] {
            let shoot = nodes.axis(1.0, DVec3::X);
            let mut node = foot;
            for _ in 0..3 {
                node = nodes.push(nodes.all[node as usize].place + DVec3::X, DVec3::X, node, shoot);
            }
        }
        nodes
    }

    fn tips(nodes: &Nodes) -> Vec<u32> {
        (0..nodes.all.len() as u32).filter(|&node| nodes.is_tip(&nodes.all[node as usize])).collect()
    }

    fn shares(control: f64, buds: &[u32], nodes: &Nodes) -> Vec<f64> {
        let mut vigor = Vigor::default();
        vigor.link(nodes);
        vigor.flow(control, buds, nodes);
        let share = |&bud: &u32| {
            let is_tip = nodes.is_tip(&nodes.all[bud as usize]);
            (if is_tip { &vigor.ahead } else { &vigor.aside })[bud as usize]
        };
        buds.iter().map(share).collect()
    }

    #[test]
    fn what_is_divided_is_kept() {
        for control in [0.0, 1e-300, 0.1, 0.5, 0.7, 1.0 - 1e-16, 1.0] {
            for (ahead, aside) in [(1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (3.0, 1.0), (1.0, 4000.0)] {
                let [main, side] = divided(2.5, control, ahead, aside);
                assert!((main + side - 2.5).abs() < 1e-15, "{control} {ahead} {aside}: {main} + {side}");
                assert!(main >= 0.0 && side >= 0.0);
            }
        }
        // 0.7 · 3 to 0.3 · 1.
        let [main, side] = divided(1.0, 0.7, 3.0, 1.0);
        assert!((main - 2.1 / 2.4).abs() < 1e-15 && (side - 0.3 / 2.4).abs() < 1e-15);
    }

    #[test]
    fn buds_get_as_much_as_there_are_of_them() {
        let nodes = herringbone(40);
        // Tips, and buds along a shoot and along the trunk.
        let mut buds = tips(&nodes);
        buds.extend([3, 7, 40, 41]);
        buds.sort_unstable();
        for control in [0.0, 0.2, 0.5, 0.8, 1.0] {
            let sum: f64 = shares(control, &buds, &nodes).iter().sum();
            assert!((sum - buds.len() as f64).abs() < 1e-9, "{control}: {sum} for {} buds", buds.len());
        }
        assert!(shares(EVEN, &buds, &nodes).iter().all(|share| (share - 1.0).abs() < 1e-12));
    }

    #[test]
    fn control_moves_the_resource_from_the_sides_to_the_leader() {
        let nodes = herringbone(10);
        let buds = tips(&nodes);
        // The trunk's tip has the lowest number.
        let leader = |control| shares(control, &buds, &nodes)[0];
        let leaders = [0.0, 0.3, 0.5, 0.7, 0.9, 1.0].map(leader);
        assert!(leaders.windows(2).all(|pair| pair[0] < pair[1]), "{leaders:?}");
        assert_eq!((leaders[0], leaders[5]), (0.0, buds.len() as f64));
    }

    #[test]
    fn buds_wait_until_they_have_saved_a_step() {
        let nodes = herringbone(10);
        let buds = tips(&nodes);
        let mut vigor = Vigor::default();
        let mut steps = vec![0_u32; buds.len()];
        for _ in 0..100 {
            vigor.divide(0.8, &buds, &nodes);
            for (steps, &bud) in steps.iter_mut().zip(&buds) {
                *steps += u32::from(vigor.takes_step(bud));
            }
        }
        let own = shares(0.8, &buds, &nodes);
        for (&steps, share) in steps.iter().zip(own) {
            assert!((f64::from(steps) - 100.0 * share.min(1.0)).abs() <= 1.0, "{steps} of {share}");
        }
        assert!(!vigor.is_of_age(0.01, 0.5) && vigor.is_of_age(0.02, 0.5), "of {} rounds", vigor.time);
        assert!(!vigor.is_of_age(0.02, 2.0), "wide crowns take longer");
    }

    #[test]
    fn nothing_is_waited_for_longer_than_it_takes() {
        let nodes = herringbone(3);
        let mut vigor = Vigor::default();
        // The trunk's bud alone has space: all goes there, whatever the control.
        for control in [0.0, 1.0] {
            vigor.divide(control, &[2], &nodes);
            assert!(vigor.takes_step(2) && !vigor.takes_step(2));
        }
        assert!(vigor.time == 2.0);
    }
}
