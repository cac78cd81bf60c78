//! A whole fit: argmin's executor over a search, with budget, observers and checkpoints.

use crate::budget::{Budget, Clock, Spent, StopReason};
use crate::checkpoint::{Checkpoint, CheckpointError};
use crate::evaluator::{Evaluator, FitProblem, ProblemError};
use crate::fingerprint::Fingerprint;
use crate::genome::{Genome, Scored};
use crate::history::{Observer, Progress, Row};
use crate::method::Start;
use crate::search::{Evaluate, FitState, Search, SearchState};
use crate::settings::{AnyMethod, FitSettings};
use crate::space::{SearchSpace, SpaceError};
use argmin::core::{Error, Executor, KV, Problem, Solver, TerminationReason, TerminationStatus};
use pleach_tree::Slot;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Where and how often a fit saves itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CheckpointSettings {
    /// The file, in a folder that exists.
    pub path: PathBuf,
    /// Least time between two checkpoints by the caller's clock; zero saves after every batch. One
    /// more is written at the start and at the end.
    pub interval: Duration,
    /// Go on from the file, if it is there; otherwise it is overwritten.
    pub resume: bool,
}

impl CheckpointSettings {
    /// Checkpoints at `path`, at most one a second, from a fresh start.
    #[must_use]
    pub fn new(path: PathBuf) -> Self {
        Self { path, interval: Duration::from_secs(1), resume: false }
    }
}

/// What a fit needs of the world around it.
pub struct Control<'a> {
    /// The caller's time.
    pub clock: &'a dyn Clock,
    /// Raised by the caller, from any thread, to end the fit after the current batch.
    pub stop: &'a AtomicBool,
    /// Who is told of progress.
    pub observers: Vec<&'a mut dyn Observer>,
    /// Where the fit saves itself, if it does.
    pub checkpoint: Option<CheckpointSettings>,
}

impl<'a> Control<'a> {
    /// A fit that nobody watches and that leaves no file.
    #[must_use]
    pub fn new(clock: &'a dyn Clock, stop: &'a AtomicBool) -> Self {
        Self { clock, stop, observers: Vec::new(), checkpoint: None }
    }
}

/// What came of a fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The best individual ever seen; none if the fit ended before its first evaluation.
    pub best: Option<Scored>,
    /// Individuals evaluated, in all parts of a resumed run.
    pub evaluations: u64,
    /// Finished generations.
    pub generations: u64,
    /// Time by the caller's clock, in all parts of a resumed run.
    pub elapsed: Duration,
    /// What of it had passed when the search began: a first guess, where the clock was started before
    /// it. The rest is the search's.
    pub before_search: Duration,
    /// Why it ended.
    pub stop: StopReason,
    /// One row for every finished generation.
    pub history: Vec<Row>,
}

