//! A race: generators that a goal may be of are each searched for a short while.
//!
//! The first trees of a generator say little about it: a species of the wrong family may be near the goal by chance,
//! and one of the right family may lack leaves on a third of its height. After some hundred trees each, the right one
//! is ahead.

use super::found::{Guess, Runner};
use super::goal_context::GoalContext;
use super::settings::{RaceCriterion, RaceSettings};
use crate::control::interrupt;
use crate::control::{Budget, Control, StopReason};
use crate::error::FitError;
use crate::method::Start;
use crate::problem::{FitProblem, with_values};
use crate::registration::{Closeness, with_registered_frames};
use crate::run::{FitSettings, evaluator_in, fit, search_space};
use crate::space::SpaceError;
use std::time::Duration;

/// The lists of one generator that a search may start from.
#[derive(Clone, Debug)]
pub(super) struct Contender {
    /// The generator's number among the models.
    model: usize,
    /// The candidate of the first list.
    pub(super) candidate: usize,
    /// Lists with their scores, best first; at least one.
    pub(super) lists: Vec<Guess>,
    /// The best list of the race, if it is better than all of them.
    pub(super) found: Option<Guess>,
    /// Likeness of the tree of its family that is most like the goal.
    likeness: f64,
    /// The goals as its first list lies on them, where that matters.
    registered: Option<FitProblem>,
}

/// Weight of the likeness before any search, against the cost that a search reaches.
///
/// A search makes any generator cover a goal. That other trees of a species look like the goal says more about its
/// origin.
const BY_LIKENESS: f64 = 3.0;

impl Contender {
    /// The least cost so far.
    fn cost(&self) -> f64 {
        self.found.as_ref().unwrap_or(&self.lists[0]).score.cost
    }

    /// The criterion between generators; the least wins.
    fn standing(&self, criterion: RaceCriterion) -> f64 {
        match criterion {
            RaceCriterion::Origin => self.cost() + BY_LIKENESS * (1.0 - self.likeness),
            RaceCriterion::Cost => self.cost(),
        }
    }

    /// Its result.
    pub(super) fn runner(&self, context: &GoalContext<'_>) -> Runner {
        Runner {
            family: context.family(self.candidate),
            species: self.lists[0].name.clone(),
            likeness: self.likeness,
            guessed: self.lists[0].score.cost,
            reached: self.cost(),
        }
    }
}

/// The generators of `nearest`, which is sorted by cost; each with its `keep` best lists. `unlike` is 1 minus the
/// likeness of each candidate.
pub(super) fn contenders(
    context: &GoalContext<'_>,
    nearest: Vec<(usize, Guess)>,
    unlike: &[f64],
    keep: usize,
) -> Vec<Contender> {
    let likeness = |candidate: usize| {
        let family = context.family(candidate);
        let of_family = unlike.iter().enumerate().filter(|(other, _)| context.family(*other) == family);
        1.0 - of_family.map(|(_, unlike)| *unlike).fold(1.0, f64::min)
    };
    let mut all: Vec<Contender> = Vec::new();
    for (candidate, guess) in nearest {
        let model = context.models.number(candidate);
        match all.iter_mut().find(|one| one.model == model) {
            Some(one) if one.lists.len() < keep => one.lists.push(guess),
            Some(_) => {}
            None => {
                let (likeness, lists) = (likeness(candidate), vec![guess]);
                all.push(Contender { model, candidate, lists, found: None, likeness, registered: None });
            }
        }
    }
    all
}

/// A contender that is worse than the best by more than this after the first round is out of the second.
///
/// The remaining four fifths lower a cost by some hundredths, that of the best one too.
const HOPELESS: f64 = 0.1;
/// Evaluations of both rounds together, per evaluation of the first.
const ROUNDS: u64 = 5;

