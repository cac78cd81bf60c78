//! How thick stems are: by the length of path behind.

use crate::numbers::Numbers;
use crate::skeleton::Skeleton;
use pleach_tree::math;

/// Radii of a skeleton.
#[derive(Debug, Default)]
pub(crate) struct Thickness {
    /// For each point the length of the longest path behind it, in meters.
    pub(crate) behind: Vec<f64>,
    /// For each point the radius, at the next point towards the root, of the paths through both.
    pub(crate) through: Vec<f64>,
    length: Vec<f64>,
}

/// The least radius over `thickness`.
pub(crate) const FLOOR: f64 = 0.05;

impl Thickness {
    /// Follows the paths of `skeleton` from its endpoints to its root.
    pub(crate) fn measure(&mut self, skeleton: &Skeleton, n: &Numbers) {
        let count = skeleton.points.len();
        self.behind.clear();
        self.behind.resize(count, 0.0);
        self.through.clear();
        self.through.resize(count, FLOOR * n.thickness);
        let levels = skeleton.ends.iter().map(|end| usize::from(end.level)).max().unwrap_or(0);
        for level in 0..levels {
            let taper = n.taper[level];
            if n.taper[..level].contains(&taper) {
                continue; // Its paths were followed with those of the same taper.
            }
            self.length.clear();
            self.length.resize(count, -1.0);
            let same = skeleton.ends.iter().filter(|end| n.taper[usize::from(end.level) - 1] == taper);
            same.for_each(|end| self.length[end.node as usize] = 0.0);
            for node in (1..count).rev() {
                if self.length[node] < 0.0 {
                    continue;
                }
                let length = self.length[node] + skeleton.edge(node);
                let radius = n.thickness * math::pow(length / n.taper_length, taper);
                self.through[node] = self.through[node].max(radius);
                let parent = skeleton.parents[node] as usize;
                self.length[parent] = self.length[parent].max(length);
                self.behind[node] = self.behind[node].max(self.length[node]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::skeleton::End;
    use glam::{DVec3, dvec3};
    use pleach_tree::Key;
    use pleach_tree::param::table::Parameters;

    #[test]
    fn radii_follow_the_length_behind() {
        // The worked example: paths 7-3-6-0, 5-4-1-0 and 2-0 of a plane graph.
        let plane =
            [(0.0, 0.0), (2.1, 1.0), (4.0, 0.4), (1.0, 3.2), (3.1, 3.6), (5.2, 2.9), (-1.2, 1.9), (1.8, 5.1)];
        let order = [0, 6, 3, 7, 1, 4, 5, 2];
        let toward = [0, 0, 0, 6, 1, 4, 0, 3];
        let place = |node: usize| order.iter().position(|&o| o == node).unwrap() as u32;
        let skeleton = Skeleton {
            points: order.iter().map(|&o| dvec3(plane[o].0, plane[o].1, 0.0)).collect(),
            parents: order.iter().map(|&o| place(toward[o])).collect(),
            ends: [7, 5, 2]
                .iter()
                .map(|&o| End { node: place(o), level: 1, outward: DVec3::Z, key: Key::root(0), life: 0 })
                .collect(),
        };
        let mut n = Numbers::read(&Numbers::space().defaults());
        (n.thickness, n.taper_length, n.taper) = (1.0, 1.0, [0.3; 8]);
        let mut thickness = Thickness::default();
        thickness.measure(&skeleton, &n);
        for (node, s) in [(1, 4.999_272), (3, 2.061_553), (4, 2.213_594), (6, 4.616_939), (5, 0.0)] {
            assert!((thickness.behind[place(node) as usize] - s).abs() < 1e-5, "{node}");
        }
        // At the root the thickest of the three; at 1 and 6 what comes through 4 and 3.
        for (through, w) in [(1, 1.817_381), (4, 1.620_586), (3, 1.582_363), (5, 1.269_198), (7, 1.242_391)] {
            assert!((thickness.through[place(through) as usize] - w).abs() < 1e-5, "{through}");
        }
    }
}
