//! From trees of a prior and a picture to intervals and samples.

use super::examples::{Drawer, Example, features};
use super::prior::Prior;
use super::ridge::{Columns, Ridge, Target};
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
    /// More take hours, and over half a gigabyte for each view.
    pub const MAX_TREES: usize = 20_000;
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
    /// Trees that did not grow, or of which nothing is seen.
    pub failures: usize,
    /// The share of those trees whose pictures are at least as strange as the goal is, in 0..=1, by how like they are to
    /// the most similar other one, or by how far they are from all (leverage), whichever is less. Near 0 the goal is not a
    /// picture of such a tree, and the intervals cannot be trusted.
    pub familiarity: f64,
}

impl Posterior {
    /// [`Posterior::familiarity`] below which intervals cannot be trusted.
    pub const STRANGE: f64 = 0.01;
}

/// A tree that a model was not learnt from, and what its own pictures say.
#[derive(Clone, Debug, PartialEq)]
pub struct HeldOut {
    /// The tree, with the values that it has at the height of the problem's goal.
    pub genome: Genome,
    /// What its pictures say; without samples.
    pub posterior: Posterior,
    /// For each number the share of its posterior that is below the truth, in 0..=1.
    pub ranks: Vec<f64>,
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
    /// What the pictures of the trees show.
    shown: Vec<Vec<Descriptor>>,
    /// Of some of the trees, how like each is to the most similar other one.
    nearest: Vec<f64>,
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
        let (known, shown): (Vec<Genome>, Vec<Vec<Descriptor>>) =
            examples.into_iter().map(|one| (one.genome, one.shown)).unzip();
        let rows: Vec<Vec<f64>> = shown.iter().map(|shown| features(shown)).collect();
        let seen = Columns::from_rows(&rows);
        drop(rows);
        let genes: Vec<Gene> =
            prior.genes().map(|gene| gene.holding(&known)).filter(|gene| differs(gene, &known)).collect();
        let units = |genome: &Genome| genes.iter().map(|gene| gene.to_unit(gene.get(genome))).collect();
        let units = Columns::from_rows(&known.iter().map(units).collect::<Vec<_>>());
        let ridge = Ridge::learn(seen, &units);
        let others = |one: usize| shown.iter().enumerate().filter(move |(other, _)| *other != one);
        let nearest = (0..shown.len().min(COMPARED))
            .into_par_iter()
            .map(|one| nearest(&shown[one], others(one).map(|(_, other)| other)))
            .collect();
        Ok(Self { genes, known, units, ridge, shown, nearest, failures, settings, drawer })
    }

    /// The numbers that vary, in the order of their slots, in ranges that hold those of all trees.
    #[must_use]
    pub fn genes(&self) -> &[Gene] {
        &self.genes
    }

    /// What `pictures` say, one for each goal of the problem that was learnt for, of the same size and place.
    #[must_use]
    pub fn posterior<'a>(&self, pictures: impl IntoIterator<Item = &'a Bitmap>) -> Posterior {
        let mut scratch = Scratch::default();
        let goals: Vec<Descriptor> =
            pictures.into_iter().map(|picture| Descriptor::new(picture, &mut scratch)).collect();
        self.posterior_of(&goals, self.settings.samples)
    }

    /// The tree of `genome` and what its own pictures say: for judging the model by trees that it was not learnt from.
    /// `None` if it does not grow, or if nothing is seen of it.
    #[must_use]
    pub fn held_out(&self, genome: Genome) -> Option<HeldOut> {
        let Example { genome, shown } = self.drawer.example(genome)?;
        let means = self.ridge.predict(&features(&shown));
        let rank = |((gene, target), mean): ((&Gene, &Target), &f64)| {
            let left = gene.to_unit(gene.get(&genome)) - mean;
            let [below, same] = [f64::lt, f64::eq].map(|is: fn(&f64, &f64) -> bool| {
                target.residuals.iter().filter(|r| is(r, &left)).count() as f64
            });
            (below + same / 2.0) / target.residuals.len() as f64
        };
        let ranks = self.genes.iter().zip(&self.ridge.targets).zip(&means).map(rank).collect();
        let posterior = self.posterior_of(&shown, 0);
        Some(HeldOut { genome, posterior, ranks })
    }

    fn posterior_of(&self, goals: &[Descriptor], samples: usize) -> Posterior {
        let asked = features(goals);
        let means = self.ridge.predict(&asked);
        let interval = |gene: &Gene, units: Vec<f64>| {
            let [low, median, high] = quantiles(units).map(|unit| gene.from_unit(unit));
            Interval { low, median, high }
        };
        let numbers = self
            .genes
            .iter()
            .zip(&self.ridge.targets)
            .zip(&means)
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
        let count = samples.min(PosteriorSettings::MAX_SAMPLES) as u64;
        let samples = (0..count).into_par_iter().filter_map(|number| self.sample(number, &means, goals));
        Posterior {
            numbers,
            samples: samples.collect(),
            trees: self.known.len(),
            failures: self.failures,
            familiarity: self.familiarity(goals).min(self.ridge.share_as_far(&asked)),
        }
    }

    fn familiarity(&self, goals: &[Descriptor]) -> f64 {
        let own = nearest(goals, self.shown.iter());
        self.nearest.iter().filter(|&&nearest| nearest <= own).count() as f64 / self.nearest.len() as f64
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
            let alike = likeness(&shown, goals);
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

/// Trees of which it is known how like each is to the others.
const COMPARED: usize = 300;

/// How like the pictures of two trees are, in the mean over views.
fn likeness(a: &[Descriptor], b: &[Descriptor]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.compare(b).value()).sum::<f64>() / a.len().max(1) as f64
}

