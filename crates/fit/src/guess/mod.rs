//! A first guess: which known species a goal looks like, and the lists that a search may start from.
//!
//! Candidates may be of any family of generators; each grows its own trees. Where they are of several
//! generators, the likeliest are each searched for a short while ([`RaceSettings`]); the one that stands
//! best by what it has reached, and by how like the goal its trees were before, is searched on, from lists
//! of that generator alone.
//!
//! Trees of all candidates are grown as they are and with their numbers varied, drawn finely, laid into
//! the goal's frame at the goal's height, and compared by likeness, which knows a species by other trees
//! than the goal's. Of many candidates one tree each is compared at first, and more of those that are
//! near. The drawings serve all goals of a [`GuessLibrary`]; those of known species may have been made
//! before ([`Drawings`]).
//!
//! Drawings are from the front. For goals from elsewhere, and for several, trees of all candidates would have to be
//! grown: the front drawings choose a few candidates instead, whatever the view, and these alone are grown and
//! compared in the goals' own views (`preview.rs`).
//!
//! The same drawings tell whether the goal has leaves, and what its likeness to other trees is worth.

mod candidate;
mod drawings;
mod library;
mod near;
mod plate;
mod preview;
mod race;
mod references;
mod settings;
mod shown;
mod tries;

pub use candidate::Candidate;
pub use drawings::{Drawings, DrawingsError};
pub use library::GuessLibrary;
pub(crate) use plate::Plate;
use pleach_tree::math;
pub use race::Runner;
pub use references::{Reference, References};
pub use settings::{GuessSettings, RaceSettings};

use crate::cancellable;
use crate::error::FitError;
use crate::evaluator::Evaluator;
use crate::genome::{Genome, Score};
use crate::method::Start;
use crate::nuisance::Azimuth;
use crate::objective::Objective;
use crate::problem::{FitProblem, with_values};
use crate::settings::FitSettings;
use crate::space::SpaceError;
use candidate::Models;
use library::{Entry, Resemblance, compare};
use near::Near;
use pleach_silhouette::Bitmap;
use pleach_tree::{Foliage, Species};
use shown::Shown;
use std::sync::atomic::AtomicBool;
use tries::trees_of;

/// What a goal looks like before any search.
#[derive(Clone, Debug)]
pub struct FirstGuess {
    /// The species to start from: the nearest candidate with the numbers of the first of `nearest`, in the
    /// colours of the likeliest.
    pub species: Species,
    /// The nearest lists of the species' generator, best first; at least one.
    pub nearest: Vec<Guess>,
    /// What a race has found that is better than all of these, if there was one.
    pub raced: Option<Guess>,
    /// How the generators did that the goal may be of, the one that is searched first.
    pub runners: Vec<Runner>,
    /// The candidates of the species' family with the confidence that the goal is theirs, in 0..=1, the
    /// likeliest first; sums to 1.
    pub names: Vec<(String, f64)>,
    /// Whether the goal is taken for a tree with leaves: what `FitProblem::foliage` should be. All of
    /// the above is of trees like that.
    pub foliage: Foliage,
    /// What the likeness of a fit to the goal stands beside.
    pub references: References,
}

impl FirstGuess {
    /// The lists that a search starts from.
    #[must_use]
    pub fn start(&self) -> Start {
        let lists = self.raced.iter().chain(&self.nearest);
        Start::Lists(lists.map(|guess| guess.values.clone()).collect())
    }

    /// `problem` with the species that it looks like to start from, with leaves or without.
    #[must_use]
    pub fn problem(&self, problem: &FitProblem) -> FitProblem {
        FitProblem { start: self.species.clone(), goals: problem.goals.clone(), foliage: self.foliage }
    }
}

/// One of the nearest lists.
#[derive(Clone, Debug, PartialEq)]
pub struct Guess {
    /// The candidate that it is, or is a variation of.
    pub name: String,
    /// One value per slot, resized to the goal's height.
    pub values: Vec<f64>,
    /// Its score with the problem's tree seed.
    pub score: Score,
}

/// Of the trees that look most like the goal, this many times those that are kept are scored by what
/// the search makes small, and of each family as many as are kept.
const ALIKE: usize = 3;
/// By how much worse a candidate's likeness is when it is e times less probable.
const DOUBT: f64 = 0.02;

