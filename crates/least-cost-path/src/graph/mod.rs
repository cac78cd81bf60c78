//! One graph: nodes in a volume, links, weights, and the paths from its endpoints to its root.

mod cells;
mod connect;
mod links;
mod meter;
mod nodes;
mod search;

pub(crate) use links::{Linking, Sectors};
pub(crate) use meter::{Meter, OutOfSteps};
pub(crate) use nodes::ON_AXIS;
pub(crate) use search::Weights;

use crate::numbers::Numbers;
use crate::purpose::ENDPOINT;
use crate::volume::Volume;
use connect::Connector;
use glam::DVec3;
use links::Linker;
use nodes::Nodes;
use pleach_tree::Key;
use search::{NOBODY, Search};

/// How graphs of a species are made.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rules {
    pub(crate) spacing: f64,
    pub(crate) linking: Linking,
    /// Longest edge over the mean spacing.
    pub(crate) link: f64,
    pub(crate) weights: Weights,
    pub(crate) parallel: bool,
}

impl Rules {
    pub(crate) fn new(n: &Numbers, parallel: bool) -> Self {
        let sectors = if n.sectors == 0.0 { Sectors::Octants } else { Sectors::CubeFaces };
        let linking = if n.graph == 0.0 { Linking::Yao(sectors) } else { Linking::Threshold };
        let weights = Weights { randomness: n.weight_randomness, axis_cost: n.axis_cost };
        Self { spacing: n.spacing, linking, link: n.link, weights, parallel }
    }
}

/// Which nodes a graph ends in.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Ends {
    /// `count` of the nodes in the shell, at random.
    Random { count: usize, shell: f64 },
    /// The lowest node, and `laterals` of those within this distance of the path there, at random.
    Taproot { laterals: usize, within: f64 },
}

/// The work of a graph.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Nodes of all graphs.
    pub nodes: usize,
    /// Edges of all graphs.
    pub edges: usize,
    /// Darts thrown.
    pub throws: usize,
    /// Endpoints with a path.
    pub endpoints: usize,
    /// Endpoints without one.
    pub lost: usize,
}

impl std::ops::AddAssign for Work {
    fn add_assign(&mut self, other: Self) {
        self.nodes += other.nodes;
        self.edges += other.edges;
        self.throws += other.throws;
        self.endpoints += other.endpoints;
        self.lost += other.lost;
    }
}

/// Paths of one graph or of several, one after the other.
#[derive(Debug, Default)]
pub(crate) struct Paths {
    /// Points, and which of the same graph's is the next on the way to its root, counted from the
    /// graph's first; [`ROOT`] for those next to the root.
    pub(crate) points: Vec<(DVec3, u32)>,
    /// Which of its graph's points each endpoint is, and its number in the graph.
    pub(crate) ends: Vec<(u32, u32)>,
}

/// Stands for the root of a graph, which is not among its [`Paths`].
pub(crate) const ROOT: u32 = u32::MAX;

/// Makes graphs, one after the other, in memory of its own.
#[derive(Debug, Default)]
pub(crate) struct Graph {
    nodes: Nodes,
    linker: Linker,
    connector: Connector,
    search: Search,
    candidates: Vec<(u64, u32)>,
    wanted: Vec<u32>,
    place: Vec<u32>,
    trace: Vec<u32>,
}

