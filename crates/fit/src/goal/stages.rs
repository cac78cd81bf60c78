//! The stages of a whole fit before and after its search.

use super::deadline::TimeLeft;
use super::settings::{Fitted, GoalSettings, Guessing};
use crate::assess::{AssessmentSettings, Assessor, best_kind, finer_leaves, with_expected_numbers};
use crate::control::{Control, Outcome, PreparedSearch, StopReason, Until};
use crate::error::FitError;
use crate::evaluator::Evaluator;
use crate::guess::{FirstGuess, GuessLibrary, Guessed, OpenGuess};
use crate::individual::{IndividualSettings, individuals};
use crate::method::Start;
use crate::posterior::{Posterior, PosteriorModel, PosteriorSettings, Prior};
use crate::predictor::Answer;
use crate::problem::FitProblem;
use crate::registration::{Closeness, with_registered_frames};
use crate::run::{FitSettings, evaluator_in, search_space};
use crate::space::{Gene, SpaceError};
use pleach_tree::{Limits, Slot, Species};
use std::sync::atomic::Ordering;

/// Whether former bests of such a search may be validated on other seeds.
fn validates(search: &FitSettings) -> bool {
    search.objective.uses_likeness() && search.rules.is_none() && search.optimizer.keeps_to_plausible()
}

/// Assesses the result of a search, unless the flag of `control` is raised, and searches for this very tree.
pub(super) fn conclude(
    mut prepared: PreparedSearch,
    mut outcome: Outcome,
    settings: &GoalSettings,
    library: &mut GuessLibrary,
    mut control: Control<'_>,
) -> Result<Fitted, FitError> {
    let found = outcome.best.clone().filter(|best| best.score.cost.is_finite());
    let Some(mut best) = found else {
        return Err(match outcome.stop {
            StopReason::Interrupted => FitError::Interrupted,
            _ => FitError::NothingGrew { evaluations: outcome.evaluations },
        });
    };
    if best.genome.structure.is_some() {
        // From here on it is a fit of the generator that was found.
        prepared.problem.start = prepared.problem.species(&best.genome).map_err(SpaceError::Start)?;
        best.genome.structure = None;
    }
    let evaluate = || {
        let evaluator = Evaluator::new(&prepared.problem, prepared.settings.objective, Limits::DEFAULT)?;
        evaluator.evaluate_with_likeness(&best.genome);
        Ok(())
    };
    let left =
        TimeLeft::new(settings.deadline, settings.individual, outcome.elapsed, control.clock, evaluate)?;
    let answer = library.answer(&prepared.problem, known_species(&prepared, settings));
    let share = settings.assessment.and_then(|how| left.for_assessment(how.time));
    let late = share.map(|share| control.clock.elapsed() + share / 2);
    let until = Until::from(control.stop).or_late(control.clock, late);
    let validates = settings.validates && validates(&prepared.settings);
    if validates {
        let mut finalists = outcome.finalists.clone();
        finalists.push(best.clone());
        match best_kind(&prepared.problem, prepared.settings.objective, &finalists, until) {
            Ok(kind) => best = finalists.swap_remove(kind),
            Err(FitError::Interrupted) => outcome.stop = StopReason::Interrupted,
            Err(error) => return Err(error),
        }
        let search = &prepared.settings;
        match finer_leaves(&prepared.problem, search.objective, &search.freedom, best.clone(), until) {
            Ok(finer) => best = finer,
            Err(FitError::Interrupted) => outcome.stop = StopReason::Interrupted,
            Err(error) => return Err(error),
        }
    }
    let evaluator = Evaluator::new(&prepared.problem, prepared.settings.objective, Limits::DEFAULT)?;
    prepared.problem = with_registered_frames(&prepared.problem, &evaluator, &best.genome, Closeness::Result);
    drop(evaluator);
    let mut as_expected = Vec::new();
    // A frame that is a pixel off hides that a tree is the goal's own, which is to stay as it is.
    if validates {
        let numbers = expected(&prepared, answer.as_ref());
        match with_expected_numbers(&prepared.problem, &prepared.settings, &best, &numbers, until) {
            Ok((kept, slots)) => (best, as_expected) = (kept, slots),
            Err(FitError::Interrupted) => outcome.stop = StopReason::Interrupted,
            Err(error) => return Err(error),
        }
    }
    let mut assessment = None;
    if settings.assessment.is_some() && control.stop.load(Ordering::Relaxed) {
        outcome.stop = StopReason::Interrupted;
    } else if let Some(how) = settings.assessment {
        control.observers.iter_mut().for_each(|observer| observer.assessing());
        let (clock, stop) = (control.clock, control.stop);
        let how = AssessmentSettings { time: left.for_assessment(how.time), ..how };
        let (finalists, candidates) = (&outcome.finalists, &settings.candidates);
        let known = answer.as_ref().map_or(&[][..], |answer| &answer.numbers);
        let assessor =
            Assessor { prepared: &prepared, finalists, settings: how, candidates, known, clock, stop };
        match assessor.assess(&best, library) {
            Ok((kept, found)) => (best, assessment) = (kept, Some(found)),
            // The search may have ended by itself, the fit has not.
            Err(FitError::Interrupted) => outcome.stop = StopReason::Interrupted,
            Err(error) => return Err(error),
        }
    }
    let mut found = Vec::new();
    let time = left.for_individuals();
    let individual = settings.individual.map(|how| IndividualSettings { time, ..how });
    if individual.is_some() && control.stop.load(Ordering::Relaxed) {
        outcome.stop = StopReason::Interrupted;
    } else if let Some(how) = individual {
        let Control { clock, stop, observers, .. } = &mut control;
        let notify = |progress: &_| observers.iter_mut().for_each(|observer| observer.individual(progress));
        match individuals(&prepared.problem, &best.genome, how, *clock, stop, notify) {
            Ok(individuals) => found = individuals,
            Err(FitError::Interrupted) => outcome.stop = StopReason::Interrupted,
            Err(error) => return Err(error),
        }
    }
    let mut posterior = None;
    if let Some(how) = settings.posterior.filter(|_| !control.stop.load(Ordering::Relaxed)) {
        match learnt(&prepared, how, &mut control) {
            Ok(learnt) => posterior = learnt,
            Err(FitError::Interrupted) => outcome.stop = StopReason::Interrupted,
            Err(error) => return Err(error),
        }
    }
    let PreparedSearch { problem, settings, guess } = prepared;
    Ok(Fitted {
        problem,
        settings,
        guess,
        outcome,
        best,
        as_expected,
        assessment,
        individuals: found,
        posterior,
        answer,
    })
}

