//! A stem and how it came to be.

use serde::{Deserialize, Serialize};
use std::ops::Range;

/// How a stem came to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum StemKind {
    /// Comes out of the ground.
    Trunk,
    /// A lateral child: leaves its parent's side at an angle (monopodial branching).
    Branch,
    /// One arm of a fork (dichotomous branching): continues its parent at the parent's own level.
    Fork,
    /// Grows below or along the ground. Pictures, meshes, bounds and heights leave roots out unless
    /// they are asked for ([`Parts::ROOTS`](super::Parts::ROOTS)).
    Root,
}

/// A stem: a run of [`Tree::knots`](super::Tree::knots) and where it stands in the plant.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stem {
    /// Index in [`Tree::stems`](super::Tree::stems) of the stem that this one grows from; always smaller than its own.
    pub parent: Option<u32>,
    /// 0 for trunks and roots from the ground, one more for each branching; a fork has its parent's
    /// level.
    pub level: u16,
    /// How it came to be.
    pub kind: StemKind,
    /// Its number among the stems of its kind on its parent or on the ground, whatever other stems do. 0 where stems
    /// have no addresses.
    pub number: u32,
    /// Metres along the parent, from its base, at which this stem starts. 0 for trunks.
    pub offset: f64,
    /// First of its knots in [`Tree::knots`](super::Tree::knots).
    pub first_knot: u32,
    /// Number of its knots, at least 2.
    pub knot_count: u32,
}

impl Stem {
    /// The stem's knots as a range of [`Tree::knots`](super::Tree::knots).
    #[must_use]
    pub fn knots(&self) -> Range<usize> {
        let first = self.first_knot as usize;
        first..first + self.knot_count as usize
    }
}
