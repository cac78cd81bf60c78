//! A first guess: which known species a goal looks like, and the lists that a search may start from.
//!
//! Trees of all candidates are grown as they are and with their numbers varied, drawn finely, laid into
//! the goal's frame at the goal's height, and compared by likeness, which knows a species by other trees
//! than the goal's. The drawings serve all goals of a [`GuessLibrary`]. Nothing is stored between runs:
//! growing a few hundred trees takes a second or two, and what is grown anew is never out of date.
//!
//! The same drawings tell whether the goal has leaves, and what its likeness to other trees is worth.

mod library;
mod plate;
mod references;

pub use library::GuessLibrary;
pub use references::{Reference, References};

use crate::evaluator::{Evaluator, FitProblem};
use crate::genome::{Genome, Score};
use crate::nuisance::Azimuth;
use crate::objective::Objective;
use crate::run::FitError;
use crate::settings::FitSettings;
use crate::space::{Freedom, SearchSpace, TreeSeed};
use crate::stoppable;
use crate::stream::Stream;
use library::{Entry, Resemblance, Wish, compare};
use pleach_silhouette::Bitmap;
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// A species that a goal may be of.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// What it is called.
    pub name: String,
    /// One value for every slot of the problem's generator.
    pub values: Vec<f64>,
}

/// How much is tried for a first guess.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GuessSettings {
    /// Varied copies of each candidate.
    pub variants: u32,
    /// Standard deviation of a varied number, as a part of the number itself.
    pub spread: f64,
    /// Trees of each candidate as it is, of different seeds: what names are decided by.
    pub seeds: u32,
    /// Lists that are returned, at most.
    pub keep: usize,
    /// Whether the goal is looked at with leaves and without, and taken for what it is more like; if
    /// not, `FitProblem::foliage` says it.
    pub detect_leaves: bool,
}

impl Default for GuessSettings {
    fn default() -> Self {
        Self { variants: 8, spread: 0.15, seeds: 3, keep: 10, detect_leaves: false }
    }
}

/// What a goal looks like before any search.
#[derive(Clone, Debug, PartialEq)]
pub struct FirstGuess {
    /// The nearest lists, best first; at least one.
    pub nearest: Vec<Guess>,
    /// The candidates with the confidence that the goal is theirs, in 0..=1, the likeliest first; sums
    /// to 1.
    pub names: Vec<(String, f64)>,
    /// Whether the goal is taken for a tree with leaves: what `FitProblem::foliage` should be. All of
    /// the above is of trees like that.
    pub foliage: bool,
    /// What the likeness of a fit to the goal stands beside.
    pub references: References,
}

/// One of the nearest lists.
#[derive(Clone, Debug, PartialEq)]
pub struct Guess {
    /// The candidate that it is, or is a variation of.
    pub name: String,
    /// One value a slot, resized to the goal's height.
    pub values: Vec<f64>,
    /// Its score with the problem's tree seed.
    pub score: Score,
}

/// Lane of [`Stream::at`] for variations.
const VARIATION: u32 = 0x6775;
/// Trees between two calls of the observer: enough to keep the threads busy.
const BATCH: usize = 32;
/// Of the trees that look most like the goal, this many times those that are kept are scored by what
/// the search makes small.
const ALIKE: usize = 3;
/// By how much worse a candidate's likeness is when it is e times less probable.
const DOUBT: f64 = 0.02;

/// Compares the goals of `problem` with trees of all `candidates`; tells `progress` how many of how
/// many are grown.
///
/// Of `settings` the seed, tree seed, objective and limits are used. `problem.base` is not.
///
/// # Errors
/// A problem that [`Evaluator::new`] refuses, candidates that are not the generator's,
/// [`FitError::NoStart`] if none of them grows, or [`FitError::Interrupted`] once `stop` is raised.
pub fn first_guess(
    problem: &FitProblem,
    settings: &FitSettings,
    candidates: &[Candidate],
    guess: &GuessSettings,
    stop: &AtomicBool,
    progress: impl FnMut(usize, usize),
) -> Result<FirstGuess, FitError> {
    GuessLibrary::new().first_guess(problem, settings, candidates, guess, stop, progress)
}

/// Seeds of each candidate for references alone.
const REFERENCE_SEEDS: u32 = 1;
/// Trees of the species that a goal looks like of which pairs are compared: 15 pairs, whose mean is
/// known to a hundredth or two.
const TREES_OF_SPECIES: u64 = 6;