/// The known species that the goal looks like; without a first guess the one that the search started from.
fn known_species<'a>(prepared: &'a PreparedSearch, settings: &'a GoalSettings) -> &'a Species {
    let named = prepared.guess.as_ref().and_then(|guess| guess.names.first());
    let of_name = |name: &str| settings.candidates.iter().find(|one| one.species.name == name);
    named.and_then(|(name, _)| of_name(name)).map_or(&prepared.problem.start, |known| &known.species)
}

/// Where the free numbers of a tree that looks like the goal are expected, the least certain last: in the middle of
/// trees around the known species whose pictures look so, and else where the search started from.
fn expected(prepared: &PreparedSearch, answer: Option<&Answer>) -> Vec<(Slot, f64)> {
    let Some(start) = prepared.settings.start.lists().first() else { return Vec::new() };
    // What was learnt follows from the silhouette; where a person says otherwise, it is the wrong tree's.
    let is_corrected = prepared.problem.goals.first().is_some_and(|goal| goal.reading.is_some());
    let answer = answer.filter(|answer| answer.familiarity >= Posterior::STRANGE && !is_corrected);
    let known = answer.map_or(&[][..], |answer| &answer.numbers);
    let mut all: Vec<(f64, Slot, f64)> = prepared
        .problem
        .start
        .generator
        .space()
        .slots()
        .map(|slot| match known.iter().find(|number| number.slot == slot) {
            Some(number) => (number.shrunk, slot, number.posterior.median),
            None => (0.0, slot, start[slot.index()]),
        })
        .collect();
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    all.into_iter().map(|(_, slot, value)| (slot, value)).collect()
}

/// What the goals say about the numbers of their tree; `None` where too few trees of the prior grow.
fn learnt(
    prepared: &PreparedSearch,
    settings: PosteriorSettings,
    control: &mut Control<'_>,
) -> Result<Option<Posterior>, FitError> {
    let PreparedSearch { problem, settings: search, .. } = prepared;
    let prior = Prior::from_problem(problem, &search.freedom, settings.spread)?;
    let (stop, observers) = (control.stop, &mut control.observers);
    let notify = |done| observers.iter_mut().for_each(|observer| observer.learning(done, settings.trees));
    match PosteriorModel::learn(problem, &prior, settings, Until::from(stop), notify) {
        Ok(model) => Ok(Some(model.posterior(problem.goals.iter().map(|goal| &goal.goal)))),
        Err(FitError::NothingGrew { .. }) => Ok(None),
        Err(error) => Err(error),
    }
}

