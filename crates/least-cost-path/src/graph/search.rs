//! The paths of least cost from a root.

use super::links::Linker;
use crate::purpose::WEIGHT;
use glam::DVec3;
use pleach_tree::Key;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// No predecessor: the root, and what is not reached.
pub(crate) const NOBODY: u32 = u32::MAX;

/// How edges are weighed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Weights {
    /// How much of the weight is chance, from 0 to 1.
    pub(crate) randomness: f64,
    /// Weight of edges along an axis over that of others.
    pub(crate) axis_cost: f64,
}

/// A weighted graph, and the paths in it to its root, which is node 0.
#[derive(Debug, Default)]
pub(crate) struct Search {
    starts: Vec<u32>,
    /// Neighbors of every node, with weights.
    neighbors: Vec<(u32, f64)>,
    cost: Vec<f64>,
    /// The next node on the way to the root.
    pub(crate) toward_root: Vec<u32>,
    is_wanted: Vec<bool>,
    heap: BinaryHeap<Reverse<(u64, u32)>>,
}

impl Search {
    /// Takes in the links of `linker` with weights drawn by their ends, those in `chain`, which is
    /// sorted, as an axis.
    pub(crate) fn weigh(
        &mut self,
        points: &[DVec3],
        linker: &Linker,
        chain: &[(u32, u32)],
        weights: Weights,
        key: Key,
    ) {
        let Weights { randomness, axis_cost } = weights;
        let draws = key.child(WEIGHT, 0);
        self.take(points.len(), &linker.edges, |a, b| {
            let length = points[a as usize].distance(points[b as usize]);
            let is_axis = axis_cost < 1.0 && chain.binary_search(&(a, b)).is_ok();
            if is_axis {
                length * axis_cost
            } else {
                length * (1.0 - randomness + randomness * draws.child(0, a).unit(0, b))
            }
        });
    }

    /// Takes in a graph of `count` nodes.
    pub(crate) fn take(&mut self, count: usize, edges: &[(u32, u32)], weight: impl Fn(u32, u32) -> f64) {
        self.starts.clear();
        self.starts.resize(count + 1, 0);
        for &(a, b) in edges {
            self.starts[a as usize] += 1;
            self.starts[b as usize] += 1;
        }
        let mut end = 0;
        for start in &mut self.starts {
            end += *start;
            *start = end;
        }
        self.neighbors.clear();
        self.neighbors.resize(2 * edges.len(), (0, 0.0));
        // Filled from the ends of the runs, so that each start ends up where its run begins.
        for &(a, b) in edges {
            let weight = weight(a, b);
            for (from, to) in [(a, b), (b, a)] {
                let place = &mut self.starts[from as usize];
                *place -= 1;
                self.neighbors[*place as usize] = (to, weight);
            }
        }
    }

    /// Finds the way from each of `wanted` to the root; returns how many have none.
    pub(crate) fn run(&mut self, wanted: &[u32]) -> usize {
        let count = self.starts.len() - 1;
        self.cost.clear();
        self.cost.resize(count, f64::INFINITY);
        self.toward_root.clear();
        self.toward_root.resize(count, NOBODY);
        self.is_wanted.clear();
        self.is_wanted.resize(count, false);
        wanted.iter().for_each(|&node| self.is_wanted[node as usize] = true);
        let mut left = wanted.len();
        self.heap.clear();
        self.cost[0] = 0.0;
        self.heap.push(Reverse((0, 0)));
        while let Some(Reverse((bits, node))) = self.heap.pop() {
            // The bits of floats that are not negative are in the order of the floats.
            let cost = f64::from_bits(bits);
            if cost > self.cost[node as usize] {
                continue;
            }
            if std::mem::take(&mut self.is_wanted[node as usize]) {
                left -= 1;
                if left == 0 {
                    break;
                }
            }
            let run = self.starts[node as usize] as usize..self.starts[node as usize + 1] as usize;
            for &(to, weight) in &self.neighbors[run] {
                let through = cost + weight;
                if through < self.cost[to as usize] {
                    self.cost[to as usize] = through;
                    self.toward_root[to as usize] = node;
                    self.heap.push(Reverse((through.to_bits(), to)));
                }
            }
        }
        left
    }

    /// Whether there is a way from `node` to the root, once it has been looked for.
    pub(crate) fn is_reached(&self, node: u32) -> bool {
        node == 0 || self.toward_root[node as usize] != NOBODY
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vectors() -> toml::Table {
        include_str!("../../tests/data/vectors.toml").parse().unwrap()
    }

    fn floats(list: &toml::Value) -> Vec<f64> {
        list.as_array().unwrap().iter().map(|v| v.as_float().unwrap()).collect()
    }

    #[test]
    fn paths_are_as_worked_out() {
        let vectors = vectors();
        let edges: Vec<(u32, u32)> = vectors["yao"]["plane"]["six_edges"]
            .as_array()
            .unwrap()
            .iter()
            .map(|pair| (pair[0].as_integer().unwrap() as u32, pair[1].as_integer().unwrap() as u32))
            .collect();
        let table = &vectors["least_cost"];
        let (u, lengths) = (floats(&table["u"]), floats(&table["lengths"]));
        let weighed = |name: &str| -> Vec<f64> {
            let weight = |(u, length): (&f64, &f64)| match name {
                "by_length" => *length,
                "mixed" => length * (0.25 + 0.75 * u),
                _ => *u,
            };
            u.iter().zip(&lengths).map(weight).collect()
        };
        for name in ["by_length", "mixed", "by_chance"] {
            let weights = weighed(name);
            let mut search = Search::default();
            let number = |a, b| edges.iter().position(|&edge| edge == (a, b)).unwrap();
            search.take(8, &edges, |a, b| weights[number(a, b)]);
            let all: Vec<u32> = (0..8).collect();
            assert_eq!(search.run(&all), 0);
            let expected = &table[name];
            for (found, cost) in search.cost.iter().zip(floats(&expected["cost"])) {
                assert!((found - cost).abs() < 2e-6, "{name}: {found} for {cost}");
            }
            let before: Vec<i64> = search.toward_root.iter().map(|&i| i64::from(i as i32)).collect();
            let told: Vec<i64> =
                expected["predecessor"].as_array().unwrap().iter().map(|v| v.as_integer().unwrap()).collect();
            assert_eq!(before, told, "{name}");
        }
    }

    #[test]
    fn what_is_not_linked_is_counted() {
        let mut search = Search::default();
        search.take(4, &[(0, 1), (2, 3)], |_, _| 1.0);
        assert_eq!(search.run(&[1, 3]), 1);
        assert!(search.is_reached(1) && !search.is_reached(3));
        search.take(1, &[], |_, _| 1.0);
        assert_eq!(search.run(&[]), 0);
    }
}
