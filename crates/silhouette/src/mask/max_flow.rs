//! The cheapest cut of a picture into two sides.
//!
//! Pixels are nodes of a graph whose edges join each to its eight neighbours; a source stands for one side and a
//! sink for the other (Boykov and Jolly, "Interactive graph cuts", 2001). The maximum flow is found with two trees
//! that grow from source and sink, and that are mended, not built again, after each path that joins them (Boykov and
//! Kolmogorov, "An experimental comparison of min-cut/max-flow algorithms for energy minimization in vision", 2004,
//! section 3). Capacities are whole numbers: the cut does not hang on rounding.

use std::collections::VecDeque;

/// Steps to the neighbours; the opposite of step `d` is `d ^ 1`.
const STEPS: [(i32, i32); 8] = [(1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (-1, -1), (1, -1), (-1, 1)];
/// The steps of which each pair of neighbours has one: right, down and both diagonals to the right.
pub(super) const FORWARD: [(usize, (i32, i32)); 4] = [(0, (1, 0)), (2, (0, 1)), (4, (1, 1)), (6, (1, -1))];

/// Capacity of what may not be cut. Sums of eight edges and a terminal stay far below the largest `i32`.
pub(super) const UNCUTTABLE: i32 = 1 << 26;
/// Largest capacity of an edge between pixels.
pub(super) const MAX_EDGE: i32 = 1 << 24;

/// Who the parent of a node is, if not a neighbour.
const TERMINAL: u8 = 8;
const ORPHAN: u8 = 9;
const NONE: u8 = 10;

#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Free,
    Source,
    Sink,
}

/// What is known of a node; side by side in memory, since a path asks for all of it.
#[derive(Clone, Copy)]
struct Node {
    /// What is left of the capacity from the source, or to the sink if negative.
    terminal: i32,
    /// Distance to the terminal, and when it was last known to be right.
    distance: u32,
    seen: u32,
    side: Side,
    parent: u8,
}

/// A picture's graph. Nodes have a rim of one pixel that no edge leads to, so that each has eight neighbours.
pub(super) struct GridGraph {
    stride: usize,
    steps: [isize; 8],
    /// What is left of the capacities towards the neighbours.
    edges: Vec<[i32; 8]>,
    nodes: Vec<Node>,
    now: u32,
    active: VecDeque<u32>,
    orphans: VecDeque<u32>,
}

impl GridGraph {
    /// A graph of `width` × `height` pixels without capacities.
    pub(super) fn new(width: u32, height: u32) -> Self {
        let stride = width as usize + 2;
        let count = stride * (height as usize + 2);
        Self {
            stride,
            steps: STEPS.map(|(dx, dy)| dy as isize * stride as isize + dx as isize),
            edges: vec![[0; 8]; count],
            nodes: vec![Node { terminal: 0, distance: 0, seen: 0, side: Side::Free, parent: NONE }; count],
            now: 0,
            active: VecDeque::new(),
            orphans: VecDeque::new(),
        }
    }

    fn node(&self, x: u32, y: u32) -> usize {
        (y as usize + 1) * self.stride + x as usize + 1
    }

    fn neighbor(&self, node: usize, step: usize) -> usize {
        node.wrapping_add_signed(self.steps[step])
    }

    /// Costs this if the pixel is on the sink's side, or −`for_source` if it is on the source's.
    pub(super) fn set_terminal(&mut self, x: u32, y: u32, for_source: i32) {
        let node = self.node(x, y);
        self.nodes[node].terminal = for_source.clamp(-UNCUTTABLE, UNCUTTABLE);
    }

    /// Costs this if the pixel and its neighbour at a step of [`FORWARD`] are on different sides.
    pub(super) fn set_edge(&mut self, x: u32, y: u32, step: usize, capacity: i32) {
        let node = self.node(x, y);
        let other = self.neighbor(node, step);
        let capacity = capacity.clamp(0, MAX_EDGE);
        self.edges[node][step] = capacity;
        self.edges[other][step ^ 1] = capacity;
    }

    /// Whether a pixel is on the source's side, after [`GridGraph::cut`].
    pub(super) fn is_source(&self, x: u32, y: u32) -> bool {
        self.nodes[self.node(x, y)].side == Side::Source
    }

    /// Finds the cheapest cut.
    pub(super) fn cut(&mut self) {
        for (i, node) in self.nodes.iter_mut().enumerate().filter(|(_, node)| node.terminal != 0) {
            node.side = if node.terminal > 0 { Side::Source } else { Side::Sink };
            (node.parent, node.distance) = (TERMINAL, 1);
            self.active.push_back(i as u32);
        }
        while let Some(node) = self.active.pop_front() {
            let node = node as usize;
            // A node stays active until all that it can reach is in its tree.
            while self.nodes[node].side != Side::Free {
                let Some((source, step)) = self.grow(node) else { break };
                self.now += 1;
                self.augment(source, step);
                while let Some(orphan) = self.orphans.pop_front() {
                    self.adopt(orphan as usize);
                }
            }
        }
    }