/// How like `one` is to the most similar of `others`.
fn nearest<'a>(one: &[Descriptor], others: impl Iterator<Item = &'a Vec<Descriptor>>) -> f64 {
    others.map(|other| likeness(one, other)).fold(0.0, f64::max)
}

/// Whether not all of these trees have the same number: whole ones may.
fn differs(gene: &Gene, known: &[Genome]) -> bool {
    let mut values = known.iter().map(|genome| gene.get(genome));
    let first = values.next();
    values.any(|value| Some(value) != first)
}

/// The middle of `numbers` and the ends of an interval that holds nine in ten: those of an [`Interval`], in its order.
pub(crate) fn quantiles(mut numbers: Vec<f64>) -> [f64; 3] {
    numbers.sort_by(f64::total_cmp);
    [0.05, 0.5, 0.95].map(|part| quantile(&numbers, part))
}

/// The value below which `part` of `sorted` lies, between its neighbours.
fn quantile(sorted: &[f64], part: f64) -> f64 {
    let place = part * (sorted.len() - 1) as f64;
    let below = sorted[place.floor() as usize];
    let above = sorted[place.ceil() as usize];
    below + (above - below) * place.fract()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::GoalView;
    use crate::space::Freedom;
    use pleach_silhouette::{Frame, View, silhouette};
    use pleach_tree::{Parts, Species};
    use std::sync::atomic::AtomicBool;
    use std::time::Duration;

    const SIZE: u32 = 48;

    fn palm() -> (Species, FitProblem, Prior) {
        let palm = pleach_generators::preset("palm").unwrap();
        let tree = palm.grow(3).unwrap();
        let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, SIZE, SIZE);
        let goal = GoalView::new(silhouette(&tree, View::FRONT, SIZE), View::FRONT, frame);
        let prior = Prior::new(&palm, &Freedom::default(), Prior::SPREAD).unwrap();
        (palm.clone(), FitProblem::new(palm, goal), prior)
    }

    fn learn(trees: usize, until: Until<'_>) -> Result<PosteriorModel, FitError> {
        let (_, problem, prior) = palm();
        let settings = PosteriorSettings { trees, samples: 3, ..PosteriorSettings::default() };
        PosteriorModel::learn(&problem, &prior, settings, until, |_| ())
    }

    #[test]
    fn intervals_hold_the_truth_as_often_as_they_say() {
        let (palm, _, prior) = palm();
        let stop = AtomicBool::new(false);
        let model = learn(500, Until::from(&stop)).unwrap();
        let held_out: Vec<HeldOut> =
            (0..120).filter_map(|number| model.held_out(prior.draw(77, number))).collect();
        assert!(held_out.len() > 100);
        let (mut covered, mut all) = (0, 0);
        for one in &held_out {
            for (gene, number) in model.genes().iter().zip(&one.posterior.numbers) {
                let value = gene.from_unit(gene.to_unit(gene.get(&one.genome)));
                let Interval { low, median, high } = number.posterior;
                assert!(low <= median && median <= high);
                covered += usize::from((low..=high).contains(&value));
                all += 1;
            }
            assert!(one.ranks.iter().all(|rank| (0.0..=1.0).contains(rank)));
            assert!(one.posterior.samples.is_empty());
        }
        let share = covered as f64 / all as f64;
        assert!((0.87..0.94).contains(&share), "{share}");
        // What is seen best of a palm is where its leaves begin; how its roots bend is not.
        let first = &held_out[0].posterior.numbers;
        let of = |name: &str| {
            let slot = palm.params.space().select(name).unwrap()[0];
            first.iter().find(|number| number.slot == slot).unwrap()
        };
        let seen = of("base_size[0]");
        assert!(seen.shrunk > 0.4 && of("curve_v[0]").shrunk < 0.3, "{}", seen.shrunk);
        let width = |of: Interval| of.high - of.low;
        assert!(width(seen.posterior) < 0.85 * width(seen.prior));
    }

    #[test]
    fn a_posterior_has_the_same_bits_on_any_number_of_threads_and_trees_that_grow() {
        let (palm, problem, _) = palm();
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let stop = AtomicBool::new(false);
                learn(120, Until::from(&stop)).unwrap().posterior([&problem.goals[0].goal])
            })
        };
        let one = on(1);
        assert_eq!(one, on(3));
        assert_eq!((one.trees + one.failures, one.samples.len()), (120, 3));
        assert!(one.familiarity > Posterior::STRANGE, "{}", one.familiarity);
        for genome in &one.samples {
            let params = palm.params.space().check(genome.values.clone()).unwrap();
            assert!(Species { params, ..palm.clone() }.grow(genome.tree_seed).is_ok());
        }
    }

    #[test]
    fn a_picture_of_something_else_is_strange() {
        let stop = AtomicBool::new(false);
        let model = learn(200, Until::from(&stop)).unwrap();
        let block = Bitmap::from_fn(SIZE, SIZE, |x, y| (4..44).contains(&x) && (10..46).contains(&y));
        let found = model.posterior([&block]);
        assert!(found.familiarity < Posterior::STRANGE, "{}", found.familiarity);
        let empty = model.posterior([&Bitmap::new(SIZE, SIZE)]);
        assert_eq!((empty.familiarity, empty.numbers.len()), (0.0, found.numbers.len()));
    }

    #[test]
    fn it_ends_when_asked_to_and_tells_when_there_are_too_few_trees() {
        let stop = AtomicBool::new(false);
        let clock = || Duration::from_secs(9);
        let late = Until::from(&stop).or_late(&clock, Some(Duration::from_secs(1)));
        let tried = match learn(5000, late) {
            Err(FitError::NothingGrew { evaluations }) => evaluations,
            other => panic!("{other:?}"),
        };
        assert!((1..100).contains(&tried), "{tried}");
        stop.store(true, std::sync::atomic::Ordering::Relaxed);
        assert!(matches!(learn(200, Until::from(&stop)), Err(FitError::Interrupted)));
    }
}
