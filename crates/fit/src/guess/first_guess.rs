//! A first guess, step by step.

use super::candidate::Candidate;
use super::comparison::pictures_of;
use super::found::{FirstGuess, Reference, References};
use super::goal_context::{GoalContext, known_views, likeness_evaluator};
use super::learnt::with_densities;
use super::library::{GuessLibrary, Resemblance, compare};
use super::measured::measured;
use super::near::Near;
use super::predicted::predicted;
use super::race::{Contender, Race, contenders};
use super::ranking::{confidence, first_of, ranked, scored};
use super::references;
use super::settings::GuessSettings;
use crate::error::FitError;
use crate::problem::{FitProblem, with_values};
use crate::run::FitSettings;
use crate::space::SpaceError;
use pleach_tree::{Foliage, Species};
use std::sync::atomic::AtomicBool;

/// Compares the goals of `problem` with trees of all `candidates`. `progress` is called with the numbers of trees
/// that are grown and of all.
///
/// Of `settings` the seed, tree seed, objective and limits are used. `problem.start` is not.
///
/// # Errors
/// A problem that [`Evaluator::new`](crate::Evaluator::new) refuses, [`FitError::NoStart`] if no candidate grows, or
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

/// What is told during a first guess.
#[derive(Debug)]
pub(crate) enum Guessed {
    /// So many trees are grown, and so many are to be.
    Grown(usize, usize),
    /// The tree of the library that is most like the goals.
    Nearest(Box<Species>, Foliage),
}

/// A first guess before its race is run.
#[derive(Debug)]
pub(crate) struct OpenGuess {
    /// The goals whose views are known.
    known: FitProblem,
    settings: FitSettings,
    candidates: Vec<Candidate>,
    /// 1 minus the likeness of each candidate, with what was learnt about its trees.
    costs: Vec<f64>,
    /// How the library's trees compare with the goals.
    found: Vec<Option<Resemblance>>,
    /// Those of them that are trees of candidates as they are, by candidate.
    by_candidate: Vec<Vec<Reference>>,
    foliage: Foliage,
    pub(crate) race: Race,
}