    /// Adds the free neighbours of a node to its tree. Returns the edge to the other tree if there is one, as the
    /// node on the source's side and the step from there.
    fn grow(&mut self, node: usize) -> Option<(usize, usize)> {
        let side = self.nodes[node].side;
        for step in 0..8 {
            let other = self.neighbor(node, step);
            let left =
                if side == Side::Source { self.edges[node][step] } else { self.edges[other][step ^ 1] };
            if left == 0 {
                continue;
            }
            if self.nodes[other].side == Side::Free {
                self.nodes[other].side = side;
                self.nodes[other].parent = (step ^ 1) as u8;
                self.nodes[other].distance = self.nodes[node].distance + 1;
                self.nodes[other].seen = self.nodes[node].seen;
                self.active.push_back(other as u32);
            } else if self.nodes[other].side != side {
                return Some(if side == Side::Source { (node, step) } else { (other, step ^ 1) });
            } else if self.nodes[other].seen <= self.nodes[node].seen
                && self.nodes[other].distance > self.nodes[node].distance + 1
            {
                // A shorter way to the terminal.
                self.nodes[other].parent = (step ^ 1) as u8;
                self.nodes[other].distance = self.nodes[node].distance + 1;
                self.nodes[other].seen = self.nodes[node].seen;
            }
        }
        None
    }

    /// Sends as much as can be sent along the path from source to sink over an edge.
    fn augment(&mut self, source: usize, step: usize) {
        let sink = self.neighbor(source, step);
        let mut most = self.edges[source][step];
        for (start, is_source) in [(source, true), (sink, false)] {
            let mut node = start;
            while self.nodes[node].parent != TERMINAL {
                let up = usize::from(self.nodes[node].parent);
                let next = self.neighbor(node, up);
                most = most.min(if is_source { self.edges[next][up ^ 1] } else { self.edges[node][up] });
                node = next;
            }
            most = most.min(self.nodes[node].terminal.abs());
        }
        self.edges[source][step] -= most;
        self.edges[sink][step ^ 1] += most;
        for (start, is_source) in [(source, true), (sink, false)] {
            let mut node = start;
            while self.nodes[node].parent != TERMINAL {
                let up = usize::from(self.nodes[node].parent);
                let next = self.neighbor(node, up);
                let (from, to) =
                    if is_source { ((next, up ^ 1), (node, up)) } else { ((node, up), (next, up ^ 1)) };
                self.edges[from.0][from.1] -= most;
                self.edges[to.0][to.1] += most;
                if self.edges[from.0][from.1] == 0 {
                    self.nodes[node].parent = ORPHAN;
                    self.orphans.push_back(node as u32);
                }
                node = next;
            }
            self.nodes[node].terminal -= if is_source { most } else { -most };
            if self.nodes[node].terminal == 0 {
                self.nodes[node].parent = ORPHAN;
                self.orphans.push_back(node as u32);
            }
        }
    }

    /// Finds another parent of a node, or sets it free with all that hang on it.
    fn adopt(&mut self, node: usize) {
        let side = self.nodes[node].side;
        let mut best: Option<(u32, usize)> = None;
        for step in 0..8 {
            let other = self.neighbor(node, step);
            let left =
                if side == Side::Source { self.edges[other][step ^ 1] } else { self.edges[node][step] };
            if left > 0
                && self.nodes[other].side == side
                && let Some(distance) = self.find_distance(other)
                && best.is_none_or(|(least, _)| distance < least)
            {
                best = Some((distance, step));
            }
        }
        if let Some((distance, step)) = best {
            self.nodes[node].parent = step as u8;
            self.nodes[node].distance = distance + 1;
            self.nodes[node].seen = self.now;
            return;
        }
        for step in 0..8 {
            let other = self.neighbor(node, step);
            if self.nodes[other].side != side {
                continue;
            }
            let left =
                if side == Side::Source { self.edges[other][step ^ 1] } else { self.edges[node][step] };
            if left > 0 {
                self.active.push_back(other as u32);
            }
            if usize::from(self.nodes[other].parent) == step ^ 1 {
                self.nodes[other].parent = ORPHAN;
                self.orphans.push_back(other as u32);
            }
        }
        self.nodes[node].side = Side::Free;
        self.nodes[node].parent = NONE;
    }