/// Why a fit could not begin or go on.
#[derive(Debug, thiserror::Error)]
pub enum FitError {
    /// Goals that cannot be compared with.
    #[error(transparent)]
    Problem(#[from] ProblemError),
    /// Patterns or start values that do not belong to the generator.
    #[error(transparent)]
    Space(#[from] SpaceError),
    /// The first checkpoint could not be written, or the one to resume from not be read.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// `Start::Lists` without a list.
    #[error("the list of starts is empty")]
    NoStart,
    /// The caller's stop flag was raised during a first guess or while a result was judged.
    #[error("interrupted")]
    Interrupted,
    /// The executor failed: a mistake in this crate.
    #[error("the search failed: {0}")]
    Search(String),
}

/// Finds parameters that grow `problem`'s goals.
///
/// Evaluates on rayon's current thread pool. The result depends on `problem` and `settings` only,
/// not on the number of threads, on batches, or on where a run was interrupted and resumed; a
/// timeout decides only where it ends.
///
/// # Errors
/// See [`FitError`]; once the search runs, it ends with an [`Outcome`].
pub fn fit(problem: &FitProblem, settings: &FitSettings, control: Control<'_>) -> Result<Outcome, FitError> {
    let mut evaluator =
        Evaluator::new(problem, settings.objective, settings.limits)?.over_seeds(settings.robust);
    let space = search_space(problem, settings)?;
    if settings.optimizer.matches_height() && space.sizes_are_free() {
        evaluator = evaluator.matching_height();
    }
    let parts = evaluator.goal_parts().into_iter();
    let fingerprint = parts
        .fold(Fingerprint::default(), |parts, (name, bytes)| parts.with_bytes(name, bytes))
        .with("generator", problem.generator.family())
        .with_bytes("generator's settings", problem.generator.model().to_string())
        .with("fixed values", &problem.base)
        .with("free parameters", &settings.freedom)
        .with("optimizer", &settings.optimizer)
        .with("seed", &settings.seed)
        .with("tree seed", &settings.tree_seed)
        .with("robust", &settings.robust)
        .with("objective", &settings.objective)
        .with("start", &settings.start)
        .with("limits", &(settings.limits.stems, settings.limits.leaves, settings.limits.knots));
    drive(&evaluator, space, settings, fingerprint, control)
}

/// The space that a fit searches: the free slots, in ranges that hold every start.
pub(crate) fn search_space(problem: &FitProblem, settings: &FitSettings) -> Result<SearchSpace, FitError> {
    let mut space = SearchSpace::of_problem(problem, &settings.freedom, settings.tree_seed)?;
    if settings.start == Start::Lists(Vec::new()) {
        return Err(FitError::NoStart);
    }
    for list in settings.start.lists() {
        space.widen(list)?;
    }
    let settles = settings.optimizer.matches_height() && space.sizes_are_free();
    if settings.optimizer.keeps_to_reason() {
        let start = settings.start.lists().first().unwrap_or(&problem.base);
        space = space.plausible(start);
    }
    Ok(space.settling(settles).drawn_to(settings.start.lists(), settings.optimizer.prior()))
}

/// The slots of `genome` that the fit of `problem` has set to zero because one tree cannot show them:
/// see [`SearchSpace::settle`].
///
/// # Errors
/// Those of [`fit`] on the same problem and settings.
pub fn settled(problem: &FitProblem, settings: &FitSettings, genome: &Genome) -> Result<Vec<Slot>, FitError> {
    let mut slots = search_space(problem, settings)?.hidden_jitters(&genome.values);
    slots.retain(|&slot| genome.values[slot.index()] == 0.0);
    Ok(slots)
}

/// [`fit`] on anything that can be scored.
pub(crate) fn drive(
    objective: &impl Evaluate,
    space: SearchSpace,
    settings: &FitSettings,
    fingerprint: Fingerprint,
    control: Control<'_>,
) -> Result<Outcome, FitError> {
    let mut driver = Driver::begin(objective, space, settings, fingerprint, control)?;
    driver.announce();
    if driver.verdict().is_none() {
        let generation = driver.search.state.evaluations;
        let best = driver.search.state.best.clone();
        let executor = Executor::new(objective, driver).ctrlc(false).configure(|mut state: FitState| {
            // What argmin keeps of the earlier parts of a resumed run.
            state.iter = generation;
            if let Some(best) = best {
                state.best_cost = best.score.cost;
                state.best_individual = Some(best.genome);
            }
            state
        });
        driver = executor.run().map_err(|error| FitError::Search(error.to_string()))?.solver;
    }
    driver.finish()
}

/// A search that minds its budget, tells its observers and saves itself.
struct Driver<'a, 'e> {
    /// For what scores do not tell.
    objective: &'e dyn Evaluate,
    search: Search<AnyMethod>,
    budget: Budget,
    fingerprint: Fingerprint,
    control: Control<'a>,
    history: Vec<Row>,
    elapsed_before: Duration,
    before_search: Duration,
    evaluations_before: u64,
    /// Likeness of the best, and the cost by which it is known again.
    likeness: Option<(f64, Option<f64>)>,
    saved: Duration,
    pace: Pace,
}

impl<'a, 'e> Driver<'a, 'e> {
    fn begin(
        objective: &'e dyn Evaluate,
        space: SearchSpace,
        settings: &FitSettings,
        fingerprint: Fingerprint,
        control: Control<'a>,
    ) -> Result<Self, FitError> {
        let resumed = match &control.checkpoint {
            Some(file) if file.resume && file.path.exists() => {
                let checkpoint = Checkpoint::<AnyMethod>::read(&file.path, &fingerprint)?;
                // What was scored has grown, so it is a list of this generator's.
                if let Some(best) = &checkpoint.search.best
                    && let Err(error) = space.params().check_all(&best.genome.values)
                {
                    let message = format!("its best list: {error}");
                    return Err(CheckpointError::WrongBody { path: file.path.clone(), message }.into());
                }
                Some(checkpoint)
            }
            _ => None,
        };
        let now = control.clock.elapsed();
        let (state, history, elapsed_before, before_search) = match resumed {
            None => {
                let method = settings.optimizer.method(settings.seed, settings.start.clone());
                (SearchState::new(method, &settings.start), Vec::new(), Duration::ZERO, now)
            }
            Some(Checkpoint { search, history, elapsed_s, before_search_s, .. }) => {
                let seconds = |s| Duration::try_from_secs_f64(s).unwrap_or_default();
                (search, history, seconds(elapsed_s), seconds(before_search_s))
            }
        };
        let evaluations_before = state.evaluations;
        let mut search = Search::resume(state, Arc::new(space));
        search.evaluation_limit = settings.budget.evaluations.unwrap_or(u64::MAX).max(evaluations_before);
        let pace = Pace::new(now);
        search.batch = pace.batch;
        let driver = Self {
            objective,
            search,
            budget: settings.budget,
            fingerprint,
            history,
            elapsed_before,
            before_search,
            evaluations_before,
            // Of a resumed run, that of the best in its last row.
            likeness: None,
            saved: now,
            pace,
            control,
        };
        // Before hours of work: is the folder there, can it be written?
        driver.save()?;
        Ok(driver)
    }

    fn elapsed(&self) -> Duration {
        self.elapsed_before + self.control.clock.elapsed()
    }

    fn spent(&self) -> Spent {
        let state = &self.search.state;
        let best = state.best.as_ref().map(|best| best.score);
        Spent {
            evaluations: state.evaluations,
            generations: state.generation,
            elapsed: self.elapsed(),
            best_cost: best.map_or(f64::INFINITY, |score| score.cost),
            best_iou: best.map_or(f64::NEG_INFINITY, |score| score.iou),
            interrupted: self.control.stop.load(Ordering::Relaxed),
        }
    }

    fn verdict(&self) -> Option<StopReason> {
        let verdict = self.budget.verdict(&self.spent());
        // Whatever came before may have used all the time; there is a result all the same.
        verdict.filter(|reason| *reason != StopReason::Timeout || self.search.state.evaluations > 0)
    }

    /// Replays the rows of earlier parts and tells where things stand.
    fn announce(&mut self) {
        for row in &self.history {
            for observer in &mut self.control.observers {
                observer.generation(row);
            }
        }
        self.tell_progress();
    }

    fn tell_progress(&mut self) {
        let spent = self.spent();
        let best = self.search.state.best.as_ref();
        let known =
            self.likeness.map_or_else(|| self.history.last().and_then(|row| row.likeness), |known| known.1);
        let progress = Progress {
            generation: spent.generations,
            evaluations: spent.evaluations,
            evaluations_now: spent.evaluations - self.evaluations_before,
            best,
            likeness: best.and_then(|best| best.score.likeness).or(known),
            elapsed: spent.elapsed,
            elapsed_now: spent.elapsed - self.elapsed_before,
            used: self.budget.used(&spent),
        };
        for observer in &mut self.control.observers {
            observer.progress(&progress);
        }
    }

    /// After a batch: a row if it finished a generation, progress, a checkpoint if one is due.
    fn after_batch(&mut self) {
        let elapsed = self.elapsed();
        let likeness = self.likeness_of_best();
        let best_cost = self.search.best_cost().unwrap_or(f64::INFINITY);
        let state = &self.search.state;
        if let (true, Some(best), Some(last)) =
            (state.is_between_generations(), &state.best, state.generation_best)
        {
            let row = Row {
                generation: state.generation,
                evaluations: state.evaluations,
                best_cost,
                generation_best_cost: last.cost,
                iou: best.score.iou,
                accuracy: best.score.accuracy,
                likeness,
                elapsed_s: elapsed.as_secs_f64(),
            };
            self.history.push(row);
            for observer in &mut self.control.observers {
                observer.generation(&row);
            }
        }
        self.tell_progress();
        let now = self.control.clock.elapsed();
        self.search.batch = self.pace.next(now);
        let due = self.control.checkpoint.as_ref().is_some_and(|file| now - self.saved >= file.interval);
        if due {
            self.saved = now;
            if let Err(error) = self.save() {
                for observer in &mut self.control.observers {
                    observer.checkpoint_failed(&error);
                }
            }
        }
    }

    /// Likeness of the best individual at the end of a generation: what its score says, or one more
    /// tree where the best has changed and the objective does not look at likeness.
    fn likeness_of_best(&mut self) -> Option<f64> {
        let state = &self.search.state;
        let best = state.best.as_ref().filter(|_| state.is_between_generations())?;
        let cost = best.score.cost;
        if best.score.likeness.is_some() {
            return best.score.likeness;
        }
        let known = self.likeness.filter(|known| known.0.to_bits() == cost.to_bits());
        let (_, likeness) =
            *self.likeness.insert(known.unwrap_or_else(|| (cost, self.objective.likeness(&best.genome))));
        likeness
    }

    fn save(&self) -> Result<(), CheckpointError> {
        let Some(file) = &self.control.checkpoint else {
            return Ok(());
        };
        let checkpoint = Checkpoint {
            fingerprint: self.fingerprint.clone(),
            search: self.search.state.clone(),
            history: self.history.clone(),
            elapsed_s: self.elapsed().as_secs_f64(),
            before_search_s: self.before_search.as_secs_f64(),
        };
        checkpoint.write(&file.path)
    }

    fn finish(mut self) -> Result<Outcome, FitError> {
        let stop = self.verdict().ok_or_else(|| FitError::Search("ended for no reason".to_owned()))?;
        self.tell_progress();
        if let Err(error) = self.save() {
            for observer in &mut self.control.observers {
                observer.checkpoint_failed(&error);
            }
        }
        Ok(Outcome {
            elapsed: self.elapsed(),
            before_search: self.before_search,
            best: self.search.state.best,
            evaluations: self.search.state.evaluations,
            generations: self.search.state.generation,
            stop,
            history: self.history,
        })
    }
}

impl<O: Evaluate> Solver<O, FitState> for Driver<'_, '_> {
    fn name(&self) -> &str {
        <Search<AnyMethod> as Solver<O, FitState>>::name(&self.search)
    }

    fn next_iter(
        &mut self,
        problem: &mut Problem<O>,
        state: FitState,
    ) -> Result<(FitState, Option<KV>), Error> {
        let result = self.search.next_iter(problem, state)?;
        self.after_batch();
        Ok(result)
    }

    fn terminate(&mut self, _: &FitState) -> TerminationStatus {
        match self.verdict() {
            None => TerminationStatus::NotTerminated,
            // The reason is told in our own words by `Outcome::stop`.
            Some(reason) => TerminationStatus::Terminated(TerminationReason::SolverExit(reason.to_string())),
        }
    }
}

/// How many individuals make a batch of about a third of a second.
///
/// Small enough for ctrl-C, timeouts and checkpoints to be prompt, large enough to keep the threads
/// busy: at the end of a batch all wait for the slowest tree. The clock decides it, and nothing but promptness depends on it.
#[derive(Clone, Copy, Debug)]
struct Pace {
    batch: usize,
    last: Duration,
}

impl Pace {
    const TARGET: f64 = 0.3;

    fn new(now: Duration) -> Self {
        Self { batch: 2 * rayon::current_num_threads(), last: now }
    }

    /// The size of the next batch, now that the last one is done.
    fn next(&mut self, now: Duration) -> usize {
        let took = now.saturating_sub(self.last).as_secs_f64();
        self.last = now;
        let threads = rayon::current_num_threads();
        let wanted = self.batch as f64 * (Self::TARGET / took.max(1e-6)).clamp(0.25, 4.0);
        let rounds = (wanted / threads as f64).round().clamp(1.0, 1e4) as usize;
        self.batch = rounds * threads;
        self.batch
    }
}

#[cfg(test)]
#[path = "run_tests.rs"]
mod tests;
