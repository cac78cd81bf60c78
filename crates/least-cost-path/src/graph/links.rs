//! Links: to the nearest node in each sector (Yao), or to all within reach.

use super::cells::Cells;
use super::meter::{Meter, OutOfSteps};
use super::nodes::Nodes;
use glam::DVec3;
use rayon::prelude::*;

/// Sectors around a node, at most.
pub(crate) const SECTORS: usize = 8;
/// Cells that reach over the longest edge.
const REACH: usize = 2;
/// No neighbor.
const NOBODY: u32 = u32::MAX;
/// Fewer nodes than this are compared one by one.
const FEW: usize = 200;
/// Comparisons per node that are covered by the node's own steps: a constant, and a factor on the cube of
/// the longest edge over the mean spacing. Twice what cells hold that are not coarse.
const FREE_LOOKS: (f64, f64) = (64.0, 32.0);
/// Comparisons beyond those that count as one step.
const LOOKS_PER_STEP: u64 = 8;
/// Nodes beyond which links are found on several threads.
const MANY: usize = 20_000;

/// How space around a node is cut into sectors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sectors {
    /// By the signs of the differences.
    Octants,
    /// By the largest difference and its sign.
    CubeFaces,
}

impl Sectors {
    /// The sector of `d`, from 0; zero counts as positive.
    fn index(self, d: DVec3) -> usize {
        match self {
            Self::Octants => {
                usize::from(d.x < 0.0) | usize::from(d.y < 0.0) << 1 | usize::from(d.z < 0.0) << 2
            }
            Self::CubeFaces => {
                let a = d.abs();
                let (axis, value) = if a.x >= a.y && a.x >= a.z {
                    (0, d.x)
                } else if a.y >= a.z {
                    (1, d.y)
                } else {
                    (2, d.z)
                };
                2 * axis + usize::from(value < 0.0)
            }
        }
    }
}

/// How nodes are linked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Linking {
    /// To the nearest in each sector.
    Yao(Sectors),
    /// To all within reach.
    Threshold,
}

/// Finds the links of a graph.
#[derive(Debug, Default)]
pub(crate) struct Linker {
    /// Links, each once, the smaller number first.
    pub(crate) edges: Vec<(u32, u32)>,
    /// Nodes cell by cell.
    order: Vec<u32>,
    points: Vec<DVec3>,
    starts: Vec<u32>,
    found: Vec<[u32; SECTORS]>,
    nearest: Vec<[u32; SECTORS]>,
}

impl Linker {
    /// Links `nodes` that are at most `longest` apart, and those along axes. `link` is the longest edge
    /// over the mean spacing. Where nodes lie crowded in a large box, what is looked at takes steps of
    /// `meter`, before it is looked at.
    pub(crate) fn link(
        &mut self,
        nodes: &Nodes,
        linking: Linking,
        (longest, link): (f64, f64),
        parallel: bool,
        meter: &Meter,
    ) -> Result<(), OutOfSteps> {
        self.edges.clear();
        let cells = self.sort(&nodes.points, longest);
        if !meter.take(self.crowding(&cells, link)) {
            return Err(OutOfSteps::Crowding);
        }
        match linking {
            Linking::Yao(sectors) => self.yao(nodes, &cells, |d| sectors.index(d), longest, parallel),
            Linking::Threshold => self.threshold(nodes, &cells, longest),
        }
        if !nodes.chain.is_empty() {
            // Axes are never cut, however far apart their nodes are.
            self.edges.extend(&nodes.chain);
            self.edges.sort_unstable();
            self.edges.dedup();
        }
        Ok(())
    }

    /// Steps for what is looked at beyond what nodes pay for.
    fn crowding(&self, cells: &Cells, link: f64) -> u64 {
        if !cells.is_coarse || self.points.len() < FEW {
            return 0;
        }
        let free = (FREE_LOOKS.0 + FREE_LOOKS.1 * link * link * link) as u64;
        let mut looks = 0_u64;
        for cell in 0..cells.len() {
            let here = u64::from(self.starts[cell + 1] - self.starts[cell]);
            if here > 0 {
                let row =
                    |(first, last): (usize, usize)| u64::from(self.starts[last + 1] - self.starts[first]);
                let around: u64 = cells.rows(cells.place(cell), REACH).map(row).sum();
                looks = looks.saturating_add(here.saturating_mul(around.saturating_sub(free)));
            }
        }
        looks / LOOKS_PER_STEP
    }

