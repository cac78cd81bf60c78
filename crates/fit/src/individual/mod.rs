//! This very tree: draws of single stems, chosen until the tree lies on the picture.
//!
//! A search finds the kind of a tree. One seed deals all of its branches at once, so no list of numbers puts
//! every branch where the picture has it (`experiments/needle`). Here single stems are dealt other draws,
//! within what the species itself leaves open ([`pleach_tree::Generator::spreads`]), and what makes the cost
//! smaller is kept.
//!
//! One tree in which all stems of a generation have other draws is a candidate for each of them at once. Every
//! stem with what it carries is a [layer](pleach_silhouette::Layer) of the picture, so that a trial takes one
//! layer out and puts another in, whatever the number of other stems.
//!
//! What is made large is overlap, pixel by pixel and in coarser cells, of trees that are as like the goal as two trees of
//! a species are at best. Draws far from a stem's own have a price, so that what the picture does not ask for stays as
//! the species would have it.

mod chosen;
mod hand;
mod plan;
mod search;
mod state;
mod units;

use crate::budget::Clock;
use crate::error::FitError;
use crate::genome::{Genome, Score};
use crate::problem::FitProblem;
use pleach_tree::{Individual, Limits, Species};
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// How an individual is searched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IndividualSettings {
    /// Time by the caller's clock; none is no bound.
    pub time: Option<Duration>,
    /// Trees that are grown, each a candidate for every stem of a generation; none is no bound.
    pub trees: Option<u64>,
    /// Most stems with draws of their own.
    pub max_stems: usize,
    /// How many trees are found, each dealt anew from the trunk up: one picture leaves their depth open. They share
    /// the time and the trees. At most [`Self::MAX_COUNT`] are.
    pub count: u8,
    /// In a whole fit: whether the time that judging leaves is theirs as well.
    pub takes_rest: bool,
}

impl IndividualSettings {
    /// Most stems with draws of their own unless something else is said: as many lines as a person still reads.
    pub const MAX_STEMS: usize = 400;

    /// Most trees that are found.
    pub const MAX_COUNT: u8 = 64;

    /// For so long by the caller's clock.
    #[must_use]
    pub fn time(time: Duration) -> Self {
        Self { time: Some(time), ..Self::trees(u64::MAX) }
    }

    /// With so many trees; the same bits on any machine.
    #[must_use]
    pub fn trees(trees: u64) -> Self {
        Self { time: None, trees: Some(trees), max_stems: Self::MAX_STEMS, count: 1, takes_rest: false }
    }
}

/// How far a search for an individual is, between two batches of trees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IndividualProgress {
    /// Which tree is searched, from 0.
    pub number: u8,
    /// Trees grown for it.
    pub trees: u64,
    /// Single stems of it that were tried.
    pub trials: u64,
    /// Intersection over union.
    pub iou: f64,
    /// Likeness.
    pub likeness: f64,
    /// The used share of the whole budget, in 0..=1.
    pub used: f64,
}

/// The tree of a goal.
#[derive(Clone, Debug)]
pub struct FoundIndividual {
    /// The species with its individual.
    pub species: Species,
    /// The score of the tree that the search began with, by [`Objective::Overlap`](crate::Objective::Overlap),
    /// with its likeness.
    pub before: Score,
    /// The same of the individual.
    pub score: Score,
    /// Trees grown.
    pub trees: u64,
    /// Single stems that were tried.
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

/// Where the search for individuals begins, and what bounds that of each.
pub(crate) struct Quest<'a> {
    pub(crate) problem: &'a FitProblem,
    pub(crate) genome: &'a Genome,
    pub(crate) settings: IndividualSettings,
    pub(crate) limits: Limits,
    pub(crate) stop: &'a AtomicBool,
}

/// Searches individuals of `problem`'s goals among the trees of the kind that `genome` is, and returns them with
/// the best first. The first that is searched begins as the tree of the kind's own seed; further ones are dealt anew
/// from the trunk up. There are none where stems have no addresses, or the tree does not grow.
///
/// The same problem, genome and number of trees give the same individuals on any number of threads.
///
/// # Errors
/// Problems that [`crate::Evaluator::new`] refuses, and [`FitError::Interrupted`] once `stop` is raised.
pub fn individuals(
    problem: &FitProblem,
    genome: &Genome,
    settings: IndividualSettings,
    clock: &dyn Clock,
    stop: &AtomicBool,
    mut tell: impl FnMut(&IndividualProgress),
) -> Result<Vec<FoundIndividual>, FitError> {
    let count = settings.count.clamp(1, IndividualSettings::MAX_COUNT);
    let from = clock.elapsed();
    let mut all = Vec::new();
    for number in 0..count {
        // What one leaves of the time is there for those after it.
        let left = u32::from(count - number);
        let passed = clock.elapsed().saturating_sub(from);
        let share = IndividualSettings {
            time: settings.time.map(|time| time.saturating_sub(passed) / left),
            trees: settings.trees.map(|trees| trees.div_ceil(u64::from(count))),
            ..settings
        };
        let quest = Quest { problem, genome, settings: share, limits: Limits::DEFAULT, stop };
        let tell = |progress: &IndividualProgress| {
            tell(&IndividualProgress {
                used: (f64::from(number) + progress.used) / f64::from(count),
                ..*progress
            });
        };
        all.extend(search::search(&quest, number, clock, tell)?);
    }
    all.sort_by(|a: &FoundIndividual, b| a.score.cost.total_cmp(&b.score.cost));
    Ok(all)
}
