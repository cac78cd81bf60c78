//! The paths of all graphs as one tree of points.

use crate::graph::{Paths, ROOT};
use glam::DVec3;
use pleach_tree::Key;

/// An endpoint of a graph.
#[derive(Clone, Copy, Debug)]
pub(crate) struct End {
    /// Its number among the points.
    pub(crate) node: u32,
    /// Level of the graph, from 1.
    pub(crate) level: u16,
    /// From the root of its graph to it, of unit length.
    pub(crate) outward: DVec3,
    /// What its draws follow from.
    pub(crate) key: Key,
    /// Generations that it lives to see.
    pub(crate) life: u32,
}

/// A tree of points; each comes after the one towards the root, and the root first.
#[derive(Debug, Default)]
pub(crate) struct Skeleton {
    pub(crate) points: Vec<DVec3>,
    /// The next point towards the root; the root is its own.
    pub(crate) parents: Vec<u32>,
    pub(crate) ends: Vec<End>,
}

impl Skeleton {
    /// Nothing but a root at the origin.
    pub(crate) fn clear(&mut self) {
        self.points.clear();
        self.parents.clear();
        self.ends.clear();
        self.points.push(DVec3::ZERO);
        self.parents.push(0);
    }

    /// Appends the paths of one graph, whose root is point `root`; `end` makes an endpoint of its
    /// number among the points, its number in the graph and its direction.
    pub(crate) fn append(
        &mut self,
        root: u32,
        points: &[(DVec3, u32)],
        ends: &[(u32, u32)],
        end: impl Fn(u32, u32, DVec3) -> End,
    ) {
        let base = self.points.len() as u32;
        let from = self.points[root as usize];
        for &(point, next) in points {
            self.points.push(point);
            self.parents.push(if next == ROOT { root } else { base + next });
        }
        for &(place, number) in ends {
            let node = base + place;
            let outward = (self.points[node as usize] - from).try_normalize().unwrap_or(DVec3::Z);
            self.ends.push(end(node, number, outward));
        }
    }

    /// The length of the edge from `node` towards the root.
    pub(crate) fn edge(&self, node: usize) -> f64 {
        self.points[node].distance(self.points[self.parents[node] as usize])
    }
}

/// Paths of several graphs, with the places where each one's end.
#[derive(Debug, Default)]
pub(crate) struct Batch {
    pub(crate) paths: Paths,
    pub(crate) stops: Vec<(usize, usize)>,
}

impl Batch {
    pub(crate) fn clear(&mut self) {
        self.paths.points.clear();
        self.paths.ends.clear();
        self.stops.clear();
    }

    /// Ends the run of the graph that was just grown.
    pub(crate) fn stop(&mut self) {
        self.stops.push((self.paths.points.len(), self.paths.ends.len()));
    }
}
