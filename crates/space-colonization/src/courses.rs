//! The courses of stems: branches are straightened, and all stems smoothed.
//!
//! A shoot turns to whatever points are left, so that branches meander and curl where trees' are nearly straight. The
//! tips stay where they have grown to; what is between is moved. Runions and others 2007, §3, move each node half-way to
//! its parent, which makes branching angles smaller in the same way.

use crate::nodes::{NONE, Nodes};
use crate::pipes::Pipes;
use glam::DVec3;

/// How often nodes are moved towards the middle of their neighbours, and by which part of the way.
const SMOOTHINGS: u32 = 2;
const SMOOTHING: f64 = 0.5;

/// Memory that is kept from tree to tree.
#[derive(Debug, Default)]
pub(crate) struct Courses {
    /// Where each node is in the end, over the tree's height.
    pub(crate) places: Vec<DVec3>,
    /// The nodes of one stem that may be moved, from its foot, and their distances along it.
    chain: Vec<(u32, f64)>,
}

impl Courses {
    /// Moves the nodes of branches by the part `straightness` of the way to the line from foot to tip, then each
    /// between its neighbours. Trunks have a course of their own.
    pub(crate) fn lay(&mut self, straightness: f64, nodes: &Nodes, pipes: &Pipes) {
        self.places.clear();
        self.places.extend(nodes.all.iter().map(|node| node.place));
        if straightness > 0.0 {
            // Parents come before their children.
            for (index, node) in nodes.all.iter().enumerate() {
                let begins = |parent: usize| nodes.keeps_place(parent) || pipes.main[parent] != index as u32;
                if node.parent != NONE && !nodes.keeps_place(index) && begins(node.parent as usize) {
                    self.straighten(straightness, index as u32, nodes, pipes);
                }
            }
        }
        self.smooth(nodes, pipes);
    }

    /// Straightens the stem that begins with `first`. It moves with the node that it leaves.
    fn straighten(&mut self, straightness: f64, first: u32, nodes: &Nodes, pipes: &Pipes) {
        let from = nodes.all[first as usize].parent as usize;
        self.chain.clear();
        let (mut node, mut far, mut before) = (first, 0.0, nodes.all[from].place);
        while node != NONE {
            let place = nodes.all[node as usize].place;
            far += before.distance(place);
            self.chain.push((node, far));
            before = place;
            node = pipes.main[node as usize];
        }
        let foot = self.places[from];
        let shift = foot - nodes.all[from].place;
        let tip = before;
        for &(node, at) in &self.chain {
            let part = at / far.max(1e-12);
            let moved = nodes.all[node as usize].place + shift * (1.0 - part);
            self.places[node as usize] = moved.lerp(foot.lerp(tip, part), straightness);
        }
    }

    fn smooth(&mut self, nodes: &Nodes, pipes: &Pipes) {
        for _ in 0..SMOOTHINGS {
            for (index, node) in nodes.all.iter().enumerate() {
                let main = pipes.main[index];
                if node.parent != NONE && main != NONE {
                    let middle = (self.places[node.parent as usize] + self.places[main as usize]) / 2.0;
                    self.places[index] = self.places[index].lerp(middle, SMOOTHING);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Numbers;
    use pleach_tree::param::table::Parameters;

    /// A trunk of ten nodes that wanders, and a branch from its third one that goes round a quarter of a circle and bears
    /// a shoot half-way.
    fn crooked() -> (Nodes, Pipes) {
        let mut nodes = Nodes::default();
        let trunk = nodes.trunk();
        let mut node = NONE;
        for i in 0..10 {
            let place = DVec3::new(0.05 * f64::from(i % 2), 0.0, 0.1 * f64::from(i));
            node = nodes.push(place, DVec3::Z, node, trunk);
        }
        nodes.note_given();
        let branch = nodes.axis(1.0, DVec3::X);
        let mut node = 2;
        for step in 1..=6 {
            let (sin, cos) = pleach_tree::trig::sin_cos(f64::from(step) * 0.25);
            node = nodes.push(DVec3::new(sin, 0.0, 1.2 - cos), DVec3::X, node, branch);
        }
        let shoot = nodes.axis(0.5, DVec3::Y);
        nodes.push(DVec3::new(0.7, 0.2, 0.5), DVec3::Y, 12, shoot);
        let mut pipes = Pipes::default();
        pipes.measure(&Numbers::read(&Numbers::space().defaults()), &nodes);
        (nodes, pipes)
    }

    fn places(straightness: f64) -> Vec<DVec3> {
        let (nodes, pipes) = crooked();
        let mut courses = Courses::default();
        courses.lay(straightness, &nodes, &pipes);
        courses.places
    }

    /// How far `place` is from the line from `foot` to `tip`.
    fn off(place: DVec3, foot: DVec3, tip: DVec3) -> f64 {
        let along = (tip - foot).normalize();
        (place - foot).reject_from(along).length()
    }

    #[test]
    fn branches_are_straightened_between_foot_and_tip() {
        let (nodes, _) = crooked();
        let off_of = |straightness| {
            let places = places(straightness);
            assert_eq!(places[15], nodes.all[15].place, "the tip stays");
            assert_eq!(places[0], nodes.all[0].place, "the foot stays");
            off(places[12], places[2], places[15])
        };
        let (grown, half, straight) = (off_of(0.0), off_of(0.5), off_of(1.0));
        assert!(
            grown > 0.15 && (half / grown - 0.5).abs() < 0.1 && straight < 0.01,
            "{grown} {half} {straight}"
        );
    }

    #[test]
    fn trunks_keep_their_course_and_shoots_move_with_their_branch() {
        let (as_grown, straight) = (places(0.0), places(1.0));
        assert_eq!(as_grown[..10], straight[..10]);
        // The shoot's tip stays; its foot is its branch's node.
        assert_eq!(as_grown[16], straight[16]);
        assert!(as_grown[12].distance(straight[12]) > 0.1);
    }
}
