//! From trees of a prior and a picture to intervals and samples.

use super::examples::{Drawer, Example, features};
use super::prior::Prior;
use super::ridge::{Columns, Ridge};
use crate::control::Until;
use crate::error::FitError;
use crate::problem::{FitProblem, Genome};
use crate::space::{Gene, SearchSpace, Stream};
use pleach_silhouette::Bitmap;
use pleach_silhouette::score::likeness::{Descriptor, Scratch};
use pleach_tree::Slot;
use rayon::prelude::*;
use serde::Serialize;

/// Purpose of the draws of samples, for [`Stream::at`].
const SAMPLES: u32 = 0x706f;

/// Settings of a [`PosteriorModel`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PosteriorSettings {
    /// Trees of the prior that are grown, at least [`PosteriorSettings::MIN_TREES`].
    pub trees: usize,
    /// The seed of their numbers and of the samples.
    pub seed: u64,
    /// Samples that are drawn from the posterior.
    pub samples: usize,
    /// In a whole fit: the spread of the prior, see [`Prior::new`].
    pub spread: f64,
}

impl PosteriorSettings {
    /// Default of [`Self::trees`].
    pub const TREES: usize = 2000;
    /// Fewer trees tell nothing about the ends of intervals.
    pub const MIN_TREES: usize = 100;
    /// More take hours.
    pub const MAX_TREES: usize = 100_000;
    /// Default of [`Self::samples`].
    pub const SAMPLES: usize = 8;
    /// More than a sheet holds.
    pub const MAX_SAMPLES: usize = 1000;
}

impl Default for PosteriorSettings {
    fn default() -> Self {
        Self { trees: Self::TREES, seed: 0, samples: Self::SAMPLES, spread: Prior::SPREAD }
    }
}

/// A middle and an interval that holds nine in ten.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Interval {
    /// One in twenty is below.
    pub low: f64,
    /// Half of all are below.
    pub median: f64,
    /// One in twenty is above.
    pub high: f64,
}

/// What is known of one number.
#[derive(Clone, Debug, PartialEq)]
pub struct PosteriorNumber {
    /// The slot in the generator's parameter space.
    pub slot: Slot,
    /// Before the picture was seen.
    pub prior: Interval,
    /// Since.
    pub posterior: Interval,
    /// By how much the variance is smaller since, in 0..=1: over the trees of the prior, each predicted by the others.
    pub shrunk: f64,
}

/// What a picture says about the numbers of its tree.
#[derive(Clone, Debug, PartialEq)]
pub struct Posterior {
    /// Every number that varies in the prior, in the order of the slots.
    pub numbers: Vec<PosteriorNumber>,
    /// Trees that the picture may be of, each with its own numbers and seed.
    pub samples: Vec<Genome>,
    /// Trees of the prior that it was learnt from.
    pub trees: usize,
    /// Trees that did not grow.
    pub failures: usize,
    /// The share of those trees whose pictures are at least as strange among the others as the goal is, in 0..=1. Near 0
    /// the goal is not a picture of a tree of the prior, and the intervals cannot be trusted.
    pub familiarity: f64,
}

impl Posterior {
    /// [`Posterior::familiarity`] below which intervals cannot be trusted.
    pub const STRANGE: f64 = 0.01;
}

/// What pictures of trees of a prior say about their numbers.
///
/// Trees are grown and drawn as the goals of a problem are; ridge regression from their pictures to their numbers, each
/// number between its smallest and its largest plausible value, gives a mean, and what is left when a tree is predicted
/// by all others gives the spread around it. So an interval holds the truth as often as it says, in the mean over trees
/// of the prior, and numbers that trade off in what is left do so in the samples. The shape of the spread is the same
/// for all pictures.
#[derive(Debug)]
pub struct PosteriorModel {
    /// The numbers that vary, in ranges that hold those of all trees.
    genes: Vec<Gene>,
    known: Vec<Genome>,
    /// The numbers as parts of those ranges, column by column.
    units: Columns,
    ridge: Ridge,
    failures: usize,
    settings: PosteriorSettings,
    drawer: Drawer,
}

