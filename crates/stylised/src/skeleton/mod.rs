//! Trunks, roots and branches as chains of vertices with radii, in units of the sliders.
//!
//! Lorite 2021, §3.5. A chain becomes a stem; its vertices become the knots of the stem's spline.

mod branches;
mod nodes;
mod path;
mod roots;
mod trunks;

pub(crate) use path::Path;

use crate::params::Numbers;
use glam::DVec3;
use pleach_tree::{Address, Draw, Growth, Key, Knot, StemKind};
use std::ops::Range;

/// A run of knots.
#[derive(Clone, Debug)]
pub(crate) struct Chain {
    pub(crate) kind: StemKind,
    pub(crate) level: u16,
    /// The chain that it grows from.
    pub(crate) parent: Option<u32>,
    /// Among those of its kind on its parent; roots after branches.
    pub(crate) number: u32,
    /// How far along the parent it starts.
    pub(crate) offset: f64,
    pub(crate) knots: Range<usize>,
}

/// The end of a living branch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BranchEnd {
    pub(crate) chain: u32,
    pub(crate) at: DVec3,
    /// The branch's key.
    pub(crate) key: Key,
}

/// All chains of a tree: trunks first, then roots, then branches.
#[derive(Debug, Default)]
pub(crate) struct Skeleton {
    pub(crate) chains: Vec<Chain>,
    pub(crate) knots: Vec<Knot>,
    /// Living branches; stubs are not among them.
    pub(crate) ends: Vec<BranchEnd>,
    pub(crate) trunk_count: u32,
    /// Where along each trunk branches and foliage may grow.
    pub(crate) zone_starts: Vec<f64>,
    /// Each trunk's address and draws; its key takes the place of the tree's for what it carries.
    pub(crate) dealt: Vec<Dealt>,
}

/// Where a trunk is in its tree, and what it has drawn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dealt {
    pub(crate) address: Address,
    pub(crate) draw: Draw,
}

impl Skeleton {
    /// Makes the skeleton of the tree with `numbers` and `key`; `growth` has the draws of its stems.
    pub(crate) fn grow(&mut self, numbers: &Numbers, growth: &Growth<'_>, key: Key) {
        self.chains.clear();
        self.knots.clear();
        self.ends.clear();
        self.zone_starts.clear();
        self.dealt.clear();
        trunks::grow(self, numbers, growth, key);
        roots::grow(self, numbers, growth, key);
        branches::grow(self, numbers, growth, key);
    }

    /// The knots of `chain`.
    pub(crate) fn knots_of(&self, chain: &Chain) -> &[Knot] {
        &self.knots[chain.knots.clone()]
    }

    /// The spline of trunk number `trunk`.
    pub(crate) fn trunk(&self, trunk: u32) -> Path<'_> {
        Path::new(self.knots_of(&self.chains[trunk as usize]))
    }

    /// What `key` becomes on trunk number `trunk`.
    pub(crate) fn key_on(&self, trunk: u32, key: Key) -> Key {
        // The first trunk's draws are those of the whole tree, whose key has them already.
        if trunk == 0 { key } else { self.dealt[trunk as usize].draw.key(key) }
    }

    /// Appends a chain through `points` with these radii; its knots' handles make a smooth curve.
    fn push(&mut self, chain: Chain, points: &[DVec3], radii: &[f64]) -> u32 {
        let first = self.knots.len();
        for (i, (&point, &radius)) in points.iter().zip(radii).enumerate() {
            let before = if i > 0 { points[i - 1] } else { point };
            let after = points.get(i + 1).copied().unwrap_or(point);
            let along = (after - before).normalize_or_zero();
            self.knots.push(Knot {
                point,
                handle_in: point - along * (point.distance(before) / 3.0),
                handle_out: point + along * (point.distance(after) / 3.0),
                radius,
            });
        }
        self.chains.push(Chain { knots: first..self.knots.len(), ..chain });
        self.chains.len() as u32 - 1
    }
}

/// Moves every inner point towards the middle of its neighbors, by the share that `strength` gives for
/// its number. All move at once.
fn relax(points: &mut [DVec3], strength: impl Fn(usize) -> f64) {
    let Some(&first) = points.first() else { return };
    let mut before = first;
    for i in 1..points.len().saturating_sub(1) {
        let here = points[i];
        points[i] = here.lerp((before + points[i + 1]) / 2.0, strength(i));
        before = here;
    }
}

/// The smoothing at the end: one to three times, the stronger the more random the part is.
fn smooth(points: &mut [DVec3], randomness: f64) {
    for _ in 0..1 + (2.0 * randomness).round() as u32 {
        relax(points, |_| 0.5 * randomness);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    #[test]
    fn ends_stay_and_inner_points_move_to_the_middle_at_once() {
        let mut points = [0.0, 4.0, 0.0, 4.0].map(|x| dvec3(x, 0.0, 0.0));
        relax(&mut points, |_| 0.5);
        assert_eq!(points.map(|p| p.x), [0.0, 2.0, 2.0, 4.0]);
        relax(&mut points, |i| if i == 1 { 1.0 } else { 0.0 });
        assert_eq!(points.map(|p| p.x), [0.0, 1.0, 2.0, 4.0]);
    }
}
