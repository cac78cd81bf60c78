//! The row of a contestant on a goal.

use super::budget::Budget;
use super::goal::Set;
use crate::record::Fixed;
use serde::{Deserialize, Serialize};

/// A contestant's answer to a goal; what an answer does not have is empty. `docs/bench.md` says what is measured.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub(super) struct Row {
    pub(super) goal: String,
    pub(super) set: Set,
    /// Goals of one group are alike.
    pub(super) group: String,
    /// The contestant.
    pub(super) row: String,
    pub(super) budget: Budget,
    /// The generator of the tree.
    pub(super) family: String,
    /// The species that it began at.
    pub(super) species: String,
    /// Mean likeness of sixteen trees of other seeds.
    pub(super) fresh: Option<Fixed<4>>,
    pub(super) likeness: Option<Fixed<4>>,
    pub(super) iou: Option<Fixed<4>>,
    pub(super) boundary_f: Option<Fixed<4>>,
    pub(super) crown_iou: Option<Fixed<4>>,
    /// 1 where nothing that is read in the two pictures differs.
    pub(super) architecture: Option<Fixed<4>>,
    /// `fresh` seen from the side, which no contestant has seen.
    pub(super) side: Option<Fixed<4>>,
    /// Root mean square of how far numbers are off, in standard deviations of the prior.
    pub(super) numbers_off: Option<Fixed<3>>,
    /// Trees that the search has grown.
    pub(super) wall_trees: Option<u64>,
    pub(super) wall_s: Option<Fixed<1>>,
}

/// A measure of rows: its name, its words in a table, its decimals, its value.
pub(super) struct Measure {
    pub(super) name: &'static str,
    pub(super) words: &'static str,
    pub(super) decimals: usize,
    pub(super) value: fn(&Row) -> Option<f64>,
}

/// The measures in the order of the leaderboard: the first one ranks.
pub(super) const MEASURES: [Measure; 9] = [
    Measure { name: "fresh", words: "fresh likeness", decimals: 3, value: |row| Some(row.fresh?.0) },
    Measure { name: "likeness", words: "likeness", decimals: 3, value: |row| Some(row.likeness?.0) },
    Measure { name: "iou", words: "IoU", decimals: 3, value: |row| Some(row.iou?.0) },
    Measure { name: "boundary_f", words: "boundary F", decimals: 3, value: |row| Some(row.boundary_f?.0) },
    Measure { name: "crown_iou", words: "crown IoU", decimals: 3, value: |row| Some(row.crown_iou?.0) },
    Measure {
        name: "architecture",
        words: "architecture",
        decimals: 3,
        value: |row| Some(row.architecture?.0),
    },
    Measure { name: "side", words: "side", decimals: 3, value: |row| Some(row.side?.0) },
    Measure { name: "numbers_off", words: "numbers off", decimals: 2, value: |row| Some(row.numbers_off?.0) },
    Measure { name: "wall_s", words: "seconds", decimals: 1, value: |row| Some(row.wall_s?.0) },
];