/// Where a search without a first guess starts. If that is a known species, it is also from the numbers that the goal's
/// tree has by it, of those that are free.
fn start_of_known(
    problem: &FitProblem,
    search: &FitSettings,
    library: &GuessLibrary,
) -> Result<Start, FitError> {
    let own = problem.start.params.values();
    let is_species = search.start.lists() == [own] && validates(search);
    let predicted = is_species.then(|| library.predicted(problem)).flatten();
    let Some(predicted) = predicted else { return Ok(search.start.clone()) };
    let mut list = own.to_vec();
    for slot in search_space(problem, search)?.genes().iter().filter_map(Gene::slot) {
        list[slot.index()] = predicted[slot.index()];
    }
    let lists = if list == own { vec![own.to_vec()] } else { vec![own.to_vec(), list] };
    Ok(Start::Lists(lists))
}

/// A first guess whose race is still to be run; `None` for settings without one.
pub(super) fn open(
    problem: &FitProblem,
    settings: &GoalSettings,
    library: &mut GuessLibrary,
    control: &mut Control<'_>,
) -> Result<Option<OpenGuess>, FitError> {
    let Guessing::Compare(how) = &settings.guess else { return Ok(None) };
    let (stop, observers) = (control.stop, &mut control.observers);
    let tell = |told: Guessed| {
        for observer in observers.iter_mut() {
            match &told {
                Guessed::Grown(done, all) => observer.guessing(*done, *all),
                Guessed::Nearest(species, foliage) => observer.nearest(species, *foliage),
            }
        }
    };
    library.open_guess(problem, &settings.search, &settings.candidates, how, stop, tell).map(Some)
}

/// Makes the first guess, registers the frames and lets the observers accept what the search begins with.
pub(super) fn begin(
    problem: &FitProblem,
    settings: &GoalSettings,
    library: &mut GuessLibrary,
    control: &mut Control<'_>,
) -> Result<PreparedSearch, FitError> {
    let mut guess = None;
    if let Some(mut open) = open(problem, settings, library, control)? {
        let (stop, observers) = (control.stop, &mut control.observers);
        open.race.run(stop, |done, all| {
            observers.iter_mut().for_each(|observer| observer.guessing(done, all));
        })?;
        guess = Some(library.close_guess(open, stop)?);
    }
    begin_with(problem, settings, guess, library, control)
}

/// [`begin`] with the first guess that was made for `settings`.
pub(super) fn begin_with(
    problem: &FitProblem,
    settings: &GoalSettings,
    guess: Option<FirstGuess>,
    library: &GuessLibrary,
    control: &mut Control<'_>,
) -> Result<PreparedSearch, FitError> {
    let search = &settings.search;
    let known = || match &settings.guess {
        Guessing::Known(guess) => Some((**guess).clone()),
        Guessing::Off | Guessing::Compare(_) => None,
    };
    let mut prepared = match guess.or_else(known) {
        None => {
            let start = start_of_known(problem, search, library)?;
            let settings = FitSettings { start, ..search.clone() };
            PreparedSearch { problem: problem.clone(), settings, guess: None }
        }
        Some(guess) => PreparedSearch {
            problem: guess.problem(problem),
            settings: FitSettings { start: guess.start(), ..search.clone() },
            guess: Some(guess),
        },
    };
    // Register by the tree that the search starts from; a search from random lists has none yet.
    if let Some(list) = prepared.settings.start.lists().first()
        && prepared.settings.rules.is_none()
    {
        let space = search_space(&prepared.problem, &prepared.settings)?;
        let genome = space.individual(list, prepared.settings.seed);
        let evaluator = evaluator_in(&space, &prepared.problem, &prepared.settings)?;
        prepared.problem = with_registered_frames(&prepared.problem, &evaluator, &genome, Closeness::Search);
    }
    // Where no stem can get other draws, the search has the time that was meant for individuals.
    let start = &prepared.problem.start;
    if let (Some(timeout), Some(individual)) = (&mut prepared.settings.budget.timeout, settings.individual)
        && start.generator.spreads(start.params.values()).is_empty()
    {
        *timeout += individual.time.unwrap_or_default();
    }
    for observer in &mut control.observers {
        observer.prepared(&prepared).map_err(FitError::Observer)?;
    }
    Ok(prepared)
}
