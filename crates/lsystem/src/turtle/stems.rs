//! Stems as splines, written in place.

use super::survey::Survey;
use glam::DVec3;
use pleach_tree::turtle::Turtle;
use pleach_tree::{Knot, Stem, StemKind, Tree};

/// Handles of a piece as a part of its length.
const HANDLE: f64 = 1.0 / 3.0;

/// A branch while it is drawn.
#[derive(Clone, Copy, Debug)]
struct Growing {
    /// Index in the tree; `None` if nothing of it is drawn.
    stem: Option<u32>,
    /// The nearest stem that is drawn, itself or an ancestor.
    host: Option<u32>,
    /// Number of pieces so far.
    pieces: u32,
    /// Their length, metres.
    length: f64,
    /// Length of the last piece, metres.
    last: f64,
}

/// All branches of a string.
#[derive(Debug)]
pub(super) struct Stems {
    branches: Vec<Growing>,
}

impl Stems {
    /// Makes room in `tree` for all stems, parents before children; `None` if there are none.
    pub(super) fn new(survey: &Survey, tree: &mut Tree) -> Option<Self> {
        let drawn = survey.branches.iter().filter(|b| b.pieces > 0);
        let knots: usize = drawn.clone().map(|b| b.pieces as usize + 1).sum();
        tree.stems.reserve_exact(drawn.count());
        tree.knots.reserve_exact(knots);
        let mut branches: Vec<Growing> = Vec::with_capacity(survey.branches.len());
        for branch in &survey.branches {
            let parent = branch.parent.and_then(|p| branches[p as usize].host);
            let stem = (branch.pieces > 0).then_some(tree.stems.len() as u32);
            if stem.is_some() {
                let level = parent.map_or(0, |p| tree.stems[p as usize].level.saturating_add(1));
                let kind = if parent.is_some() { StemKind::Branch } else { StemKind::Trunk };
                let (first_knot, knot_count) = (tree.knots.len() as u32, branch.pieces + 1);
                tree.stems.push(Stem { parent, level, kind, number: 0, offset: 0.0, first_knot, knot_count });
                let zero = DVec3::ZERO;
                let blank = Knot { point: zero, handle_in: zero, handle_out: zero, radius: 0.0 };
                tree.knots.resize(tree.knots.len() + knot_count as usize, blank);
            }
            let host = stem.or(parent);
            branches.push(Growing { stem, host, pieces: 0, length: 0.0, last: 0.0 });
        }
        (!tree.stems.is_empty()).then_some(Self { branches })
    }

    /// Branch `branch` leaves `parent` here.
    pub(super) fn begin(&mut self, branch: u32, parent: u32) {
        // The length of a branch that is not drawn is that of its host where it left it.
        self.branches[branch as usize].length = self.branches[parent as usize].length;
    }

    /// Branch `branch` goes on beside `last` after a gap.
    pub(super) fn beside(&mut self, branch: u32, last: u32, tree: &Tree) {
        let offset = self.branches[last as usize].stem.map(|stem| tree.stems[stem as usize].offset);
        self.branches[branch as usize].length = offset.unwrap_or(0.0);
    }

    pub(super) fn pieces(&self, branch: u32) -> u32 {
        self.branches[branch as usize].pieces
    }

    /// The stem that leaves of `branch` hang on.
    pub(super) fn host(&self, branch: u32) -> u32 {
        self.branches[branch as usize].host.unwrap_or(0)
    }

    /// Adds a piece from `from` ahead; returns the index of the knot where it begins.
    ///
    /// A smooth piece leaves along its own direction and arrives along the next one's.
    pub(super) fn piece(
        &mut self,
        from: &Turtle,
        length: f64,
        radius: f64,
        is_smooth: bool,
        branch: u32,
        tree: &mut Tree,
    ) -> usize {
        let Growing { stem: Some(stem), pieces, length: before, last, .. } = self.branches[branch as usize]
        else {
            return 0;
        };
        let stem = &mut tree.stems[stem as usize];
        let knots = &mut tree.knots[stem.first_knot as usize..];
        let (at, reach) = (pieces as usize, from.direction * (HANDLE * length));
        if pieces == 0 {
            stem.offset = if stem.parent.is_some() { before } else { 0.0 };
            knots[0].point = from.position;
            knots[0].handle_in = from.position;
            knots[0].radius = radius;
        } else {
            if is_smooth {
                // Not farther behind than the shorter of the two pieces, or the curve loops.
                let behind = length.abs().min(last.abs()) * length.signum();
                knots[at].handle_in = from.position - from.direction * (HANDLE * behind);
            }
            knots[at].radius = (knots[at - 1].radius + radius) / 2.0;
        }
        knots[at].handle_out = from.position + reach;
        let point = from.position + from.direction * length;
        knots[at + 1] = Knot { point, handle_in: point - reach, handle_out: point, radius };
        let branch = &mut self.branches[branch as usize];
        branch.length = if pieces == 0 { 0.0 } else { before } + length.abs();
        branch.pieces += 1;
        branch.last = length;
        stem.first_knot as usize + at
    }

    /// Closes the branch: radius 0 at its end so far.
    pub(super) fn end(&self, branch: u32, tree: &mut Tree) {
        let Growing { stem: Some(stem), pieces, .. } = self.branches[branch as usize] else { return };
        if pieces > 0 {
            let first = tree.stems[stem as usize].first_knot;
            tree.knots[(first + pieces) as usize].radius = 0.0;
        }
    }
}