impl GuessLibrary {
    /// [`first_guess`] with the trees of this library, which is filled first where it has to be.
    ///
    /// # Errors
    /// As [`first_guess`].
    pub fn first_guess(
        &mut self,
        problem: &FitProblem,
        settings: &FitSettings,
        candidates: &[Candidate],
        guess: &GuessSettings,
        stop: &AtomicBool,
        progress: impl FnMut(usize, usize),
    ) -> Result<FirstGuess, FitError> {
        let known = known_views(problem);
        let looks = looks(&known, settings)?;
        let shown = (&known, &looks);
        let mut foliage = known.foliage;
        let wanted = [guess.detect_leaves || known.foliage, guess.detect_leaves || !known.foliage];
        let entries =
            self.entries(shown, settings, Wish { candidates, guess, looks: wanted }, stop, progress)?;
        let mut found = compare(shown, entries, known.foliage, stop)?;
        if guess.detect_leaves {
            let other = compare(shown, entries, !known.foliage, stop)?;
            let (leafy, bare) = if known.foliage { (&found, &other) } else { (&other, &found) };
            let has_leaves = has_leaves(most_alike(leafy), most_alike(bare));
            if has_leaves != foliage {
                found = other;
                foliage = has_leaves;
            }
        }
        let mut costs = vec![f64::INFINITY; candidates.len()];
        let mut alike = Vec::new();
        for (entry, found) in entries.iter().zip(&found) {
            let Some(Resemblance { likeness, factor, .. }) = found else { continue };
            let attempt = &entry.attempt;
            let cost = 1.0 - likeness;
            costs[attempt.candidate] = costs[attempt.candidate].min(cost);
            if attempt.may_start {
                let mut genome = attempt.genome.clone();
                problem.generator.resize(&mut genome.values, *factor);
                alike.push((cost, attempt.candidate, genome));
            }
        }
        alike.sort_by(|a, b| a.0.total_cmp(&b.0));
        alike.truncate(guess.keep.max(1) * ALIKE);

        // Whatever looks alike may still stand beside the goal; what the search makes small decides.
        let known = FitProblem { foliage, ..known.clone() };
        let exact = Evaluator::new(&known, settings.objective, settings.limits)?.over_seeds(settings.robust);
        let scores = stoppable::map(&alike, stop, |(_, _, genome)| exact.score(genome))?;
        let mut nearest: Vec<Guess> = alike
            .into_iter()
            .zip(scores)
            .filter(|(_, score)| score.cost.is_finite())
            .map(|((_, candidate, genome), score)| Guess {
                name: candidates[candidate].name.clone(),
                values: genome.values,
                score,
            })
            .collect();
        nearest.sort_by(|a, b| a.score.cost.total_cmp(&b.score.cost));
        nearest.truncate(guess.keep.max(1));
        if nearest.is_empty() {
            return Err(FitError::NoStart);
        }
        let named = first_of(&costs);
        let pictures = pictures_of(shown, settings, (candidates, named), (entries, &found), foliage, stop)?;
        let references = References::of(&known, candidates, (entries, &found), named, &pictures);
        Ok(FirstGuess { nearest, names: confidence(candidates, &costs), foliage, references })
    }

    /// What a likeness to the goals of `problem` stands beside, for fits that begin without a first
    /// guess: with a few trees of each candidate, in a second or less.
    ///
    /// # Errors
    /// As [`first_guess`]; no candidate at all is none.
    pub fn references(
        &mut self,
        problem: &FitProblem,
        settings: &FitSettings,
        candidates: &[Candidate],
        stop: &AtomicBool,
    ) -> Result<References, FitError> {
        let known = known_views(problem);
        let looks = looks(&known, settings)?;
        let shown = (&known, &looks);
        let few = GuessSettings { variants: 0, seeds: REFERENCE_SEEDS, ..GuessSettings::default() };
        let wish = Wish { candidates, guess: &few, looks: [known.foliage, !known.foliage] };
        let entries = self.entries(shown, settings, wish, stop, |_, _| ())?;
        let found = compare(shown, entries, known.foliage, stop)?;
        let mut costs = vec![f64::INFINITY; candidates.len()];
        for (Entry { attempt, .. }, found) in entries.iter().zip(&found) {
            let cost = found.as_ref().map_or(f64::INFINITY, |found| 1.0 - found.likeness);
            costs[attempt.candidate] = costs[attempt.candidate].min(cost);
        }
        let named = first_of(&costs);
        let compared = (entries, &found[..]);
        let pictures = pictures_of(shown, settings, (candidates, named), compared, known.foliage, stop)?;
        Ok(References::of(&known, candidates, compared, named, &pictures))
    }
}

/// Pictures of several trees of candidate `named`, drawn as the goal is: those that are there, and more
/// seeds.
fn pictures_of(
    shown: (&FitProblem, &Evaluator),
    settings: &FitSettings,
    (candidates, named): (&[Candidate], Option<usize>),
    (entries, found): (&[Entry], &[Option<Resemblance>]),
    foliage: bool,
    stop: &AtomicBool,
) -> Result<Vec<Vec<Bitmap>>, FitError> {
    let Some(named) = named else { return Ok(Vec::new()) };
    let is_one = |entry: &Entry| entry.attempt.is_species && entry.attempt.candidate == named;
    let there = entries.iter().filter(|entry| is_one(entry)).count() as u64;
    let attempts = trees_of(shown.0, settings, candidates, named, there..TREES_OF_SPECIES.max(there))?;
    let more = library::shown_once(shown, attempts, foliage, stop)?;
    let known =
        entries.iter().zip(found).filter(|(entry, _)| is_one(entry)).filter_map(|(_, found)| found.as_ref());
    Ok(known.map(|found| found.pictures.clone()).chain(more.into_iter().map(|one| one.pictures)).collect())
}

