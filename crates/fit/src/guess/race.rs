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
use crate::problem::{FitProblem, Scored, with_values};
use crate::registration::{Closeness, with_registered_frames};
use crate::run::{FitSettings, evaluator_in, fit, search_space};
use crate::space::SpaceError;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// The lists of one generator that a search may start from.
#[derive(Debug)]
pub(super) struct Contender {
    /// The generator's number among the models.
    model: usize,
    /// The candidate of the first list.
    pub(super) candidate: usize,
    /// Its family.
    pub(super) family: &'static str,
    /// Lists with their scores, best first; at least one.
    pub(super) lists: Vec<Guess>,
    /// The best list of the race, if it is better than all of them.
    pub(super) found: Option<Guess>,
    /// Likeness of the tree of its family that is most like the goal.
    likeness: f64,
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

    /// `best` as a guess, if it is better than all lists.
    fn better(&self, best: Option<Scored>) -> Option<Guess> {
        let Guess { name, score, .. } = &self.lists[0];
        let best = best.filter(|best| best.score.cost < score.cost)?;
        Some(Guess { name: name.clone(), values: best.genome.values, score: best.score })
    }

    /// Its result.
    pub(super) fn runner(&self) -> Runner {
        Runner {
            family: self.family,
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
    let likeness = |family: &str| {
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
                let family = context.family(candidate);
                let (likeness, lists) = (likeness(family), vec![guess]);
                all.push(Contender { model, candidate, family, lists, found: None, likeness });
            }
        }
    }
    all
}

/// A contender that is worse than the best by more than this after the first round is out of the second.
///
/// The remaining four fifths lower a cost by some hundredths, that of the best one too.
const HOPELESS: f64 = 0.1;
/// The share of the evaluations that the first round has, as a divisor; the second round has all of them.
const ROUNDS: [u64; 2] = [5, 1];

/// A race between generators, search by search.
///
/// The best generator of every family takes part, and others up to [`RaceSettings::runners`]. Only those that may still
/// win after a short first round run the second.
#[derive(Debug)]
pub(crate) struct Race {
    how: RaceSettings,
    /// Those of the search that the race is for.
    settings: FitSettings,
    /// Those that run, with their problems; those ahead first after a round.
    entrants: Vec<(Contender, FitProblem)>,
    /// Of [`ROUNDS`].
    round: usize,
    /// The number of the entrant that is searched next …
    next: usize,
    /// … and how many are searched in this round: none once the race is over.
    running: usize,
}

/// A search of a race: a short one, of one generator.
#[derive(Clone, Debug)]
pub struct Leg<'a> {
    /// What is fitted: the goals, with the generator's nearest species as the start.
    pub problem: &'a FitProblem,
    /// The settings of the search.
    pub settings: FitSettings,
    /// The generator's family.
    pub family: &'static str,
    /// The known species that its trees are nearest to.
    pub species: &'a str,
    /// Its number in this round, from 1.
    pub number: usize,
    /// Searches of this round.
    pub count: usize,
}

impl Race {
    /// A race of `all` for the goals of `problem`. There is none to run without `how`, and of one generator.
    pub(super) fn new(
        problem: &FitProblem,
        context: &GoalContext<'_>,
        how: Option<RaceSettings>,
        all: Vec<Contender>,
    ) -> Result<Self, FitError> {
        let how = how.filter(|_| all.len() > 1);
        let registers = how.is_some_and(|how| how.criterion == RaceCriterion::Cost);
        let runs = how.is_some();
        let how = how.unwrap_or_default();
        let entered = if runs { entered(how.runners, all) } else { all };
        let mut entrants = Vec::with_capacity(entered.len());
        for one in entered {
            interrupt::check(context.stop)?;
            let mut own = of_contender(problem, context, &one)?;
            if registers {
                own = registered(own, context.settings, &one.lists[0].values)?;
            }
            entrants.push((one, own));
        }
        let running = if runs { entrants.len() } else { 0 };
        Ok(Self { how, settings: context.settings.clone(), entrants, round: 0, next: 0, running })
    }

