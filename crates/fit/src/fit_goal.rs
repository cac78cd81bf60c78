//! A whole fit: a first guess, the search, and what the result is worth.

use crate::begun::Begun;
use crate::budget::StopReason;
use crate::cancellable::Until;
use crate::control::{Control, Outcome};
use crate::ending::{Ending, Rest};
use crate::error::FitError;
use crate::evaluator::Evaluator;
use crate::finalists::best_kind;
use crate::genome::Scored;
use crate::guess::{Candidate, FirstGuess, GuessLibrary, GuessSettings, References};
use crate::individual::{FoundIndividual, IndividualSettings, individuals};
use crate::judged::{Judge, Judged, Judging};
use crate::problem::FitProblem;
use crate::register::{Closeness, with_registered_frames};
use crate::run::{evaluator_in, fit, search_space};
use crate::settings::FitSettings;
use crate::space::SpaceError;
use crate::verdict::Verdict;
use pleach_silhouette::score::ScoreCard;
use pleach_tree::param::SlotError;
use pleach_tree::{Limits, Species};
use std::sync::atomic::Ordering;

/// How a goal is fitted, from the first guess to the judging of the result.
#[derive(Clone, Debug)]
pub struct GoalSettings {
    /// The search. A first guess replaces its `start`.
    pub search: FitSettings,
    /// Whether there is a first guess.
    pub guess: Guessing,
    /// The known species: a first guess is one of them, and a result's likeness stands beside theirs.
    pub candidates: Vec<Candidate>,
    /// Whether the result is the one of the last bests of the search of which other seeds are best as well, and not
    /// the last best whatever its other seeds are. Not where the objective does not look at likeness, and not after
    /// the dissertation's algorithm and random lists, which are as they were published.
    pub validates: bool,
    /// How the result is judged; none leaves it as the search has found it.
    pub judging: Option<Judging>,
    /// How the goal's own tree is searched among the trees of the kind, once that is found; none if it is not.
    pub individual: Option<IndividualSettings>,
    /// When all of it is to be over; none is whenever it is. What follows the search then has the time that is left:
    /// the last that is asked for, individuals where they take the rest and judging where there are none, has all
    /// of it.
    pub ending: Option<Ending>,
}

/// Where the species comes from that a fit starts from.
#[derive(Clone, Debug, Default)]
pub enum Guessing {
    /// It is the problem's; the search starts as its settings say.
    #[default]
    Off,
    /// The candidates are compared with the goal.
    Compare(GuessSettings),
    /// They have been, with the same settings of the search.
    Known(Box<FirstGuess>),
}

impl GoalSettings {
    /// A search as by default, from the candidates that look most like the goal, and judged; without an
    /// individual.
    #[must_use]
    pub fn new(candidates: Vec<Candidate>) -> Self {
        Self {
            search: FitSettings::default(),
            guess: Guessing::Compare(GuessSettings::default()),
            candidates,
            validates: true,
            judging: Some(Judging::default()),
            individual: None,
            ending: None,
        }
    }
}

/// What came of a whole fit.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// What was fitted, with the species that the search started from; where its structure was searched
    /// too, with the one that was found.
    pub problem: FitProblem,
    /// How it was searched, with the lists that the search started from.
    pub settings: FitSettings,
    /// The first guess, if there was one.
    pub guess: Option<FirstGuess>,
    /// The search. It stopped for [`StopReason::Interrupted`] too where the judging was interrupted.
    pub outcome: Outcome,
    /// The best individual; where it was judged, with numbers that the goal does not show back at the
    /// start's values.
    pub best: Scored,
    /// What it is worth; none if the fit was interrupted or nobody asked.
    pub judged: Option<Judged>,
    /// This very tree, or several that all lie on the goal, with the best first; none if nobody asked, the fit was
    /// interrupted, or stems of the generator have no addresses.
    pub individuals: Vec<FoundIndividual>,
}

impl Fitted {
    /// The species that was found, called and coloured as the one that the search started from.
    ///
    /// # Errors
    /// None: a fit finds allowed values.
    pub fn species(&self) -> Result<Species, SlotError> {
        self.problem.species(&self.best.genome)
    }

    /// What the likeness of the result stands beside, if it is known.
    #[must_use]
    pub fn references(&self) -> Option<&References> {
        let judged = self.judged.as_ref().map(|judged| &judged.references);
        judged.or_else(|| self.guess.as_ref().map(|guess| &guess.references))
    }