/// `problem` without the pictures of which nobody knows from where they were taken: the search has yet
/// to find that out.
fn known_views(problem: &FitProblem) -> FitProblem {
    let mut known = problem.clone();
    known.goals.retain(|goal| goal.unknown.azimuth != Azimuth::Any);
    known
}

fn looks(problem: &FitProblem, settings: &FitSettings) -> Result<Evaluator, FitError> {
    let looks = Evaluator::new(problem, Objective::Likeness, settings.limits)?;
    Ok(looks.over_seeds(settings.robust).matching_height())
}

/// The candidate of the least cost, if one grew.
fn first_of(costs: &[f64]) -> Option<usize> {
    let (first, cost) = costs.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1))?;
    cost.is_finite().then_some(first)
}

/// Likeness of the tree that is most like the goal.
fn most_alike(found: &[Option<Resemblance>]) -> f64 {
    found.iter().flatten().map(|found| found.likeness).fold(0.0, f64::max)
}

/// Whether a goal has leaves, from the largest likeness that trees with leaves have to it, and those
/// without. In doubt it has.
fn has_leaves(leafy: f64, bare: f64) -> bool {
    leafy + BARE_BY >= bare
}

/// By how much more a goal must be like a bare tree than like a leafy one to be taken for bare.
///
/// Sparse small leaves of another program look like twigs to likeness: `targets/arbaro_lombardy_poplar.png`
/// is 0.0375 more like our bare trees. Of the bare trees of another program
/// `targets/treegen_apple_bare.png` is by 0.10, `targets/treegen_acer_bare.png` is not (−0.01). To lose
/// leaves is worse than to keep them.
const BARE_BY: f64 = 0.04;

/// One tree that is compared.
#[derive(Clone, Debug)]
struct Try {
    candidate: usize,
    /// Whether it is the candidate as it is, and not a variation.
    is_species: bool,
    /// Whether its seed is one that the search will use.
    may_start: bool,
    genome: Genome,
}

fn tries(
    problem: &FitProblem,
    settings: &FitSettings,
    candidates: &[Candidate],
    guess: &GuessSettings,
) -> Result<Vec<Try>, FitError> {
    let mut list = Vec::new();
    for (candidate, Candidate { values, .. }) in candidates.iter().enumerate() {
        let space = space_around(problem, values)?;
        let seeds = 0..u64::from(guess.seeds.max(1));
        list.extend(seeds.map(|i| of_species(&space, settings, candidate, values, i)));
        for i in 0..guess.variants {
            let mut draws = Stream::at(settings.seed, VARIATION, candidate as u64, i);
            let mut genome = space.individual(values, first_seed(settings));
            let mut read = Vec::new();
            space.active_genes(values, &mut read);
            for gene in read.into_iter().map(|g| &space.genes()[g]).filter(|gene| !gene.is_choice()) {
                let value = gene.clamp(gene.of(&genome) * (1.0 + guess.spread * draws.normal()));
                gene.set(&mut genome, value);
            }
            space.settle(&mut genome);
            list.push(Try { candidate, is_species: false, may_start: true, genome });
        }
    }
    Ok(list)
}

/// Trees of one candidate as it is, of the seeds from `seeds.start` on.
fn trees_of(
    problem: &FitProblem,
    settings: &FitSettings,
    candidates: &[Candidate],
    candidate: usize,
    seeds: Range<u64>,
) -> Result<Vec<Try>, FitError> {
    let values = &candidates[candidate].values;
    let space = space_around(problem, values)?;
    Ok(seeds.map(|i| of_species(&space, settings, candidate, values, i)).collect())
}

fn space_around(problem: &FitProblem, values: &[f64]) -> Result<SearchSpace, FitError> {
    let generator = Arc::clone(&problem.generator);
    let space = SearchSpace::new(generator, values, &Freedom::default(), TreeSeed::Any)?;
    Ok(space.plausible(values).settling(true))
}

fn of_species(space: &SearchSpace, settings: &FitSettings, candidate: usize, values: &[f64], i: u64) -> Try {
    let may_start = i == 0 || settings.tree_seed == TreeSeed::Any;
    let mut genome = space.individual(values, first_seed(settings).wrapping_add(i));
    space.settle(&mut genome);
    Try { candidate, is_species: true, may_start, genome }
}

const fn first_seed(settings: &FitSettings) -> u64 {
    match settings.tree_seed {
        TreeSeed::Fixed(seed) => seed,
        TreeSeed::Any => settings.seed,
    }
}

/// Names with the share of belief that their best scores deserve, best first.
fn confidence(candidates: &[Candidate], costs: &[f64]) -> Vec<(String, f64)> {
    let best = costs.iter().copied().fold(f64::INFINITY, f64::min);
    let weights: Vec<f64> = costs.iter().map(|cost| ((best - cost) / DOUBT).exp()).collect();
    let sum: f64 = weights.iter().sum();
    let mut names: Vec<_> =
        candidates.iter().zip(&weights).map(|(c, weight)| (c.name.clone(), weight / sum)).collect();
    names.sort_by(|a, b| b.1.total_cmp(&a.1));
    names
}