impl GuessLibrary {
    /// [`first_guess`] with the trees of this library, which grows missing ones.
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
        let mut open = self.open_guess(problem, settings, candidates, guess, stop, |told| {
            if let Guessed::Grown(done, all) = told {
                progress(done, all);
            }
        })?;
        open.race.run(stop, &mut progress)?;
        self.close_guess(open, stop)
    }

    /// A first guess whose race is left to the caller, who then calls [`Self::close_guess`].
    ///
    /// # Errors
    /// As [`first_guess`].
    pub(crate) fn open_guess(
        &mut self,
        problem: &FitProblem,
        settings: &FitSettings,
        candidates: &[Candidate],
        guess: &GuessSettings,
        stop: &AtomicBool,
        mut tell: impl FnMut(Guessed),
    ) -> Result<OpenGuess, FitError> {
        let mut progress = |done, all| tell(Guessed::Grown(done, all));
        let known = known_views(problem);
        let evaluator = likeness_evaluator(&known, settings)?;
        let context = GoalContext::new(&known, candidates, &evaluator, settings, stop, self.prepared.clone())
            .with_contradictions(guess.contradictions);
        let predictors = self.predictors.clone();
        let preview = self.preview(&known, settings, candidates, guess, stop, &mut progress)?;
        let (entries, foliage, found) = match &preview {
            None => self.seen(&context, guess, &mut progress)?,
            Some(preview) => {
                let wanted = [Foliage::All, Foliage::None].map(|one| one == preview.foliage);
                let near = Near::few(&context, &preview.costs);
                let entries = self.entries(&context, guess, wanted, &near, &mut progress)?;
                (entries, preview.foliage, compare(&context, entries, preview.foliage, &near)?)
            }
        };
        let keep = guess.keep.max(1);
        let (mut costs, mut alike) = ranked(&context, (entries, &found), keep);
        let mut by_candidate = references::by_candidate(candidates.len(), entries, &found);
        if let Some(preview) = preview {
            preview.complete(&mut costs, &mut by_candidate);
        }
        let nearest = alike.first().and_then(|(_, candidate, genome)| {
            with_values(&candidates[*candidate].species, genome.values.clone()).ok()
        });
        if let Some(species) = nearest {
            tell(Guessed::Nearest(Box::new(species), foliage));
        }
        alike.extend(measured(&context, &alike, foliage)?);
        alike.extend(predicted(&context, predictors.as_ref(), &costs, &alike, foliage)?);
        // A tree that looks like the goal may still stand beside it: the objective of the search decides.
        let raced = FitProblem { foliage, ..known.clone() };
        let all = contenders(&context, scored(&raced, &context, alike)?, &costs, keep);
        let costs = with_densities(&context, predictors.as_ref(), foliage, &costs);
        let race = Race::new(&raced, &context, guess.race, all)?;
        let (settings, candidates) = (settings.clone(), candidates.to_vec());
        drop(context);
        Ok(OpenGuess { known, settings, candidates, costs, found, by_candidate, foliage, race })
    }

    /// The first guess that a race decides, run or not; `open` is of this library, which has made no other since.
    ///
    /// # Errors
    /// As [`first_guess`].
    pub(crate) fn close_guess(&mut self, open: OpenGuess, stop: &AtomicBool) -> Result<FirstGuess, FitError> {
        let OpenGuess { known, settings, candidates, mut costs, found, by_candidate, foliage, race } = open;
        let all = race.into_contenders();
        let Some(winner) = all.first() else { return Err(FitError::NoStart) };
        let values = winner.lists[0].values.clone();
        let mut species =
            with_values(&candidates[winner.candidate].species, values).map_err(SpaceError::Start)?;
        for (cost, candidate) in costs.iter_mut().zip(&candidates) {
            if candidate.species.generator.family() != winner.family {
                *cost = f64::INFINITY;
            }
        }
        let named = first_of(&costs);
        if let Some(named) = named {
            species.appearance = candidates[named].species.appearance;
        }
        let evaluator = likeness_evaluator(&known, &settings)?;
        let drawings = self.prepared.clone();
        let context = GoalContext::new(&known, &candidates, &evaluator, &settings, stop, drawings);
        let pictures = pictures_of(&context, named, (self.latest(), &found), foliage)?;
        let references = References::new(&known, &candidates, &by_candidate, named, &pictures);
        self.close();
        Ok(FirstGuess {
            species,
            nearest: winner.lists.clone(),
            raced: winner.found.clone(),
            runners: all.iter().map(Contender::runner).collect(),
            names: confidence(&candidates, &costs),
            foliage,
            references,
        })
    }

    /// Reference values for the likeness of fits without a first guess: from a few trees of each candidate, in a
    /// second or less.
    ///
    /// # Errors
    /// As [`first_guess`]; an empty list of candidates is not an error.
    pub fn references(
        &mut self,
        problem: &FitProblem,
        settings: &FitSettings,
        candidates: &[Candidate],
        stop: &AtomicBool,
    ) -> Result<References, FitError> {
        let known = known_views(problem);
        let evaluator = likeness_evaluator(&known, settings)?;
        let context = GoalContext::new(&known, candidates, &evaluator, settings, stop, self.prepared.clone());
        let few = GuessSettings { variants: 0, seeds: REFERENCE_SEEDS, ..GuessSettings::default() };
        let wanted = [Foliage::All, Foliage::None].map(|foliage| foliage == known.foliage);
        let entries = self.entries(&context, &few, wanted, &Near::All, |_, _| ())?;
        let found = compare(&context, entries, known.foliage, &Near::All)?;
        let (costs, _) = ranked(&context, (entries, &found), 0);
        let named = first_of(&costs);
        let pictures = pictures_of(&context, named, (entries, &found), known.foliage)?;
        let by_candidate = references::by_candidate(candidates.len(), entries, &found);
        let references = References::new(&known, candidates, &by_candidate, named, &pictures);
        self.close();
        Ok(references)
    }
}
