//! A first guess: which known species a goal looks like, and the lists that a search may start from.
//!
//! Trees of all candidates are grown as they are and with their numbers varied, resized to the goal's
//! height, drawn, and compared by likeness, which knows a species by other trees than the goal's.
//! Nothing is stored between runs: growing a few hundred
//! trees takes a second or two, and what is grown anew is never out of date.

use crate::evaluator::{Evaluator, FitProblem};
use crate::genome::{Genome, Score};
use crate::nuisance::Azimuth;
use crate::objective::Objective;
use crate::run::FitError;
use crate::settings::FitSettings;
use crate::space::{Freedom, SearchSpace, TreeSeed};
use crate::stoppable;
use crate::stream::Stream;
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
}

impl Default for GuessSettings {
    fn default() -> Self {
        Self { variants: 8, spread: 0.15, seeds: 3, keep: 10 }
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
/// many are done.
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
    mut progress: impl FnMut(usize, usize),
) -> Result<FirstGuess, FitError> {
    // From where the others were taken, the search has yet to find out.
    let mut known = problem.clone();
    known.goals.retain(|goal| goal.unknown.azimuth != Azimuth::Any);
    let problem = &known;
    let looks = Evaluator::new(problem, Objective::Likeness, settings.limits)?;
    let looks = looks.over_seeds(settings.robust).matching_height();
    let tries = tries(problem, settings, candidates, guess)?;
    let mut scores = Vec::new();
    for batch in tries.chunks(BATCH) {
        scores.extend(stoppable::map(batch, stop, |attempt| looks.score(&attempt.genome))?);
        progress(scores.len(), tries.len());
    }
    let mut costs = vec![f64::INFINITY; candidates.len()];
    let mut alike = Vec::new();
    for (mut attempt, score) in tries.into_iter().zip(scores) {
        if score.cost.is_finite() {
            costs[attempt.candidate] = costs[attempt.candidate].min(score.cost);
            if attempt.may_start {
                problem.generator.resize(&mut attempt.genome.values, score.resized);
                alike.push((score.cost, attempt));
            }
        }
    }
    alike.sort_by(|a, b| a.0.total_cmp(&b.0));
    alike.truncate(guess.keep.max(1) * ALIKE);

    // Whatever looks alike may still stand beside the goal; what the search makes small decides.
    let exact = Evaluator::new(problem, settings.objective, settings.limits)?.over_seeds(settings.robust);
    let scores = stoppable::map(&alike, stop, |(_, attempt)| exact.score(&attempt.genome))?;
    let mut nearest: Vec<Guess> = alike
        .into_iter()
        .zip(scores)
        .map(|((_, attempt), score)| Guess {
            name: candidates[attempt.candidate].name.clone(),
            values: attempt.genome.values,
            score,
        })
        .collect();
    nearest.sort_by(|a, b| a.score.cost.total_cmp(&b.score.cost));
    nearest.truncate(guess.keep.max(1));
    if nearest.is_empty() {
        return Err(FitError::NoStart);
    }
    Ok(FirstGuess { nearest, names: confidence(candidates, &costs) })
}

/// One tree that is compared.
struct Try {
    candidate: usize,
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
        let generator = Arc::clone(&problem.generator);
        let space = SearchSpace::new(generator, values, &Freedom::default(), TreeSeed::Any)?.settling(true);
        let first = match settings.tree_seed {
            TreeSeed::Fixed(seed) => seed,
            TreeSeed::Any => settings.seed,
        };
        for i in 0..u64::from(guess.seeds.max(1)) {
            let may_start = i == 0 || settings.tree_seed == TreeSeed::Any;
            let mut genome = space.individual(values, first.wrapping_add(i));
            space.settle(&mut genome);
            list.push(Try { candidate, may_start, genome });
        }
        for i in 0..guess.variants {
            let mut draws = Stream::at(settings.seed, VARIATION, candidate as u64, i);
            let mut genome = space.individual(values, first);
            let mut read = Vec::new();
            space.read_genes(values, &mut read);
            for gene in read.into_iter().map(|g| &space.genes()[g]).filter(|gene| !gene.is_choice()) {
                let value = gene.clamp(gene.of(&genome) * (1.0 + guess.spread * draws.normal()));
                gene.set(&mut genome, value);
            }
            space.settle(&mut genome);
            list.push(Try { candidate, may_start: true, genome });
        }
    }
    Ok(list)
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