/// Compares the goals of `problem` with trees of all `candidates`; tells `progress` how many of how
/// many are grown.
///
/// Of `settings` the seed, tree seed, objective and limits are used. `problem.start` is not.
///
/// # Errors
/// A problem that [`Evaluator::new`] refuses, [`FitError::NoStart`] if no candidate grows, or
/// [`FitError::Interrupted`] once `stop` is raised.
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
        mut progress: impl FnMut(usize, usize),
    ) -> Result<FirstGuess, FitError> {
        let known = known_views(problem);
        let looks = looks(&known, settings)?;
        let shown = Shown::new(&known, candidates, &looks, settings, stop, self.prepared.clone());
        let preview = self.preview(&known, settings, candidates, guess, stop, &mut progress)?;
        let (entries, foliage, found) = match &preview {
            None => self.seen(&shown, guess, &mut progress)?,
            Some(preview) => {
                let wanted = [Foliage::All, Foliage::None].map(|one| one == preview.foliage);
                let near = Near::few(&shown, &preview.costs);
                let entries = self.entries(&shown, guess, wanted, &near, &mut progress)?;
                (entries, preview.foliage, compare(&shown, entries, preview.foliage, &near)?)
            }
        };
        let keep = guess.keep.max(1);
        let (mut costs, alike) = ranked(&shown, (entries, &found), keep);
        let mut of_species = references::of_species(candidates.len(), entries, &found);
        if let Some(preview) = preview {
            preview.complete(&mut costs, &mut of_species);
        }
        // What looks alike may still stand beside the goal: the objective of the search decides.
        let known = FitProblem { foliage, ..known.clone() };
        let mut all = race::contenders(&shown, scored(&known, &shown, alike)?, &costs, keep);
        if let (Some(how), 2..) = (guess.race, all.len()) {
            all = race::race(&known, &shown, how, all, &mut progress)?;
        }
        let Some(winner) = all.first() else { return Err(FitError::NoStart) };
        let values = winner.lists[0].values.clone();
        let mut species =
            with_values(&candidates[winner.candidate].species, values).map_err(SpaceError::Start)?;
        let family = shown.family(winner.candidate);
        for (candidate, cost) in costs.iter_mut().enumerate() {
            if shown.family(candidate) != family {
                *cost = f64::INFINITY;
            }
        }
        let named = first_of(&costs);
        if let Some(named) = named {
            species.appearance = candidates[named].species.appearance;
        }
        let pictures = pictures_of(&shown, named, (entries, &found), foliage)?;
        let references = References::new(&known, candidates, &of_species, named, &pictures);
        self.close();
        Ok(FirstGuess {
            species,
            nearest: winner.lists.clone(),
            raced: winner.found.clone(),
            runners: all.iter().map(|one| one.runner(&shown)).collect(),
            names: confidence(candidates, &costs),
            foliage,
            references,
        })
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
        let shown = Shown::new(&known, candidates, &looks, settings, stop, self.prepared.clone());
        let few = GuessSettings { variants: 0, seeds: REFERENCE_SEEDS, ..GuessSettings::default() };
        let wanted = [Foliage::All, Foliage::None].map(|foliage| foliage == known.foliage);
        let entries = self.entries(&shown, &few, wanted, &Near::All, |_, _| ())?;
        let found = compare(&shown, entries, known.foliage, &Near::All)?;
        let (costs, _) = ranked(&shown, (entries, &found), 0);
        let named = first_of(&costs);
        let pictures = pictures_of(&shown, named, (entries, &found), known.foliage)?;
        let of_species = references::of_species(candidates.len(), entries, &found);
        let references = References::new(&known, candidates, &of_species, named, &pictures);
        self.close();
        Ok(references)
    }

    /// The trees that the goals that are `shown` are compared with, whether those have leaves, and how they compare.
    fn seen(
        &mut self,
        shown: &Shown<'_>,
        guess: &GuessSettings,
        mut progress: impl FnMut(usize, usize),
    ) -> Result<(&[Entry], Foliage, Vec<Option<Resemblance>>), FitError> {
        let both = guess.detect_leaves;
        let wanted = [Foliage::All, Foliage::None].map(|foliage| both || foliage == shown.problem.foliage);
        let near = Near::at_first(shown);
        let entries = self.entries(shown, guess, wanted, &near, &mut progress)?;
        let (foliage, found) = leaves(shown, entries, guess.detect_leaves, &near)?;
        let near = match near {
            Near::All => near,
            _ => Near::nearest(shown, &ranked(shown, (entries, &found), 0).0),
        };
        if near == Near::All {
            return Ok((self.latest(), foliage, found));
        }
        let wanted = [Foliage::All, Foliage::None].map(|one| one == foliage);
        let entries = self.entries(shown, guess, wanted, &near, &mut progress)?;
        let found = compare(shown, entries, foliage, &near)?;
        Ok((entries, foliage, found))
    }
}

/// Whether the goals have leaves, if that is to be `detected`, and how trees like that compare with them.
fn leaves(
    shown: &Shown<'_>,
    entries: &[Entry],
    detected: bool,
    near: &Near,
) -> Result<(Foliage, Vec<Option<Resemblance>>), FitError> {
    let given = shown.problem.foliage;
    let found = compare(shown, entries, given, near)?;
    if !detected {
        return Ok((given, found));
    }
    let other = if given == Foliage::None { Foliage::All } else { Foliage::None };
    let found_other = compare(shown, entries, other, near)?;
    let [leafy, bare] = if given == Foliage::None { [&found_other, &found] } else { [&found, &found_other] };
    // Species that never have leaves say nothing for or against them.
    let counts: Vec<bool> = leafy.iter().map(|one| one.as_ref().is_some_and(|one| one.has_foliage)).collect();
    let (leafy, bare) = (most_alike(leafy, &counts), most_alike(bare, &counts));
    let foliage = if has_leaves(leafy, bare) { Foliage::All } else { Foliage::None };
    Ok(if foliage == given { (given, found) } else { (other, found_other) })
}

