//! A search that keeps to its budget, tells its observers and saves its state.

mod pace;
#[cfg(test)]
mod tests;

use crate::budget::{Budget, Spent, StopReason};
use crate::checkpoint::{BodyProblem, Checkpoint, CheckpointError};
use crate::control::{Control, Outcome};
use crate::error::FitError;
use crate::evaluate::Evaluate;
use crate::fingerprint::Fingerprint;
use crate::genome::{Score, Scored};
use crate::history::Row;
use crate::method::{Method, MethodSettings};
use crate::observer::{Observer, Progress};
use crate::search::{Search, SearchState};
use crate::settings::FitSettings;
use crate::solver::{ArgminSolver, AskTell, Batch, FitState};
use crate::space::SearchSpace;
use argmin::core::{Executor, TerminationReason};
use pace::Pace;
use serde::{Serialize, de::DeserializeOwned};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

/// Searches `space` for what `objective` scores best.
pub(crate) fn drive<S: MethodSettings<Method: State>>(
    objective: &impl Evaluate,
    space: SearchSpace,
    settings: &FitSettings,
    method: &S,
    fingerprint: Fingerprint,
    control: Control<'_>,
) -> Result<Outcome, FitError> {
    let mut driver = Driver::begin(objective, space, settings, method, fingerprint, control)?;
    driver.announce();
    if driver.verdict().is_none() {
        let best = driver.search.state.best.clone();
        let executor =
            Executor::new(objective, ArgminSolver(driver)).ctrlc(false).configure(|mut state: FitState| {
                // What argmin keeps of the earlier parts of a resumed run.
                if let Some(best) = best {
                    state.best_cost = best.score.cost;
                    state.best_individual = Some(best.genome);
                }
                state
            });
        driver = executor.run().map_err(|error| FitError::Search(error.into()))?.solver.0;
    }
    Ok(driver.finish())
}

/// A method that can be saved.
pub(crate) trait State: Method + Clone + Serialize + DeserializeOwned {}

impl<M: Method + Clone + Serialize + DeserializeOwned> State for M {}

struct Driver<'a, 'e, M> {
    /// For what scores do not tell.
    objective: &'e dyn Evaluate,
    search: Search<M>,
    budget: Budget,
    fingerprint: Fingerprint,
    control: Control<'a>,
    history: Vec<Row>,
    times: Times,
    evaluations_before: u64,
    /// Likeness of the best, and the cost by which it is known again. Of a resumed run first none: that of
    /// the last row counts.
    likeness: Option<(f64, Option<f64>)>,
    /// When the state was last saved, by the clock of this part.
    saved: Duration,
    pace: Pace,
}

/// The time of a run that may have several parts.
#[derive(Clone, Copy, Debug)]
struct Times {
    /// All of the earlier parts.
    earlier: Duration,
    /// The clock when this part began to count: what a resumed run does before its search, the first part
    /// has done and counted.
    from: Duration,
    /// What had passed when the search began for the first time.
    before_search: Duration,
}

impl<'a, 'e, M: State> Driver<'a, 'e, M> {
    fn begin<S: MethodSettings<Method = M>>(
        objective: &'e dyn Evaluate,
        space: SearchSpace,
        settings: &FitSettings,
        method: &S,
        fingerprint: Fingerprint,
        control: Control<'a>,
    ) -> Result<Self, FitError> {
        let resumed = match &control.checkpoint {
            Some(file) if file.resume && file.path.exists() => {
                let checkpoint = Checkpoint::read(&file.path, &fingerprint)?;
                check(&checkpoint, settings, method, &space)
                    .map_err(|problem| CheckpointError::WrongBody { path: file.path.clone(), problem })?;
                Some(checkpoint)
            }
            _ => None,
        };
        let now = control.clock.elapsed();
        let (state, history, times) = match resumed {
            None => {
                let method = method.begin(settings.seed, settings.start.clone());
                let times = Times { earlier: Duration::ZERO, from: Duration::ZERO, before_search: now };
                (SearchState::new(method, &settings.start), Vec::new(), times)
            }
            Some(Checkpoint { search, history, elapsed_s, before_search_s, .. }) => {
                let seconds = |s| Duration::try_from_secs_f64(s).unwrap_or_default();
                let (earlier, before_search) = (seconds(elapsed_s), seconds(before_search_s));
                (search, history, Times { earlier, from: now, before_search })
            }
        };
        let evaluations_before = state.evaluations;
        let mut search = Search::resume(state, Arc::new(space));
        search.evaluation_limit = settings.budget.evaluations.unwrap_or(u64::MAX).max(evaluations_before);
        let pace = Pace::new(now);
        search.batch = pace.batch();
        let driver = Self {
            objective,
            search,
            budget: settings.budget,
            fingerprint,
            history,
            times,
            evaluations_before,
            likeness: None,
            saved: now,
            pace,
            control,
        };
        // Before hours of work: is the folder there, can it be written?
        driver.save()?;
        Ok(driver)
    }