    /// Sorts nodes into cells, [`REACH`] of which reach over `longest`.
    fn sort(&mut self, points: &[DVec3], longest: f64) -> Cells {
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = points.iter().fold(start, |(low, high), p| (low.min(*p), high.max(*p)));
        let max = if points.len() < FEW { 1 } else { 4 * points.len() };
        let cells = Cells::new(low, high, longest / REACH as f64, max);
        self.starts.clear();
        self.starts.resize(cells.len() + 1, 0);
        let cell = |p: &DVec3| cells.number(cells.at(*p));
        points.iter().for_each(|p| self.starts[cell(p) + 1] += 1);
        for i in 1..self.starts.len() {
            self.starts[i] += self.starts[i - 1];
        }
        self.order.clear();
        self.order.resize(points.len(), 0);
        for (i, p) in points.iter().enumerate().rev() {
            // Counted down from the end of each run, so that the runs keep the order of nodes.
            let end = &mut self.starts[cell(p) + 1];
            *end -= 1;
            self.order[*end as usize] = i as u32;
        }
        // Every start has become the next one's.
        self.starts.remove(0);
        self.starts.push(points.len() as u32);
        self.points.clear();
        self.points.extend(self.order.iter().map(|&i| points[i as usize]));
        cells
    }

    fn yao(
        &mut self,
        nodes: &Nodes,
        cells: &Cells,
        sector: impl Fn(DVec3) -> usize + Sync,
        longest: f64,
        parallel: bool,
    ) {
        let mut found = std::mem::take(&mut self.found);
        found.clear();
        found.resize(nodes.points.len(), [NOBODY; SECTORS]);
        let nearest = |place: usize, found: &mut [u32; SECTORS]| {
            let p = self.points[place];
            let this = self.order[place];
            let cluster = nodes.clusters[this as usize];
            let mut best = [longest * longest; SECTORS];
            for (first, last) in cells.rows(cells.at(p), REACH) {
                for other in self.starts[first] as usize..self.starts[last + 1] as usize {
                    let d = self.points[other] - p;
                    let (far, to) = (d.length_squared(), sector(d));
                    if far > best[to] || other == place {
                        continue;
                    }
                    let that = self.order[other];
                    // Of two at one distance the lower number is taken.
                    if far == best[to] && that > found[to] {
                        continue;
                    }
                    let its = nodes.clusters[that as usize];
                    if its == cluster || its == 0 || cluster == 0 {
                        best[to] = far;
                        found[to] = that;
                    }
                }
            }
        };
        if parallel && found.len() > MANY {
            found.par_iter_mut().enumerate().for_each(|(place, found)| nearest(place, found));
        } else {
            found.iter_mut().enumerate().for_each(|(place, found)| nearest(place, found));
        }
        self.nearest.clear();
        self.nearest.resize(found.len(), [NOBODY; SECTORS]);
        for (place, found) in found.iter().enumerate() {
            self.nearest[self.order[place] as usize] = *found;
        }
        self.found = found;
        for (i, row) in self.nearest.iter().enumerate() {
            let i = i as u32;
            for &j in row.iter().filter(|&&j| j != NOBODY) {
                // A link that both make is kept once.
                if i < j {
                    self.edges.push((i, j));
                } else if !self.nearest[j as usize].contains(&i) {
                    self.edges.push((j, i));
                }
            }
        }
    }

    fn threshold(&mut self, nodes: &Nodes, cells: &Cells, longest: f64) {
        for (place, p) in self.points.iter().enumerate() {
            let this = self.order[place];
            let cluster = nodes.clusters[this as usize];
            for (first, last) in cells.rows(cells.at(*p), REACH) {
                for other in self.starts[first] as usize..self.starts[last + 1] as usize {
                    let that = self.order[other];
                    let its = nodes.clusters[that as usize];
                    let is_allowed = its == cluster || its == 0 || cluster == 0;
                    if that > this
                        && is_allowed
                        && self.points[other].distance_squared(*p) <= longest * longest
                    {
                        self.edges.push((this, that));
                    }
                }
            }
        }
    }