    /// The verdict on the result, whose silhouette scores `card` against the goal; none where there is no
    /// other tree to compare with.
    #[must_use]
    pub fn verdict(&self, card: &ScoreCard) -> Option<Verdict> {
        let held_out = self.judged.as_ref().and_then(|judged| judged.held_out.as_ref());
        let fresh = held_out.map(|fresh| fresh.likeness.mean);
        Verdict::new(card.likeness, fresh, self.references()?, &card.crown, &card.goal_crown)
    }
}

/// Fits a goal: guesses the species that it looks like, searches from there, and judges what was found.
///
/// Observers are told of every step, and raising the flag of `control` ends the fit soon: what the search
/// has found until then is returned, unjudged. The same problem and settings give the same result, as
/// [`fit`] does. A resumed fit makes its first guess again and then goes on with the search.
///
/// ```
/// use pleach_fit::{Budget, Candidate, Control, FitProblem, FitSettings, GoalSettings, GoalView, fit_goal};
/// use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
/// use pleach_tree::Parts;
///
/// let known = ["palm", "lombardy_poplar"].map(|name| pleach_generators::preset(name).unwrap());
/// // A goal: the picture of a tree. Those of photographs come from `pleach_silhouette::goal::Goal`.
/// let tree = known[1].grow(7)?;
/// let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 64, 64);
/// let mut picture = Bitmap::default();
/// Rasterizer::new().draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut picture);
///
/// let problem = FitProblem::new(known[0].clone(), GoalView::new(picture, View::FRONT, frame));
/// let search = FitSettings { budget: Budget::evaluations(100), ..FitSettings::default() };
/// let settings = GoalSettings { search, ..GoalSettings::new(known.map(Candidate::from).into()) };
/// let started = std::time::Instant::now();
/// let (clock, stop) = (|| started.elapsed(), std::sync::atomic::AtomicBool::new(false));
/// let fitted = fit_goal(&problem, &settings, Control::new(&clock, &stop))?;
///
/// assert_eq!(fitted.guess.as_ref().unwrap().names[0].0, "lombardy_poplar");
/// println!("{}", fitted.species()?.to_toml(&[]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// See [`FitError`]: among others [`FitError::Interrupted`] before anything was found.
pub fn fit_goal(
    problem: &FitProblem,
    settings: &GoalSettings,
    control: Control<'_>,
) -> Result<Fitted, FitError> {
    fit_goal_with(problem, settings, &mut GuessLibrary::new().for_one_goal(), control)
}

/// [`fit_goal`] with trees of the candidates that are kept from goal to goal.
///
/// # Errors
/// As [`fit_goal`].
pub fn fit_goal_with(
    problem: &FitProblem,
    settings: &GoalSettings,
    library: &mut GuessLibrary,
    mut control: Control<'_>,
) -> Result<Fitted, FitError> {
    let begun = begin(problem, settings, library, &mut control)?;
    let outcome = fit(&begun.problem, &begun.settings, control.reborrow())?;
    conclude(begun, outcome, settings, library, control)
}

/// Whether the last bests of such a search may be asked for other seeds.
fn validates(search: &FitSettings) -> bool {
    search.objective.looks() && search.rules.is_none() && search.optimizer.keeps_to_plausible()
}

