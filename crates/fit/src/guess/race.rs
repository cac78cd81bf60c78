//! A race: generators that a goal may be of are each searched for a short while.
//!
//! The first trees of a generator say little about it: a species of the wrong family may stand beside
//! the goal by chance, and one of the right family may lack a third of its height of leaves. After some
//! hundred trees each the right one is ahead.

use super::Guess;
use super::settings::RaceSettings;
use super::shown::Shown;
use crate::cancellable;
use crate::control::Control;
use crate::error::FitError;
use crate::method::Start;
use crate::problem::{FitProblem, with_values};
use crate::run::fit;
use crate::settings::FitSettings;
use crate::space::SpaceError;
use crate::{Budget, StopReason};
use serde::Serialize;
use std::time::Duration;

/// How a generator did in the race for a goal.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Runner {
    /// Its family.
    pub family: &'static str,
    /// Its species that was nearest to the goal at first.
    pub species: String,
    /// Likeness of the tree of its family that is most like the goal, before any search.
    pub likeness: f64,
    /// Least cost of its trees before the race: see [`crate::Objective`].
    pub guessed: f64,
    /// Least cost after it; the same where there was no race.
    pub reached: f64,
}

/// The lists of one generator that a search may start from.
#[derive(Clone, Debug)]
pub(super) struct Contender {
    /// The generator's number among the models.
    model: usize,
    /// The candidate of the first list.
    pub(super) candidate: usize,
    /// Lists with what they cost, best first; at least one.
    pub(super) lists: Vec<Guess>,
    /// What the race has found, if it is better than all of them.
    pub(super) found: Option<Guess>,
    /// Likeness of the tree of its family that is most like the goal.
    likeness: f64,
}

/// What a tree that is like the goal before any search is worth beside what a search reaches.
///
/// A search makes any generator cover a goal; which one has a species whose other trees look like it says
/// more about where the goal comes from.
const BY_LIKENESS: f64 = 3.0;

impl Contender {
    /// The least cost so far.
    fn cost(&self) -> f64 {
        self.found.as_ref().unwrap_or(&self.lists[0]).score.cost
    }

    /// What decides between generators; the least wins.
    fn standing(&self) -> f64 {
        self.cost() + BY_LIKENESS * (1.0 - self.likeness)
    }

    /// How it did.
    pub(super) fn runner(&self, shown: &Shown<'_>) -> Runner {
        Runner {
            family: shown.family(self.candidate),
            species: self.lists[0].name.clone(),
            likeness: self.likeness,
            guessed: self.lists[0].score.cost,
            reached: self.cost(),
        }
    }
}

/// The generators of `nearest`, which is sorted by cost; each with its `keep` best lists. `unlike` is what
/// each candidate lacks of a likeness of 1.
pub(super) fn contenders(
    shown: &Shown<'_>,
    nearest: Vec<(usize, Guess)>,
    unlike: &[f64],
    keep: usize,
) -> Vec<Contender> {
    let likeness = |candidate: usize| {
        let family = shown.family(candidate);
        let of_family = unlike.iter().enumerate().filter(|(other, _)| shown.family(*other) == family);
        1.0 - of_family.map(|(_, unlike)| *unlike).fold(1.0, f64::min)
    };
    let mut all: Vec<Contender> = Vec::new();
    for (candidate, guess) in nearest {
        let model = shown.models.number(candidate);
        match all.iter_mut().find(|one| one.model == model) {
            Some(one) if one.lists.len() < keep => one.lists.push(guess),
            Some(_) => {}
            None => {
                let (likeness, lists) = (likeness(candidate), vec![guess]);
                all.push(Contender { model, candidate, lists, found: None, likeness });
            }
        }
    }
    all
}

/// A contender that stands by so much worse than the best after the first round does not run the second.
///
/// The four fifths that are left take some hundredths off a cost, off the best one's as well.
const HOPELESS: f64 = 0.1;
/// Evaluations of the second round for one of the first.
const ROUNDS: u64 = 5;

/// Searches each of `all` for a while, the best of every family and others up to the number that
/// `race` says, and sorts them by how they stand then. Those that do not run are dropped.
///
/// After a first short round only those run on that may still win.
pub(super) fn race(
    problem: &FitProblem,
    shown: &Shown<'_>,
    race: RaceSettings,
    all: Vec<Contender>,
    mut progress: impl FnMut(usize, usize),
) -> Result<Vec<Contender>, FitError> {
    let mut all = entered(shown, race.runners, all);
    let mut running = all.len();
    for evaluations in [race.evaluations / ROUNDS, race.evaluations] {
        for (number, one) in all[..running].iter_mut().enumerate() {
            cancellable::check(shown.stop)?;
            one.found = search(problem, shown, evaluations, one)?;
            progress(number + 1, running);
        }
        all.sort_by(|a, b| a.standing().total_cmp(&b.standing()));
        let most = all[0].standing() + HOPELESS;
        running = all.iter().take_while(|one| one.standing() <= most).count();
        if running < 2 {
            break;
        }
    }
    Ok(all)
}

/// Those that run: the best of every family, and the best of the others while there is room.
fn entered(shown: &Shown<'_>, room: usize, mut all: Vec<Contender>) -> Vec<Contender> {
    let mut families: Vec<&str> = all.iter().map(|one| shown.family(one.candidate)).collect();
    families.sort_unstable();
    families.dedup();
    let mut others = room.saturating_sub(families.len());
    all.retain(|one| {
        let family = shown.family(one.candidate);
        let is_first =
            families.iter().position(|&waiting| waiting == family).map(|i| families.remove(i)).is_some();
        let runs = is_first || others > 0;
        others -= usize::from(runs && !is_first);
        runs
    });
    all
}

/// What a short search from the lists of `one` finds, if it is better than all of them.
fn search(
    problem: &FitProblem,
    shown: &Shown<'_>,
    evaluations: u64,
    one: &Contender,
) -> Result<Option<Guess>, FitError> {
    let best = &one.lists[0];
    let start = with_values(&shown.candidates[one.candidate].species, best.values.clone());
    let problem = FitProblem { start: start.map_err(SpaceError::Start)?, ..problem.clone() };
    let evaluations = shown.settings.budget.evaluations.map_or(evaluations, |n| n.min(evaluations)).max(1);
    let settings = FitSettings {
        start: Start::Lists(one.lists.iter().map(|guess| guess.values.clone()).collect()),
        budget: Budget::evaluations(evaluations),
        ..shown.settings.clone()
    };
    // Nothing depends on the time.
    let clock = || Duration::ZERO;
    let outcome = match fit(&problem, &settings, Control::new(&clock, shown.stop)) {
        Ok(outcome) => outcome,
        // A generator without free numbers stands as it is.
        Err(FitError::Space(_)) => return Ok(None),
        Err(error) => return Err(error),
    };
    if outcome.stop == StopReason::Interrupted {
        return Err(FitError::Interrupted);
    }
    let found = outcome.best.filter(|found| found.score.cost < best.score.cost);
    Ok(found.map(|found| Guess { name: best.name.clone(), values: found.genome.values, score: found.score }))
}