impl Graph {
    /// Grows a graph of `count` nodes around `root` and appends its paths to `paths`; what it takes
    /// beyond what nodes pay for is taken from `meter`.
    #[expect(clippy::too_many_arguments, reason = "all of them are what a graph is made of")]
    pub(crate) fn grow(
        &mut self,
        volume: &Volume,
        root: DVec3,
        (count, ends): (usize, Ends),
        rules: &Rules,
        key: Key,
        meter: &Meter,
        paths: &mut Paths,
    ) -> Result<Work, OutOfSteps> {
        let thrown = self.nodes.throw(volume, root, (count, rules.spacing), key, meter)?;
        let longest = rules.link * thrown.mean_spacing;
        self.linker.link(&self.nodes, rules.linking, (longest, rules.link), rules.parallel, meter)?;
        if rules.linking != Linking::Threshold {
            self.connector.connect(&self.nodes.points, &mut self.linker.edges);
        }
        self.search.weigh(&self.nodes.points, &self.linker, &self.nodes.chain, rules.weights, key);
        self.wanted.clear();
        let lost = match ends {
            Ends::Random { count, shell } => {
                self.choose(volume, count, shell, key);
                self.search.run(&self.wanted)
            }
            Ends::Taproot { laterals, within } => self.choose_roots(laterals, within, key),
        };
        self.trace(paths);
        Ok(Work {
            nodes: self.nodes.points.len(),
            edges: self.linker.edges.len(),
            throws: thrown.throws,
            endpoints: self.wanted.len() - lost,
            lost,
        })
    }

    /// Chooses endpoints: those nodes whose draws are the smallest, cluster by cluster.
    fn choose(&mut self, volume: &Volume, count: usize, shell: f64, key: Key) {
        let draws = key.child(ENDPOINT, 0);
        let clusters = volume.clusters.len().max(1);
        for cluster in 0..clusters {
            let share = count / clusters + if cluster == 0 { count % clusters } else { 0 };
            let may_end = |i: &usize| {
                let part = self.nodes.parts[*i];
                let here = clusters == 1 || usize::from(self.nodes.clusters[*i]) == cluster + 1;
                here && part != ON_AXIS && volume.may_end(self.nodes.points[*i], usize::from(part), shell)
            };
            self.candidates.clear();
            let drawn = (1..self.nodes.points.len()).filter(may_end);
            self.candidates.extend(drawn.map(|i| (draws.bits(0, i as u32), i as u32)));
            self.take_smallest(share);
        }
        // Where nothing lies in the shell, one branch grows as far as it can.
        let far = |i: usize| self.nodes.points[i].distance_squared(self.nodes.points[0]);
        let farthest =
            (1..self.nodes.points.len()).max_by(|&a, &b| far(a).total_cmp(&far(b)).then(b.cmp(&a)));
        if self.wanted.is_empty() && count > 0 {
            self.wanted.extend(farthest.map(|i| i as u32));
        }
    }

    fn take_smallest(&mut self, count: usize) {
        if count < self.candidates.len() {
            self.candidates.select_nth_unstable(count);
            self.candidates.truncate(count);
        }
        self.candidates.sort_unstable();
        self.wanted.extend(self.candidates.iter().map(|(_, i)| i));
    }

    /// The lowest node, and some near the way to it.
    fn choose_roots(&mut self, laterals: usize, within: f64, key: Key) -> usize {
        let points = &self.nodes.points;
        let lowest = (1..points.len()).min_by(|&a, &b| points[a].z.total_cmp(&points[b].z));
        let Some(lowest) = lowest else { return 0 };
        self.wanted.push(lowest as u32);
        self.search.run(&self.wanted);
        let mut way = vec![points[lowest]];
        let mut node = self.search.toward_root[lowest];
        while node != NOBODY {
            way.push(points[node as usize]);
            node = self.search.toward_root[node as usize];
        }
        let draws = key.child(ENDPOINT, 0);
        self.candidates.clear();
        let near = |i: &usize| {
            let p = points[*i];
            *i != lowest && way.iter().any(|q| q.distance_squared(p) <= within * within)
        };
        let drawn = (1..points.len()).filter(near);
        self.candidates.extend(drawn.map(|i| (draws.bits(0, i as u32), i as u32)));
        self.take_smallest(laterals);
        self.search.run(&self.wanted)
    }