    fn elapsed_now(&self) -> Duration {
        self.control.clock.elapsed().saturating_sub(self.times.from)
    }

    fn elapsed(&self) -> Duration {
        self.times.earlier + self.elapsed_now()
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

    fn tell_all(&mut self, tell: impl Fn(&mut dyn Observer)) {
        self.control.observers.iter_mut().for_each(|observer| tell(&mut **observer));
    }

    /// Replays the rows of earlier parts and tells where things stand.
    fn announce(&mut self) {
        for row in self.history.clone() {
            self.tell_all(|observer| observer.generation(&row));
        }
        self.tell_progress();
    }

    fn tell_progress(&mut self) {
        let spent = self.spent();
        let best = self.search.state.best.clone();
        let last_row = || self.history.last().and_then(|row| row.likeness);
        let known = self.likeness.map_or_else(last_row, |known| known.1);
        let progress = Progress {
            generation: spent.generations,
            evaluations: spent.evaluations,
            evaluations_now: spent.evaluations - self.evaluations_before,
            best: best.as_ref(),
            likeness: best.as_ref().and_then(|best| best.score.likeness).or(known),
            elapsed: spent.elapsed,
            elapsed_now: spent.elapsed - self.times.earlier,
            used: self.budget.used(&spent),
        };
        self.tell_all(|observer| observer.progress(&progress));
    }

    /// After a batch: a row if it finished a generation, progress, a checkpoint if one is due.
    fn after_batch(&mut self) {
        if let Some(row) = self.new_row() {
            self.history.push(row);
            self.tell_all(|observer| observer.generation(&row));
        }
        self.tell_progress();
        let now = self.control.clock.elapsed();
        self.search.batch = self.pace.next(now);
        if self.control.checkpoint.as_ref().is_some_and(|file| now - self.saved >= file.interval) {
            self.saved = now;
            self.try_to_save();
        }
    }

    /// The row of the generation that the last batch has finished, if it has.
    fn new_row(&mut self) -> Option<Row> {
        let elapsed_s = self.elapsed().as_secs_f64();
        let likeness = self.likeness_of_best();
        let best_cost = self.search.best_cost()?;
        let state = &self.search.state;
        let (best, last) = (state.best.as_ref()?, state.generation_best?);
        state.is_between_generations().then_some(Row {
            generation: state.generation,
            evaluations: state.evaluations,
            best_cost,
            generation_best_cost: last.cost,
            iou: best.score.iou,
            accuracy: best.score.accuracy,
            likeness,
            elapsed_s,
        })
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
            before_search_s: self.times.before_search.as_secs_f64(),
        };
        checkpoint.write(&file.path)
    }

    /// Saves the state; a failure is told, and the search goes on.
    fn try_to_save(&mut self) {
        if let Err(error) = self.save() {
            self.tell_all(|observer| observer.checkpoint_failed(&error));
        }
    }

    fn finish(mut self) -> Outcome {
        // Nothing but the flag can be taken back after it has ended the search.
        let stop = self.verdict().unwrap_or(StopReason::Interrupted);
        self.tell_progress();
        self.try_to_save();
        Outcome {
            elapsed: self.elapsed(),
            before_search: self.times.before_search,
            best: self.search.state.best,
            evaluations: self.search.state.evaluations,
            generations: self.search.state.generation,
            stop,
            history: self.history,
        }
    }
}

/// Whether a checkpoint of the right run holds what a search in `space` can have written.
fn check<S: MethodSettings>(
    checkpoint: &Checkpoint<S::Method>,
    settings: &FitSettings,
    method: &S,
    space: &SearchSpace,
) -> Result<(), BodyProblem> {
    let state = &checkpoint.search;
    // What was scored has grown, so it is a list of this generator's.
    if let Some(best) = &state.best {
        space.params().check(best.genome.values.clone()).map_err(BodyProblem::Best)?;
        if !space.has_structure(&best.genome) {
            return Err(BodyProblem::Structure);
        }
    }
    if !method.has_begun(&state.method, settings.seed, &settings.start) || !state.suits(space) {
        return Err(BodyProblem::Method);
    }
    Ok(())
}

impl<M: State> AskTell for Driver<'_, '_, M> {
    fn name(&self) -> &str {
        self.search.name()
    }

    fn ask(&mut self) -> Batch<'_> {
        self.search.ask()
    }

    fn tell(&mut self, scores: &[Score]) -> Option<Scored> {
        let best = self.search.tell(scores);
        self.after_batch();
        best
    }

    fn ended(&self) -> Option<TerminationReason> {
        // The reason is told in our own words by `Outcome::stop`.
        self.verdict().map(|reason| TerminationReason::SolverExit(reason.to_string()))
    }
}
