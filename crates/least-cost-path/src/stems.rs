//! Stems along the paths of a skeleton.

use crate::numbers::{Id, Numbers};
use crate::skeleton::Skeleton;
use crate::thickness::{FLOOR, Thickness};
use glam::DVec3;
use pleach_tree::spline::Cubic;
use pleach_tree::{Blame, GrowError, Key, Knot, Limits, Stem, StemKind, Tree};

/// No point.
const NOBODY: u32 = u32::MAX;
/// Chords that a piece is measured by.
const CHORDS: u32 = 4;

/// A stem about to be made: from the point before `first` through it and on.
#[derive(Clone, Copy, Debug)]
struct Waiting {
    first: u32,
    parent: Option<u32>,
    level: u16,
}

/// Memory of making stems.
#[derive(Debug, Default)]
pub(crate) struct Stems {
    thickness: Thickness,
    /// The first point after each, and the next one after the same, in the order of the points.
    first_child: Vec<u32>,
    sibling: Vec<u32>,
    /// Where the curve passes each point, and how far along its stem.
    passed: Vec<(DVec3, f64)>,
    waiting: Vec<Waiting>,
    nodes: Vec<u32>,
    children: Vec<u32>,
    /// Number of the endpoint at each point.
    end_at: Vec<u32>,
    /// What the draws at the tip of each stem follow from, in the order of the stems.
    pub(crate) tips: Vec<Key>,
}

impl Stems {
    /// Appends the stems of `skeleton` to `tree`. At each point the longest path goes on and the
    /// others begin stems of their own; `kind` is what begins at the root.
    pub(crate) fn build(
        &mut self,
        skeleton: &Skeleton,
        n: &Numbers,
        kind: StemKind,
        limits: &Limits,
        tree: &mut Tree,
    ) -> Result<(), GrowError> {
        self.thickness.measure(skeleton, n);
        let count = skeleton.points.len();
        self.first_child.clear();
        self.first_child.resize(count, NOBODY);
        self.sibling.clear();
        self.sibling.resize(count, NOBODY);
        for node in (1..count).rev() {
            let parent = skeleton.parents[node] as usize;
            self.sibling[node] = self.first_child[parent];
            self.first_child[parent] = node as u32;
        }
        self.passed.clear();
        self.passed.extend(skeleton.points.iter().map(|&p| (p, 0.0)));
        self.end_at.clear();
        self.end_at.resize(count, NOBODY);
        for (i, end) in skeleton.ends.iter().enumerate() {
            self.end_at[end.node as usize] = i as u32;
        }
        self.tips.clear();
        self.waiting.clear();
        let foot = Waiting { first: 0, parent: None, level: 0 };
        self.branch(0, NOBODY, skeleton, foot);
        while let Some(waiting) = self.waiting.pop() {
            self.stem(waiting, skeleton, n, kind, limits, tree)?;
        }
        Ok(())
    }

    /// Lets stems wait that begin at `node`, but for `but`; those with the longest paths come first.
    fn branch(&mut self, node: u32, but: u32, skeleton: &Skeleton, like: Waiting) {
        self.children.clear();
        let mut child = self.first_child[node as usize];
        while child != NOBODY {
            if child != but {
                self.children.push(child);
            }
            child = self.sibling[child as usize];
        }
        let length = |child: u32| self.thickness.behind[child as usize] + skeleton.edge(child as usize);
        self.children.sort_by(|&a, &b| length(a).total_cmp(&length(b)).then(b.cmp(&a)));
        self.waiting.extend(self.children.iter().map(|&first| Waiting { first, ..like }));
    }

    /// The point after `node` with the longest path.
    fn next(&self, node: u32, skeleton: &Skeleton) -> Option<u32> {
        let mut best = None;
        let mut child = self.first_child[node as usize];
        while child != NOBODY {
            let length = self.thickness.behind[child as usize] + skeleton.edge(child as usize);
            if best.is_none_or(|(longest, _)| length > longest) {
                best = Some((length, child));
            }
            child = self.sibling[child as usize];
        }
        best.map(|(_, child)| child)
    }

    /// The largest radius of the paths that go on from `node`.
    fn radius(&self, node: u32, floor: f64) -> f64 {
        let mut radius = floor;
        let mut child = self.first_child[node as usize];
        while child != NOBODY {
            radius = radius.max(self.thickness.through[child as usize]);
            child = self.sibling[child as usize];
        }
        radius
    }

    fn stem(
        &mut self,
        waiting: Waiting,
        skeleton: &Skeleton,
        n: &Numbers,
        kind: StemKind,
        limits: &Limits,
        tree: &mut Tree,
    ) -> Result<(), GrowError> {
        let from = skeleton.parents[waiting.first as usize];
        self.nodes.clear();
        self.nodes.push(from);
        let mut node = Some(waiting.first);
        while let Some(this) = node {
            self.nodes.push(this);
            node = self.next(this, skeleton);
        }
        let blame = || Blame(vec![Id::branching.slot_name(0), Id::levels.slot_name(0)]);
        if tree.stems.len() >= limits.stems {
            return Err(GrowError::TooManyStems { limit: limits.stems, blame: blame() });
        }
        if tree.knots.len() + self.nodes.len() > limits.knots {
            return Err(GrowError::TooManyKnots { limit: limits.knots, blame: blame() });
        }
        let this = Waiting { first: NOBODY, parent: Some(tree.stems.len() as u32), level: waiting.level + 1 };
        let (start, offset) = self.passed[from as usize];
        tree.stems.push(Stem {
            parent: waiting.parent,
            level: waiting.level,
            kind: if waiting.parent.is_some() && kind == StemKind::Trunk { StemKind::Branch } else { kind },
            number: 0,
            offset: if waiting.parent.is_some() { offset } else { 0.0 },
            first_knot: tree.knots.len() as u32,
            knot_count: self.nodes.len() as u32,
        });
        let last = self.nodes.len() - 1;
        let point = |i: usize| if i == 0 { start } else { skeleton.points[self.nodes[i] as usize] };
        // Handles are a third along the straight edges, where a uniform cubic spline through the same
        // corners has them too; so moving the knots alone leads from one to the other.
        let knot = |i: usize, radius: f64| {
            let here = point(i);
            let before = if i > 0 { point(i - 1) } else { here };
            let after = if i < last { point(i + 1) } else { here };
            let is_inner = i > 0 && i < last;
            let corner =
                if is_inner { (before + after - here * 2.0) * (n.smoothing / 6.0) } else { DVec3::ZERO };
            let toward = |other: DVec3| here + (other - here) / 3.0;
            Knot { point: here + corner, handle_in: toward(before), handle_out: toward(after), radius }
        };
        let floor = FLOOR * n.thickness;
        let mut along = 0.0;
        for i in 0..=last {
            let radius = match i {
                0 => self.thickness.through[waiting.first as usize],
                _ => self.radius(self.nodes[i], floor),
            };
            let next = knot(i, radius);
            if i > 0 {
                let before = tree.knots[tree.knots.len() - 1];
                along +=
                    Cubic::new(before.point, before.handle_out, next.handle_in, next.point).length(CHORDS);
                self.passed[self.nodes[i] as usize] = (next.point, along);
            }
            tree.knots.push(next);
        }
        // Every path began at an endpoint.
        let end = self.end_at[self.nodes[last] as usize];
        self.tips.push(skeleton.ends[end as usize].key);
        for i in (1..last).rev() {
            let (node, next) = (self.nodes[i], self.nodes[i + 1]);
            self.branch(node, next, skeleton, this);
        }
        Ok(())
    }
}
