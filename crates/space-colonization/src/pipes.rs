//! Thickness by the pipe model: each node has pipes for its own twigs, and the power `pipe` of a radius is the sum of those of what a node bears.
//!
//! Runions, Lane and Prusinkiewicz 2007, §3, after Murray 1927.

use crate::nodes::{NONE, Nodes};
use crate::params::Numbers;
use pleach_tree::math;

/// What the last node of a stem bears, in nodes: so that stems get thin.
const TIP: f64 = 0.05;

/// Least part of dominance that is missing.
const MAX_LEAD: f64 = 0.05;

/// Thickness of each node, and which way its stem goes on.
#[derive(Debug, Default)]
pub(crate) struct Pipes {
    /// Number of nodes that each node bears, itself included.
    pub(crate) borne: Vec<f64>,
    /// The thickest that each node bears, or [`NONE`] at tips.
    pub(crate) main: Vec<u32>,
    largest: f64,
    power: f64,
    thickness: f64,
    flare: f64,
}

impl Pipes {
    /// Measures `nodes`.
    pub(crate) fn measure(&mut self, n: &Numbers, nodes: &Nodes) {
        let count = nodes.all.len();
        self.borne.clear();
        self.borne.resize(count, 0.0);
        self.main.clear();
        self.main.resize(count, NONE);
        self.largest = 1.0;
        // By which factor more a side has to bear than its leader to be taken for the leader.
        let leads = 1.0 / math::powi((1.0 - n.dominance).max(MAX_LEAD), 2);
        for (index, node) in nodes.all.iter().enumerate().rev() {
            let borne = &mut self.borne;
            borne[index] += if self.main[index] == NONE { TIP } else { 1.0 };
            let own = borne[index];
            if node.parent == NONE {
                self.largest = self.largest.max(own);
                continue;
            }
            let parent = node.parent as usize;
            borne[parent] += own;
            // Ties go to the older node, which comes last here.
            let main = self.main[parent];
            let axis = nodes.all[parent].axis;
            let weight = |child: usize| if nodes.all[child].axis == axis { leads } else { 1.0 };
            if main == NONE || own * weight(index) >= borne[main as usize] * weight(main as usize) {
                self.main[parent] = index as u32;
            }
        }
        self.power = 1.0 / n.pipe;
        self.thickness = n.thickness;
        self.flare = n.flare;
    }

    /// Radius over the tree's height of a node at height `z`, with the flare of trunks near the ground.
    pub(crate) fn radius(&self, node: usize, z: f64, is_trunk: bool) -> f64 {
        let radius = self.thickness * math::pow(self.borne[node] / self.largest, self.power);
        // Weber and Penn 1995, §4.4: within an eighth of the height, a hundredfold base of the power.
        let near = 1.0 - 8.0 * z;
        if is_trunk && near > 0.0 && self.flare > 0.0 {
            radius * (1.0 + self.flare * (math::pow(100.0, near) - 1.0) / 100.0)
        } else {
            radius
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Id;
    use glam::DVec3;
    use pleach_tree::param::table::Parameters;

    #[test]
    fn a_fork_keeps_the_sum_of_powers() {
        let mut values = Numbers::space().defaults();
        values[Id::pipe.slot(0).index()] = 2.0;
        values[Id::flare.slot(0).index()] = 0.0;
        let n = Numbers::read(&values);
        let mut nodes = Nodes::default();
        let axis = nodes.axis(1.0, DVec3::Z);
        let foot = nodes.push(DVec3::ZERO, DVec3::Z, NONE, axis);
        let side = nodes.axis(1.0, DVec3::Z);
        nodes.push(DVec3::X, DVec3::X, foot, side);
        let top = nodes.push(DVec3::Z, DVec3::Z, foot, axis);
        nodes.push(DVec3::Z * 2.0, DVec3::Z, top, axis);
        let mut pipes = Pipes::default();
        pipes.measure(&n, &nodes);
        assert_eq!(pipes.borne, [2.1, TIP, 1.05, TIP]);
        assert_eq!(pipes.main, [top, NONE, 3, NONE], "the thickest goes on");
        let squared = |node: usize| pipes.radius(node, 1.0, true) * pipes.radius(node, 1.0, true);
        assert!((squared(0) / squared(2) - 2.1 / 1.05).abs() < 1e-12);
        assert!((pipes.radius(0, 0.0, true) - n.thickness).abs() < 1e-12);
    }
}