/// An individual of a candidate, and what it lacks of a likeness of 1.
type Alike = (f64, usize, Genome);

/// The least cost of each candidate, and the individuals that look most like the goal, at its height:
/// some of all, and `keep` of each family.
fn ranked(
    shown: &Shown<'_>,
    (entries, found): (&[Entry], &[Option<Resemblance>]),
    keep: usize,
) -> (Vec<f64>, Vec<Alike>) {
    let mut costs = vec![f64::INFINITY; shown.candidates.len()];
    let mut alike = Vec::new();
    for (Entry { attempt, .. }, found) in entries.iter().zip(found) {
        let Some(Resemblance { likeness, factor, .. }) = found else { continue };
        let cost = 1.0 - likeness;
        costs[attempt.candidate] = costs[attempt.candidate].min(cost);
        if attempt.may_start {
            let mut genome = attempt.genome.clone();
            shown.resize(attempt.candidate, &mut genome.values, *factor);
            alike.push((cost, attempt.candidate, genome));
        }
    }
    alike.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut kept = Vec::<Alike>::new();
    let of_family = |kept: &[Alike], family| kept.iter().filter(|one| shown.family(one.1) == family).count();
    for one in alike {
        if kept.len() < keep * ALIKE || of_family(&kept, shown.family(one.1)) < keep {
            kept.push(one);
        }
    }
    (costs, kept)
}

/// Individuals with their candidates, scored by what the search makes small, best first; without those
/// that do not grow.
fn scored(
    problem: &FitProblem,
    shown: &Shown<'_>,
    alike: Vec<Alike>,
) -> Result<Vec<(usize, Guess)>, FitError> {
    let settings = shown.settings;
    let exact = Evaluator::new(problem, settings.objective, settings.limits)?.with_seeds(settings.robust);
    let exact = Models::new(shown.candidates, &exact);
    let score = |(_, candidate, genome): &Alike| exact.evaluator(*candidate).score(genome);
    let scores = cancellable::map(&alike, shown.stop, score)?;
    let name = |candidate: usize| shown.candidates[candidate].species.name.clone();
    let mut nearest: Vec<(usize, Guess)> = (alike.into_iter().zip(scores))
        .filter(|(_, score)| score.cost.is_finite())
        .map(|((_, candidate, genome), score)| {
            (candidate, Guess { name: name(candidate), values: genome.values, score })
        })
        .collect();
    nearest.sort_by(|a, b| a.1.score.cost.total_cmp(&b.1.score.cost));
    Ok(nearest)
}

/// Pictures of several trees of candidate `named`, drawn as the goal is: those that are there, and more
/// seeds.
fn pictures_of(
    shown: &Shown<'_>,
    named: Option<usize>,
    (entries, found): (&[Entry], &[Option<Resemblance>]),
    foliage: Foliage,
) -> Result<Vec<Vec<Bitmap>>, FitError> {
    let Some(named) = named else { return Ok(Vec::new()) };
    let is_one = |entry: &Entry| entry.attempt.is_species && entry.attempt.candidate == named;
    let there = entries.iter().filter(|entry| is_one(entry)).count() as u64;
    let seeds = there..TREES_OF_SPECIES.max(there);
    let more =
        library::shown_once(shown, trees_of(shown.settings, shown.candidates, named, seeds)?, foliage)?;
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
    Ok(looks.with_seeds(settings.robust).with_height_matching())
}

/// The candidate of the least cost, if one grew.
fn first_of(costs: &[f64]) -> Option<usize> {
    let (first, cost) = costs.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1))?;
    cost.is_finite().then_some(first)
}

/// Likeness of the tree that is most like the goal, among those that count.
fn most_alike(found: &[Option<Resemblance>], counts: &[bool]) -> f64 {
    let counting = found.iter().zip(counts).filter(|(_, counts)| **counts);
    counting.filter_map(|(found, _)| found.as_ref()).map(|one| one.likeness).fold(0.0, f64::max)
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

/// Names with the share of belief that their best scores deserve, best first.
fn confidence(candidates: &[Candidate], costs: &[f64]) -> Vec<(String, f64)> {
    let best = costs.iter().copied().fold(f64::INFINITY, f64::min);
    let weights: Vec<f64> = costs.iter().map(|cost| math::exp((best - cost) / DOUBT)).collect();
    let sum: f64 = weights.iter().sum();
    let mut names: Vec<_> =
        candidates.iter().zip(&weights).map(|(c, weight)| (c.species.name.clone(), weight / sum)).collect();
    names.sort_by(|a, b| b.1.total_cmp(&a.1));
    names
}