    /// Walks from every endpoint to the root, or to a path that was walked before.
    fn trace(&mut self, paths: &mut Paths) {
        let base = paths.points.len();
        self.place.clear();
        self.place.resize(self.nodes.points.len(), ROOT);
        for &end in &self.wanted {
            if !self.search.is_reached(end) {
                continue;
            }
            self.trace.clear();
            let mut node = end;
            while node != 0 && self.place[node as usize] == ROOT {
                self.trace.push(node);
                node = self.search.toward_root[node as usize];
            }
            let mut next = if node == 0 { ROOT } else { self.place[node as usize] };
            for &node in self.trace.iter().rev() {
                let place = (paths.points.len() - base) as u32;
                paths.points.push((self.nodes.points[node as usize], next));
                self.place[node as usize] = place;
                next = place;
            }
            paths.ends.push((self.place[end as usize], end));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::volume::{Part, Side, Solid};

    fn rules(linking: Linking, link: f64) -> Rules {
        let weights = Weights { randomness: 0.75, axis_cost: 1.0 };
        Rules { spacing: 0.7, linking, link, weights, parallel: false }
    }

    fn portion(cos: f64) -> Volume {
        let part = Part::new(Solid::Portion { radius: 1.0, cos }, DVec3::Z, DVec3::Z, true);
        Volume::from_part(part, Side::Above)
    }

    fn grown(
        graph: &mut Graph,
        volume: &Volume,
        wanted: (usize, Ends),
        rules: &Rules,
        seed: u64,
    ) -> (Paths, Work) {
        let (mut paths, meter) = (Paths::default(), Meter::new(1_000_000));
        let work = graph.grow(volume, DVec3::Z, wanted, rules, Key::root(seed), &meter, &mut paths);
        (paths, work.unwrap())
    }

    /// Nodes, edges and lost endpoints of 100 graphs in which every node is an endpoint.
    fn many(linking: Linking, link: f64, alpha: f64) -> Work {
        let volume = portion((alpha * std::f64::consts::PI).cos());
        let mut work = Work::default();
        let mut graph = Graph::default();
        for seed in 0..100 {
            let ends = Ends::Random { count: 1000, shell: 1.0 };
            work += grown(&mut graph, &volume, (100, ends), &rules(linking, link), seed).1;
        }
        work
    }

    #[test]
    fn yao_graphs_are_whole_and_thresholds_may_cut_them() {
        let yao = many(Linking::Yao(Sectors::Octants), 2.1, 0.25);
        let each = yao.edges as f64 / yao.nodes as f64;
        assert!((4.0..4.8).contains(&each) && yao.lost == 0, "published 4.1 to 4.5: {each}");
        // As many edges by a threshold leave several nodes of a hundred without a path.
        let threshold = many(Linking::Threshold, 1.42, 0.25);
        let each = threshold.edges as f64 / threshold.nodes as f64;
        let lost = threshold.lost as f64 / threshold.nodes as f64;
        assert!((0.03..0.15).contains(&lost), "published 0.08: {lost} at {each} edges");
        assert_eq!(many(Linking::Threshold, 2.4, 0.4).lost, 0);
    }

    #[test]
    fn paths_are_a_tree_with_all_endpoints() {
        let ends = Ends::Random { count: 12, shell: 1.0 };
        let rules = rules(Linking::Yao(Sectors::Octants), 2.1);
        let (paths, work) = grown(&mut Graph::default(), &portion(0.0), (300, ends), &rules, 1);
        assert_eq!((work.endpoints, paths.ends.len()), (12, 12));
        for (i, (_, next)) in paths.points.iter().enumerate() {
            assert!(*next == ROOT || (*next as usize) < i, "the way to the root comes first");
        }
    }

    #[test]
    fn one_more_endpoint_leaves_the_others() {
        let rules = rules(Linking::Yao(Sectors::Octants), 2.1);
        let ends = |count| {
            let ends = Ends::Random { count, shell: 0.5 };
            let (paths, _) = grown(&mut Graph::default(), &portion(0.0), (300, ends), &rules, 1);
            paths.ends.iter().map(|(_, node)| *node).collect::<Vec<_>>()
        };
        assert_eq!(ends(10), ends(11)[..10]);
        assert!(ends(10_000).len() < 300);
    }
}
