//! Which piece of stem is nearest to a point, without a look at all of them.

use super::cone::Cone;
use glam::DVec3;

/// Pieces in a box that is not divided further.
const FEW: usize = 4;

/// Pieces in boxes in boxes.
#[derive(Debug)]
pub(super) struct Boxes<'a> {
    cones: &'a [Cone],
    /// Numbers of pieces, those of a box one after the other.
    order: Vec<u32>,
    /// The whole first, then the halves of each box before those of its halves.
    nodes: Vec<Node>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    low: DVec3,
    high: DVec3,
    /// Of `order`.
    first: u32,
    count: u32,
    /// Number of the first half, which the second follows; 0 for none.
    halves: u32,
}

impl<'a> Boxes<'a> {
    pub(super) fn new(cones: &'a [Cone]) -> Self {
        let mut boxes = Self { cones, order: (0..cones.len() as u32).collect(), nodes: Vec::new() };
        if cones.is_empty() {
            return boxes;
        }
        boxes.nodes.push(boxes.around(0, cones.len()));
        let mut next = 0;
        while next < boxes.nodes.len() {
            boxes.divide(next);
            next += 1;
        }
        boxes
    }

    fn around(&self, first: usize, count: usize) -> Node {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for &cone in &self.order[first..first + count] {
            let (from, to) = self.cones[cone as usize].bounds(0.0);
            (low, high) = (low.min(from), high.max(to));
        }
        Node { low, high, first: first as u32, count: count as u32, halves: 0 }
    }

    /// Halves a box across its longest side.
    fn divide(&mut self, number: usize) {
        let Node { low, high, first, count, .. } = self.nodes[number];
        let (first, count) = (first as usize, count as usize);
        if count <= FEW {
            return;
        }
        let size = high - low;
        let axis = (0..3).fold(0, |best, axis| if size[axis] > size[best] { axis } else { best });
        let cones = self.cones;
        let middle = |i: u32| cones[i as usize].from[axis] + cones[i as usize].to[axis];
        let half = count / 2;
        self.order[first..first + count]
            .select_nth_unstable_by(half, |a, b| middle(*a).total_cmp(&middle(*b)).then(a.cmp(b)));
        self.nodes[number].halves = self.nodes.len() as u32;
        let halves = [self.around(first, half), self.around(first + half, count - half)];
        self.nodes.extend(halves);
    }

    /// Number of the piece whose surface is nearest to `p`, by signed distances: inside of two that one in which `p` lies
    /// deeper. `None` where there are no pieces.
    pub(super) fn nearest(&self, p: DVec3) -> Option<u32> {
        let mut best: Option<(f64, u32)> = None;
        let mut open = vec![0_u32];
        if self.nodes.is_empty() {
            return None;
        }
        while let Some(number) = open.pop() {
            let node = self.nodes[number as usize];
            // Nothing in a box is nearer than the box; of one that holds the point nothing is known.
            let outside = p.distance(p.clamp(node.low, node.high));
            if best.is_some_and(|(least, _)| outside > 0.0 && outside > least) {
                continue;
            }
            if node.halves == 0 {
                let own = node.first as usize..(node.first + node.count) as usize;
                for &cone in &self.order[own] {
                    let found = (self.cones[cone as usize].distance(p), cone);
                    if best.is_none_or(|best| found < best) {
                        best = Some(found);
                    }
                }
            } else {
                let far = |half: u32| {
                    let Node { low, high, .. } = self.nodes[half as usize];
                    p.distance_squared(p.clamp(low, high))
                };
                let (a, b) = (node.halves, node.halves + 1);
                open.extend(if far(a) <= far(b) { [b, a] } else { [a, b] });
            }
        }
        best.map(|(_, cone)| cone)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    #[test]
    fn the_nearest_is_that_of_all() {
        let f = |i: usize, step: f64| 4.0 * ((i as f64 * step).fract() - 0.5);
        let place = |i: usize| dvec3(f(i, 0.618_034), f(i, 0.754_878), f(i, 0.569_84));
        let cones: Vec<Cone> = (0..200)
            .map(|i| Cone::new(place(i), place(i) + 0.2 * place(i + 7), [0.01 + 0.001 * i as f64, 0.05]))
            .collect();
        let boxes = Boxes::new(&cones);
        for i in 1000..1500 {
            let p = place(i);
            let all = (0..cones.len()).map(|c| cones[c].distance(p)).fold(f64::INFINITY, f64::min);
            let found = boxes.nearest(p).unwrap();
            assert_eq!(cones[found as usize].distance(p), all, "{p}");
        }
        assert_eq!(Boxes::new(&[]).nearest(DVec3::ZERO), None);
    }
}