impl PosteriorModel {
    /// Learns from trees of `prior`, drawn as the goals of `problem` are.
    ///
    /// Once it is late by `until`, the trees that were grown are used. `notify` is told how many were tried.
    ///
    /// # Errors
    /// Problems that [`crate::Evaluator::new`] refuses, [`FitError::Interrupted`] once asked to stop, and
    /// [`FitError::NothingGrew`] where fewer than [`PosteriorSettings::MIN_TREES`] trees grew.
    pub fn learn(
        problem: &FitProblem,
        prior: &Prior,
        settings: PosteriorSettings,
        until: Until<'_>,
        mut notify: impl FnMut(usize),
    ) -> Result<Self, FitError> {
        let count = settings.trees.clamp(PosteriorSettings::MIN_TREES, PosteriorSettings::MAX_TREES);
        let mut tried = 0;
        let drawer = Drawer::new(problem, prior)?;
        let examples = drawer.examples(prior, (settings.seed, count), until, |done| {
            tried = done;
            notify(done);
        })?;
        if examples.len() < PosteriorSettings::MIN_TREES {
            return Err(FitError::NothingGrew { evaluations: tried as u64 });
        }
        let failures = tried - examples.len();
        let (known, rows): (Vec<Genome>, Vec<Vec<f64>>) =
            examples.into_iter().map(|one| (one.genome, features(&one.shown))).unzip();
        let genes: Vec<Gene> = prior.genes().map(|gene| widened(gene, &known)).collect();
        let units = |genome: &Genome| genes.iter().map(|gene| gene.to_unit(gene.get(genome))).collect();
        let units = Columns::from_rows(&known.iter().map(units).collect::<Vec<_>>());
        let ridge = Ridge::learn(&Columns::from_rows(&rows), &units);
        Ok(Self { genes, known, units, ridge, failures, settings, drawer })
    }

    /// What `pictures` say, one for each goal of the problem that was learnt for, of the same size and place.
    #[must_use]
    pub fn posterior<'a>(&self, pictures: impl IntoIterator<Item = &'a Bitmap>) -> Posterior {
        let mut scratch = Scratch::default();
        let goals: Vec<Descriptor> =
            pictures.into_iter().map(|picture| Descriptor::new(picture, &mut scratch)).collect();
        let asked = features(&goals);
        let means = self.ridge.predict(&asked);
        let interval = |gene: &Gene, mut units: Vec<f64>| {
            units.sort_by(f64::total_cmp);
            let [low, median, high] = [0.05, 0.5, 0.95].map(|part| gene.from_unit(quantile(&units, part)));
            Interval { low, median, high }
        };
        let answers = || self.genes.iter().zip(&self.ridge.targets).zip(&means);
        let numbers = answers()
            .zip(&self.units.columns)
            .filter_map(|(((gene, target), mean), before)| {
                let after = target.residuals.iter().map(|residual| mean + residual).collect();
                Some(PosteriorNumber {
                    slot: gene.slot()?,
                    prior: interval(gene, before.clone()),
                    posterior: interval(gene, after),
                    shrunk: target.explained,
                })
            })
            .collect();
        let count = self.settings.samples.min(PosteriorSettings::MAX_SAMPLES);
        let samples =
            (0..count as u64).into_par_iter().filter_map(|number| self.sample(number, &means, &goals));
        Posterior {
            numbers,
            samples: samples.collect(),
            trees: self.known.len(),
            failures: self.failures,
            familiarity: self.ridge.familiarity(&asked),
        }
    }

    /// Sample number `number`: of some draws the one that looks most like the goals; `None` if none grows.
    fn sample(&self, number: u64, means: &[f64], goals: &[Descriptor]) -> Option<Genome> {
        let mut stream = Stream::at(self.settings.seed, SAMPLES, number, 0);
        let mut best: Option<(f64, Genome)> = None;
        for _ in 0..DRAWS {
            // What is left of one tree in all of its numbers, so that those that trade off do so here.
            let left = stream.below(self.known.len());
            let mut genome = self.known[left].clone();
            for ((gene, target), mean) in self.genes.iter().zip(&self.ridge.targets).zip(means) {
                gene.set(&mut genome, gene.from_unit(mean + target.residuals[left]));
            }
            genome.tree_seed = SearchSpace::random_seed(&mut stream);
            let Some(Example { genome, shown }) = self.drawer.example(genome) else { continue };
            let alike = shown.iter().zip(goals).map(|(one, goal)| one.compare(goal).value()).sum();
            if best.as_ref().is_none_or(|(most, _)| alike > *most) {
                best = Some((alike, genome));
            }
        }
        best.map(|(_, genome)| genome)
    }
}

/// Draws of which a sample is the one that looks most like the goals: regression sees no more of a picture than what is
/// linear in it (approximate Bayesian computation, by rejection of seven in eight).
const DRAWS: usize = 8;

/// `gene` in a range that holds the numbers of all these trees: at the height of their picture sizes may be others than
/// were drawn.
fn widened(gene: &Gene, known: &[Genome]) -> Gene {
    let values = || known.iter().map(|genome| gene.get(genome));
    Gene { low: values().fold(gene.low, f64::min), high: values().fold(gene.high, f64::max), ..gene.clone() }
}

/// The value below which `part` of `sorted` lies, between its neighbours.
fn quantile(sorted: &[f64], part: f64) -> f64 {
    let place = part * (sorted.len() - 1) as f64;
    let below = sorted[place.floor() as usize];
    let above = sorted[place.ceil() as usize];
    below + (above - below) * place.fract()
}
