//! Links what a longest edge has cut off.

use glam::DVec3;

/// Sets of nodes that are linked.
#[derive(Debug, Default)]
pub(crate) struct Connector {
    set: Vec<u32>,
}

/// Nodes of a set from which the way to the others is looked for.
const FROM: usize = 64;
/// Distances that are looked at before cut-off sets are linked to the root as they are.
const MAX_LOOKS: usize = 20_000_000;

impl Connector {
    fn find(&mut self, mut i: u32) -> u32 {
        while self.set[i as usize] != i {
            let up = self.set[self.set[i as usize] as usize];
            self.set[i as usize] = up;
            i = up;
        }
        i
    }

    fn join(&mut self, a: u32, b: u32) -> bool {
        let (a, b) = (self.find(a), self.find(b));
        // The lowest number stands for its set.
        self.set[a.max(b) as usize] = a.min(b);
        a != b
    }

    /// Adds edges until there is a path between any two points: for each set of nodes that is cut off
    /// the shortest edge out of it that is found.
    pub(crate) fn connect(&mut self, points: &[DVec3], edges: &mut Vec<(u32, u32)>) {
        let count = points.len() as u32;
        self.set.clear();
        self.set.extend(0..count);
        let mut sets = count as usize;
        for &(a, b) in edges.iter() {
            sets -= usize::from(self.join(a, b));
        }
        let mut looks = 0;
        while sets > 1 {
            let first: Vec<u32> = (1..count).filter(|&i| self.find(i) == i).collect();
            for one in first {
                if self.find(one) != one {
                    continue;
                }
                let mut best = (f64::INFINITY, 0, one);
                if looks < MAX_LOOKS {
                    let members: Vec<u32> =
                        (one..count).filter(|&i| self.find(i) == one).take(FROM).collect();
                    for other in (0..count).filter(|&i| self.find(i) != one) {
                        for &from in &members {
                            let far = points[from as usize].distance_squared(points[other as usize]);
                            if far < best.0 {
                                best = (far, other, from);
                            }
                        }
                    }
                    looks += members.len() * count as usize;
                }
                let (_, a, b) = best;
                edges.push((a.min(b), a.max(b)));
                sets -= usize::from(self.join(a, b));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    #[test]
    fn sets_are_linked_where_they_are_nearest() {
        let points: Vec<DVec3> = [0.0, 1.0, 5.0, 6.0, 20.0].iter().map(|&x| dvec3(x, 0.0, 0.0)).collect();
        let mut edges = vec![(0, 1), (2, 3)];
        Connector::default().connect(&points, &mut edges);
        assert_eq!(edges, [(0, 1), (2, 3), (1, 2), (3, 4)]);
        Connector::default().connect(&[], &mut Vec::new());
    }

    #[test]
    fn many_single_nodes_come_to_an_end() {
        let points: Vec<DVec3> = (0..1_000_000).map(|i| dvec3(f64::from(i), 0.0, 0.0)).collect();
        let mut edges = Vec::new();
        Connector::default().connect(&points, &mut edges);
        assert_eq!(edges.len(), points.len() - 1);
    }
}
