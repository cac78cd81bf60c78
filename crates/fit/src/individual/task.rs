//! What is searched for individuals, and what is found.

use crate::problem::{FitProblem, Genome, Score};
use pleach_tree::{Individual, Limits, Species};
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// Settings of the search for individuals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IndividualSettings {
    /// Time by the caller's clock; `None`: unlimited.
    pub time: Option<Duration>,
    /// Trees that are grown, each a candidate for every stem of a generation; `None`: unlimited.
    pub trees: Option<u64>,
    /// Upper bound of the stems with draws of their own.
    pub max_stems: usize,
    /// How many individuals are searched, each drawn again from the trunk up: one picture leaves their depth open.
    /// They share the time and the trees. At most [`Self::MAX_COUNT`].
    pub count: u8,
    /// In a whole fit: whether the time that assessment leaves is theirs as well.
    pub takes_rest: bool,
}

impl IndividualSettings {
    /// Default of [`Self::max_stems`]: as many lines of a species file as a person still reads.
    pub const MAX_STEMS: usize = 400;

    /// Upper bound of [`Self::count`].
    pub const MAX_COUNT: u8 = 64;

    /// For `time` by the caller's clock.
    #[must_use]
    pub fn time(time: Duration) -> Self {
        Self { time: Some(time), ..Self::trees(u64::MAX) }
    }

    /// With `trees` trees; the same bits on any machine.
    #[must_use]
    pub fn trees(trees: u64) -> Self {
        Self { time: None, trees: Some(trees), max_stems: Self::MAX_STEMS, count: 1, takes_rest: false }
    }
}

/// Progress of the search for an individual, between two batches of trees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IndividualProgress {
    /// Number of the individual, from 0.
    pub number: u8,
    /// Trees grown for it.
    pub trees: u64,
    /// Trials of its single stems.
    pub trials: u64,
    /// Intersection over union.
    pub iou: f64,
    /// Likeness.
    pub likeness: f64,
    /// The used share of the whole budget, in 0..=1.
    pub used: f64,
}

/// An individual that lies on the goal.
#[derive(Clone, Debug)]
pub struct FoundIndividual {
    /// The species with its individual.
    pub species: Species,
    /// Score of the tree that the search began with, by [`Objective::Overlap`](crate::Objective::Overlap),
    /// with its likeness.
    pub before: Score,
    /// The same of the individual.
    pub score: Score,
    /// Trees grown.
    pub trees: u64,
    /// Trials of single stems.
    pub trials: u64,
    /// Time by the caller's clock.
    pub elapsed: Duration,
}

impl FoundIndividual {
    /// The draws of single stems.
    #[must_use]
    pub fn individual(&self) -> Individual {
        self.species.individual().cloned().unwrap_or_default()
    }
}

/// A search for one individual.
pub(super) struct Task<'a> {
    pub(super) problem: &'a FitProblem,
    pub(super) genome: &'a Genome,
    pub(super) settings: IndividualSettings,
    pub(super) limits: Limits,
    pub(super) stop: &'a AtomicBool,
}