    /// Steps from a node to its terminal; `None` if it hangs on an orphan. Marks the way, so that it is walked once.
    fn find_distance(&mut self, start: usize) -> Option<u32> {
        let (mut node, mut steps) = (start, 0);
        let known = loop {
            if self.nodes[node].seen == self.now {
                break self.nodes[node].distance;
            }
            match self.nodes[node].parent {
                TERMINAL => {
                    self.nodes[node].seen = self.now;
                    self.nodes[node].distance = 1;
                    break 1;
                }
                ORPHAN | NONE => return None,
                up => node = self.neighbor(node, usize::from(up)),
            }
            steps += 1;
        };
        let whole = known + steps;
        let (mut node, mut distance) = (start, whole);
        while self.nodes[node].seen != self.now {
            self.nodes[node].seen = self.now;
            self.nodes[node].distance = distance;
            distance -= 1;
            node = self.neighbor(node, usize::from(self.nodes[node].parent));
        }
        Some(whole)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::chance;
    use super::*;

    struct Problem {
        width: u32,
        height: u32,
        terminals: Vec<i32>,
        edges: Vec<(u32, u32, usize, i32)>,
    }

    impl Problem {
        fn random(width: u32, height: u32, salt: u32) -> Self {
            let pick = |x, y, s: u32, most: f64| (most * chance(x, y, 100 * salt + s)) as i32;
            let places = || (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
            let terminals = places().map(|(x, y)| pick(x, y, 1, 41.0) - 20).collect();
            let mut edges = Vec::new();
            for (x, y) in places() {
                for (step, (dx, dy)) in FORWARD {
                    let (Some(a), Some(b)) = (x.checked_add_signed(dx), y.checked_add_signed(dy)) else {
                        continue;
                    };
                    if a < width && b < height {
                        edges.push((x, y, step, pick(x, y, 2 + step as u32, 16.0)));
                    }
                }
            }
            Self { width, height, terminals, edges }
        }

        fn cost(&self, is_source: impl Fn(u32, u32) -> bool) -> i32 {
            let at = |i: usize| is_source(i as u32 % self.width, i as u32 / self.width);
            let sides: i32 = (0..self.terminals.len())
                .map(|i| if at(i) { (-self.terminals[i]).max(0) } else { self.terminals[i].max(0) })
                .sum();
            let cut = |&(x, y, step, capacity): &(u32, u32, usize, i32)| {
                let (dx, dy) = STEPS[step];
                let other = is_source(x.wrapping_add_signed(dx), y.wrapping_add_signed(dy));
                if is_source(x, y) == other { 0 } else { capacity }
            };
            sides + self.edges.iter().map(cut).sum::<i32>()
        }

        fn cut(&self) -> GridGraph {
            let mut graph = GridGraph::new(self.width, self.height);
            for (i, &terminal) in self.terminals.iter().enumerate() {
                graph.set_terminal(i as u32 % self.width, i as u32 / self.width, terminal);
            }
            self.edges.iter().for_each(|&(x, y, step, capacity)| graph.set_edge(x, y, step, capacity));
            graph.cut();
            graph
        }
    }

    #[test]
    fn no_cut_of_a_small_picture_is_cheaper() {
        for salt in 0..120 {
            let (width, height) = [(1, 1), (4, 1), (1, 5), (3, 3), (4, 3), (2, 6)][salt as usize % 6];
            let problem = Problem::random(width, height, salt);
            let graph = problem.cut();
            let found = problem.cost(|x, y| graph.is_source(x, y));
            let all = 0..1_u32 << (width * height);
            let least = all.map(|sides| problem.cost(|x, y| sides >> (y * width + x) & 1 == 1)).min();
            assert_eq!(Some(found), least, "{width} × {height}, {salt}");
        }
    }

    /// In a larger picture no capacity is left between the sides, which is what makes a cut the cheapest.
    #[test]
    fn nothing_more_can_flow_through_a_large_picture() {
        for salt in 0..4 {
            let problem = Problem::random(61, 47, 1000 + salt);
            let graph = problem.cut();
            let mut flow = 0;
            for y in 0..47 {
                for x in 0..61 {
                    let (node, i) = (graph.node(x, y), (y * 61 + x) as usize);
                    let (left, whole) = (graph.nodes[node].terminal, problem.terminals[i]);
                    if whole > 0 {
                        flow += whole - left;
                    }
                    let source = graph.is_source(x, y);
                    assert!(source || left <= 0, "the source reaches {x}, {y}");
                    assert!(!source || left >= 0, "{x}, {y} reaches the sink");
                    for step in 0..8 {
                        let other = graph.neighbor(node, step);
                        let over = source && graph.nodes[other].side != Side::Source;
                        assert!(!over || graph.edges[node][step] == 0, "{x}, {y}, {step}");
                    }
                }
            }
            assert_eq!(flow, problem.cost(|x, y| graph.is_source(x, y)));
        }
    }
}