    /// Links that every node makes, on average, before those that two make are counted once.
    #[cfg(test)]
    fn made(&self) -> usize {
        self.nearest.iter().flatten().filter(|&&j| j != NOBODY).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    pub(crate) fn nodes(points: &[[f64; 3]]) -> Nodes {
        Nodes {
            points: points.iter().map(|&p| p.into()).collect(),
            parts: vec![0; points.len()],
            clusters: vec![0; points.len()],
            ..Nodes::default()
        }
    }

    fn linked(nodes: &Nodes, sector: impl Fn(DVec3) -> usize + Sync) -> (Vec<(u32, u32)>, usize) {
        let mut linker = Linker::default();
        let cells = linker.sort(&nodes.points, 1e3);
        linker.yao(nodes, &cells, sector, 1e3, false);
        linker.edges.sort_unstable();
        (linker.edges.clone(), linker.made())
    }

    fn pairs(list: &toml::Value) -> Vec<(u32, u32)> {
        let number = |v: &toml::Value| v.as_integer().unwrap() as u32;
        list.as_array().unwrap().iter().map(|pair| (number(&pair[0]), number(&pair[1]))).collect()
    }

    fn points(list: &toml::Value) -> Vec<[f64; 3]> {
        let number = |v: &toml::Value| v.as_float().unwrap_or_else(|| v.as_integer().unwrap() as f64);
        let point = |p: &toml::Value| {
            let p: Vec<f64> = p.as_array().unwrap().iter().map(number).collect();
            [p[0], p[1], p.get(2).copied().unwrap_or(0.0)]
        };
        list.as_array().unwrap().iter().map(point).collect()
    }

    fn vectors() -> toml::Table {
        include_str!("../../tests/data/vectors.toml").parse().unwrap()
    }

    /// Sector k of n: the angle from +x, counter-clockwise, in [360 k/n, 360 (k+1)/n).
    fn plane(n: f64) -> impl Fn(DVec3) -> usize {
        move |d| {
            let turn = d.y.atan2(d.x) / std::f64::consts::TAU;
            ((turn + if turn < 0.0 { 1.0 } else { 0.0 }) * n) as usize
        }
    }

    #[test]
    fn graphs_in_the_plane_are_as_worked_out() {
        let vectors = &vectors()["yao"]["plane"];
        let nodes = nodes(&points(&vectors["points"]));
        let (edges, made) = linked(&nodes, plane(6.0));
        assert_eq!((edges, made), (pairs(&vectors["six_edges"]), 28));
        assert_eq!(linked(&nodes, plane(4.0)).0, pairs(&vectors["four_edges"]));
    }

    #[test]
    fn graphs_in_space_are_as_worked_out() {
        let yao = &vectors()["yao"];
        let nodes_in_space = nodes(&points(&yao["space"]["points"]));
        assert_eq!(linked(&nodes_in_space, |d| Sectors::Octants.index(d)).0, pairs(&yao["space"]["edges"]));
        // The cube's corners, x fastest, and its center: all ties and zeros.
        let mut corners: Vec<[f64; 3]> =
            (0..8).map(|i| [f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)]).collect();
        corners.push([0.5; 3]);
        assert_eq!(linked(&nodes(&corners), |d| Sectors::Octants.index(d)).0, pairs(&yao["cube"]["edges"]));
    }

    #[test]
    fn cells_and_pairs_find_the_same_links() {
        let key = pleach_tree::Key::root(3);
        let many: Vec<[f64; 3]> =
            (0..3000).map(|i| [key.unit(0, i), key.unit(1, i), 3.0 * key.unit(2, i)]).collect();
        let nodes = nodes(&many);
        let longest = 0.2;
        for linking in [Linking::Yao(Sectors::Octants), Linking::Yao(Sectors::CubeFaces), Linking::Threshold]
        {
            let mut linker = Linker::default();
            linker.link(&nodes, linking, (longest, 2.0), false, &Meter::new(0)).unwrap();
            let mut edges = linker.edges.clone();
            edges.sort_unstable();
            let mut expected = Vec::new();
            for (i, &p) in nodes.points.iter().enumerate() {
                let mut best = [(longest * longest, NOBODY); SECTORS];
                for (j, &q) in nodes.points.iter().enumerate().filter(|&(j, _)| j != i) {
                    let pair = (i.min(j) as u32, i.max(j) as u32);
                    match linking {
                        Linking::Threshold if p.distance(q) <= longest => expected.push(pair),
                        Linking::Yao(sectors) if p.distance_squared(q) <= longest * longest => {
                            let best = &mut best[sectors.index(q - p)];
                            *best = if p.distance_squared(q) < best.0 {
                                (p.distance_squared(q), j as u32)
                            } else {
                                *best
                            };
                        }
                        _ => {}
                    }
                }
                let found = best.iter().filter(|(_, j)| *j != NOBODY);
                expected.extend(found.map(|&(_, j)| (j.min(i as u32), j.max(i as u32))));
            }
            expected.sort_unstable();
            expected.dedup();
            assert!(edges == expected, "{linking:?}: {} and {}", edges.len(), expected.len());
        }
    }

    #[test]
    fn many_nodes_link_alike_on_any_number_of_threads() {
        let key = pleach_tree::Key::root(4);
        let many: Vec<[f64; 3]> =
            (0..2 * MANY as u32).map(|i| [key.unit(0, i), key.unit(1, i), key.unit(2, i)]).collect();
        let nodes = nodes(&many);
        let edges = |parallel: bool| {
            let mut linker = Linker::default();
            linker
                .link(&nodes, Linking::Yao(Sectors::Octants), (0.06, 2.0), parallel, &Meter::new(0))
                .unwrap();
            linker.edges
        };
        let (one, several) = (edges(false), edges(true));
        assert!(one == several);
        // Published for 33,000: 5.36 links a node.
        let each = one.len() as f64 / many.len() as f64;
        assert!((5.0..6.0).contains(&each), "{each}");
    }

    #[test]
    fn zero_counts_as_positive() {
        assert_eq!(Sectors::Octants.index(dvec3(0.0, -0.0, -1.0)), 4);
        assert_eq!(Sectors::CubeFaces.index(dvec3(-2.0, 2.0, 1.0)), 1);
    }
}