    /// The next search; `None` once the race is over.
    pub(crate) fn leg(&self) -> Option<Leg<'_>> {
        let (one, problem) = self.entrants[..self.running].get(self.next)?;
        let evaluations = self.how.evaluations / ROUNDS[self.round];
        let evaluations = self.settings.budget.evaluations.map_or(evaluations, |n| n.min(evaluations)).max(1);
        let settings = FitSettings {
            start: Start::Lists(one.lists.iter().map(|guess| guess.values.clone()).collect()),
            budget: Budget::evaluations(evaluations),
            ..self.settings.clone()
        };
        let (number, count) = (self.next + 1, self.running);
        Some(Leg { problem, settings, family: one.family, species: &one.lists[0].name, number, count })
    }

    /// Takes the best individual that the search of [`Self::leg`] has found, if it has any.
    pub(crate) fn take(&mut self, best: Option<Scored>) {
        let Some((one, _)) = self.entrants[..self.running].get_mut(self.next) else { return };
        one.found = one.better(best);
        self.next += 1;
        if self.next == self.running {
            self.end_round();
        }
    }

    /// Takes the best individual that was found before the search of [`Self::leg`] was ended early, and ends the race.
    /// What the first round has found stays, if it is better.
    pub(crate) fn stop(&mut self, best: Option<Scored>) {
        if let Some((one, _)) = self.entrants[..self.running].get_mut(self.next) {
            let found = one.better(best);
            let cost = |found: &Option<Guess>| found.as_ref().map_or(f64::INFINITY, |one| one.score.cost);
            if cost(&found) < cost(&one.found) {
                one.found = found;
            }
        }
    }

    /// Sorts the entrants, and drops those that cannot win any more from what is left of the race.
    fn end_round(&mut self) {
        self.sort();
        let criterion = self.how.criterion;
        let most = self.entrants[0].0.standing(criterion) + HOPELESS;
        let may_win = |(one, _): &&(Contender, FitProblem)| one.standing(criterion) <= most;
        self.running = self.entrants.iter().take_while(may_win).count();
        (self.round, self.next) = (self.round + 1, 0);
        if self.running < 2 || self.round == ROUNDS.len() {
            self.running = 0;
        }
    }

    fn sort(&mut self) {
        let criterion = self.how.criterion;
        self.entrants.sort_by(|(a, _), (b, _)| a.standing(criterion).total_cmp(&b.standing(criterion)));
    }

    /// Runs all that is left of it. `progress` is called with the numbers of searches that are done and of all of a round.
    pub(crate) fn run(
        &mut self,
        stop: &AtomicBool,
        mut progress: impl FnMut(usize, usize),
    ) -> Result<(), FitError> {
        while let Some(leg) = self.leg() {
            interrupt::check(stop)?;
            let (number, count) = (leg.number, leg.count);
            let best = leg.search(stop)?;
            self.take(best);
            progress(number, count);
        }
        Ok(())
    }

    /// The contenders, those ahead first, whether or not the race is over.
    pub(super) fn into_contenders(mut self) -> Vec<Contender> {
        // One that was stopped in a round.
        if self.running > 0 {
            self.sort();
        }
        self.entrants.into_iter().map(|(one, _)| one).collect()
    }
}

impl Leg<'_> {
    /// The best of the search; `None` where there is nothing to search.
    fn search(&self, stop: &AtomicBool) -> Result<Option<Scored>, FitError> {
        // The result does not depend on the time.
        let clock = || Duration::ZERO;
        let outcome = match fit(self.problem, &self.settings, Control::new(&clock, stop)) {
            Ok(outcome) => outcome,
            // A generator without free numbers keeps its cost.
            Err(FitError::Space(_)) => return Ok(None),
            Err(error) => return Err(error),
        };
        if outcome.stop == StopReason::Interrupted {
            return Err(FitError::Interrupted);
        }
        Ok(outcome.best)
    }
}

/// Those that run: the best of every family, and the best of the others while there is room.
fn entered(room: usize, mut all: Vec<Contender>) -> Vec<Contender> {
    let mut families: Vec<&str> = all.iter().map(|one| one.family).collect();
    families.sort_unstable();
    families.dedup();
    let mut others = room.saturating_sub(families.len());
    all.retain(|one| {
        let place = families.iter().position(|&waiting| waiting == one.family);
        let is_first = place.map(|place| families.remove(place)).is_some();
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

/// The same with frames as the tree of `list` lies in them best: a crown that stands a little beside its goal costs as
/// much as another crown.
fn registered(problem: FitProblem, settings: &FitSettings, list: &[f64]) -> Result<FitProblem, FitError> {
    let Ok(space) = search_space(&problem, settings) else { return Ok(problem) };
    let genome = space.individual(list, settings.seed);
    let evaluator = evaluator_in(&space, &problem, settings)?;
    Ok(with_registered_frames(&problem, &evaluator, &genome, Closeness::Search))
}