/// Judges what a search has found, unless the flag of `control` is raised, and looks for this very tree.
pub(crate) fn conclude(
    mut begun: Begun,
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
        begun.problem.start = begun.problem.species(&best.genome).map_err(SpaceError::Start)?;
        best.genome.structure = None;
    }
    let evaluate = || {
        let evaluator = Evaluator::new(&begun.problem, begun.settings.objective, Limits::DEFAULT)?;
        evaluator.evaluate_with_likeness(&best.genome);
        Ok(())
    };
    let rest = Rest::new(settings, outcome.elapsed, control.clock, evaluate)?;
    if settings.validates && validates(&begun.settings) {
        let mut finalists = outcome.finalists.clone();
        finalists.push(best.clone());
        let share = settings.judging.and_then(|judging| rest.for_judging(judging.time));
        let late = share.map(|share| control.clock.elapsed() + share / 2);
        let until = Until::from(control.stop).or_late(control.clock, late);
        match best_kind(&begun.problem, begun.settings.objective, &finalists, until) {
            Ok(kind) => best = finalists.swap_remove(kind),
            Err(FitError::Interrupted) => outcome.stop = StopReason::Interrupted,
            Err(error) => return Err(error),
        }
    }
    let evaluator = Evaluator::new(&begun.problem, begun.settings.objective, Limits::DEFAULT)?;
    begun.problem = with_registered_frames(&begun.problem, &evaluator, &best.genome, Closeness::Result);
    drop(evaluator);
    let mut judged = None;
    if settings.judging.is_some() && control.stop.load(Ordering::Relaxed) {
        outcome.stop = StopReason::Interrupted;
    } else if let Some(judging) = settings.judging {
        control.observers.iter_mut().for_each(|observer| observer.judging());
        let (clock, stop) = (control.clock, control.stop);
        let judging = Judging { time: rest.for_judging(judging.time), ..judging };
        let (finalists, candidates) = (&outcome.finalists, &settings.candidates);
        let judge = Judge { begun: &begun, finalists, judging, candidates, clock, stop };
        match judge.judge(&best, library) {
            Ok((kept, of_kept)) => (best, judged) = (kept, Some(of_kept)),
            // The search may have come to its end, the fit has not.
            Err(FitError::Interrupted) => outcome.stop = StopReason::Interrupted,
            Err(error) => return Err(error),
        }
    }
    let mut found = Vec::new();
    let time = rest.for_individuals();
    let individual = settings.individual.map(|how| IndividualSettings { time, ..how });
    if individual.is_some() && control.stop.load(Ordering::Relaxed) {
        outcome.stop = StopReason::Interrupted;
    } else if let Some(how) = individual {
        let Control { clock, stop, observers, .. } = &mut control;
        let tell = |progress: &_| observers.iter_mut().for_each(|observer| observer.individual(progress));
        match individuals(&begun.problem, &best.genome, how, *clock, stop, tell) {
            Ok(individuals) => found = individuals,
            Err(FitError::Interrupted) => outcome.stop = StopReason::Interrupted,
            Err(error) => return Err(error),
        }
    }
    let Begun { problem, settings, guess } = begun;
    Ok(Fitted { problem, settings, guess, outcome, best, judged, individuals: found })
}

/// Finds out where the search begins, and tells the observers.
pub(crate) fn begin(
    problem: &FitProblem,
    settings: &GoalSettings,
    library: &mut GuessLibrary,
    control: &mut Control<'_>,
) -> Result<Begun, FitError> {
    let search = &settings.search;
    let guess = match &settings.guess {
        Guessing::Off => None,
        Guessing::Known(guess) => Some((**guess).clone()),
        Guessing::Compare(how) => {
            let (stop, observers) = (control.stop, &mut control.observers);
            let tell = |done, all| observers.iter_mut().for_each(|observer| observer.guessing(done, all));
            Some(library.first_guess(problem, search, &settings.candidates, how, stop, tell)?)
        }
    };
    let mut begun = match guess {
        None => Begun { problem: problem.clone(), settings: search.clone(), guess: None },
        Some(guess) => Begun {
            problem: guess.problem(problem),
            settings: FitSettings { start: guess.start(), ..search.clone() },
            guess: Some(guess),
        },
    };
    // The frame by the tree that the search starts from; from random lists there is none yet.
    if let Some(list) = begun.settings.start.lists().first()
        && begun.settings.rules.is_none()
    {
        let space = search_space(&begun.problem, &begun.settings)?;
        let genome = space.individual(list, begun.settings.seed);
        let evaluator = evaluator_in(&space, &begun.problem, &begun.settings)?;
        begun.problem = with_registered_frames(&begun.problem, &evaluator, &genome, Closeness::Search);
    }
    // Where no stem can be dealt other draws, the search has the time that was meant for it.
    let start = &begun.problem.start;
    if let (Some(timeout), Some(individual)) = (&mut begun.settings.budget.timeout, settings.individual)
        && start.generator.spreads(start.params.values()).is_empty()
    {
        *timeout += individual.time.unwrap_or_default();
    }
    for observer in &mut control.observers {
        observer.begun(&begun).map_err(FitError::Observer)?;
    }
    Ok(begun)
}