/// Searches each of `all` for a while, the best of every family and others up to [`RaceSettings::runners`], and sorts
/// them by the result. Those that do not run are dropped.
///
/// Only those that may still win after a short first round run the second.
pub(super) fn race(
    problem: &FitProblem,
    context: &GoalContext<'_>,
    race: RaceSettings,
    all: Vec<Contender>,
    mut progress: impl FnMut(usize, usize),
) -> Result<Vec<Contender>, FitError> {
    let mut all = entered(context, race.runners, all);
    if race.criterion == RaceCriterion::Cost {
        for one in &mut all {
            interrupt::check(context.stop)?;
            one.registered = Some(registered(problem, context, one)?);
        }
    }
    let mut running = all.len();
    for evaluations in [race.evaluations / ROUNDS, race.evaluations] {
        for (number, one) in all[..running].iter_mut().enumerate() {
            interrupt::check(context.stop)?;
            one.found = search(problem, context, evaluations, one)?;
            progress(number + 1, running);
        }
        let standing = |one: &Contender| one.standing(race.criterion);
        all.sort_by(|a, b| standing(a).total_cmp(&standing(b)));
        let most = standing(&all[0]) + HOPELESS;
        running = all.iter().take_while(|one| standing(one) <= most).count();
        if running < 2 {
            break;
        }
    }
    Ok(all)
}

/// Those that run: the best of every family, and the best of the others while there is room.
fn entered(context: &GoalContext<'_>, room: usize, mut all: Vec<Contender>) -> Vec<Contender> {
    let mut families: Vec<&str> = all.iter().map(|one| context.family(one.candidate)).collect();
    families.sort_unstable();
    families.dedup();
    let mut others = room.saturating_sub(families.len());
    all.retain(|one| {
        let family = context.family(one.candidate);
        let is_first =
            families.iter().position(|&waiting| waiting == family).map(|i| families.remove(i)).is_some();
        let runs = is_first || others > 0;
        others -= usize::from(runs && !is_first);
        runs
    });
    all
}

/// `problem` from the first list of `one`.
fn of_contender(
    problem: &FitProblem,
    context: &GoalContext<'_>,
    one: &Contender,
) -> Result<FitProblem, FitError> {
    let start = with_values(&context.candidates[one.candidate].species, one.lists[0].values.clone());
    Ok(FitProblem { start: start.map_err(SpaceError::Start)?, ..problem.clone() })
}

/// The same with frames as its tree lies in them best: a crown that stands a little beside its goal costs as much as
/// another crown.
fn registered(
    problem: &FitProblem,
    context: &GoalContext<'_>,
    one: &Contender,
) -> Result<FitProblem, FitError> {
    let problem = of_contender(problem, context, one)?;
    let Ok(space) = search_space(&problem, context.settings) else { return Ok(problem) };
    let genome = space.individual(&one.lists[0].values, context.settings.seed);
    let evaluator = evaluator_in(&space, &problem, context.settings)?;
    Ok(with_registered_frames(&problem, &evaluator, &genome, Closeness::Search))
}

/// The result of a short search from the lists of `one`, if it is better than all of them.
fn search(
    problem: &FitProblem,
    context: &GoalContext<'_>,
    evaluations: u64,
    one: &Contender,
) -> Result<Option<Guess>, FitError> {
    let best = &one.lists[0];
    let problem = match &one.registered {
        Some(registered) => registered.clone(),
        None => of_contender(problem, context, one)?,
    };
    let evaluations = context.settings.budget.evaluations.map_or(evaluations, |n| n.min(evaluations)).max(1);
    let settings = FitSettings {
        start: Start::Lists(one.lists.iter().map(|guess| guess.values.clone()).collect()),
        budget: Budget::evaluations(evaluations),
        ..context.settings.clone()
    };
    // The result does not depend on the time.
    let clock = || Duration::ZERO;
    let outcome = match fit(&problem, &settings, Control::new(&clock, context.stop)) {
        Ok(outcome) => outcome,
        // A generator without free numbers keeps its cost.
        Err(FitError::Space(_)) => return Ok(None),
        Err(error) => return Err(error),
    };
    if outcome.stop == StopReason::Interrupted {
        return Err(FitError::Interrupted);
    }
    let found = outcome.best.filter(|found| found.score.cost < best.score.cost);
    Ok(found.map(|found| Guess { name: best.name.clone(), values: found.genome.values, score: found.score }))
}
