//! A search that keeps to its budget, tells its observers and saves its state.

mod course;
mod pace;
mod streaming;
#[cfg(test)]
mod tests;

use crate::budget::{Spent, StopReason};
use crate::checkpoint::{BodyProblem, Checkpoint, CheckpointError};
use crate::control::{Control, Outcome};
use crate::error::FitError;
use crate::evaluate::Evaluate;
use crate::fingerprint::Fingerprint;
use crate::flight::fly;
use crate::method::{Method, MethodSettings};
use crate::observer::{Observer, Progress};
use crate::search::{Search, SearchState};
use crate::settings::FitSettings;
use crate::solver::FitState;
use crate::space::SearchSpace;
use argmin::core::Executor;
pub(crate) use course::Course;
use serde::{Serialize, de::DeserializeOwned};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;
use streaming::Streaming;

/// Searches `space` for what `objective` scores best.
pub(crate) fn drive<S: MethodSettings<Method: State>>(
    objective: &(impl Evaluate + Sync),
    space: SearchSpace,
    settings: &FitSettings,
    method: &S,
    fingerprint: Fingerprint,
    control: Control<'_>,
) -> Result<Outcome, FitError> {
    let mut driver = Driver::begin(objective, space, settings, method, fingerprint, control)?;
    driver.announce();
    if driver.verdict().is_none() {
        let best = driver.course.search.state.best.clone();
        let run = fly(objective, |flight| {
            let solver = Streaming { driver, flight };
            let executor = Executor::new(objective, solver).ctrlc(false).configure(|mut state: FitState| {
                // What argmin keeps of the earlier parts of a resumed run.
                if let Some(best) = best {
                    state.best_cost = best.score.cost;
                    state.best_individual = Some(best.genome);
                }
                state
            });
            executor.run().map(|result| result.solver.driver)
        });
        driver = run.map_err(|error| FitError::Search(error.into()))?;
    }
    Ok(driver.finish())
}

/// Longest time by the caller's clock between two looks at the budget and at whether a checkpoint is due. The
/// threads do not wait for them.
const LOOK: Duration = Duration::from_millis(100);

/// A method that can be saved.
pub(crate) trait State: Method + Clone + Serialize + DeserializeOwned {}

impl<M: Method + Clone + Serialize + DeserializeOwned> State for M {}

struct Driver<'a, 'e, M> {
    /// For what scores do not tell.
    objective: &'e dyn Evaluate,
    course: Course<M>,
    fingerprint: Fingerprint,
    control: Control<'a>,
    times: Times,
    evaluations_before: u64,
    /// When the state was last saved, by the clock of this part.
    saved: Duration,
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
        let search = Search::resume(state, Arc::new(space));
        let course = Course::new(search, settings.budget, history, now);
        let driver = Self { objective, course, fingerprint, times, evaluations_before, saved: now, control };
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
        self.course.spent(self.elapsed(), self.control.stop.load(Ordering::Relaxed))
    }

    /// Why to stop now, if so. Where the most that may be kept of the time would end the search, a tree like the
    /// best is timed first: what follows may need less.
    fn verdict(&mut self) -> Option<StopReason> {
        let spent = self.spent();
        let verdict = self.course.verdict(&spent);
        if verdict == Some(StopReason::Timeout) && self.course.wants_a_timed_tree(spent.elapsed) {
            self.time_a_tree();
            return self.course.verdict(&self.spent());
        }
        verdict
    }

    /// Whether the budget has to be looked at before more scores have come: the time for it is there, or the fit
    /// was asked to stop.
    fn until_a_look(&self) -> impl Fn() -> bool + use<'a, M> {
        let Control { clock, stop, .. } = self.control;
        let due = clock.elapsed() + LOOK;
        move || stop.load(Ordering::Relaxed) || clock.elapsed() >= due
    }

    fn tell_all(&mut self, tell: impl Fn(&mut dyn Observer)) {
        self.control.observers.iter_mut().for_each(|observer| tell(&mut **observer));
    }

    /// Times a tree like the best.
    fn time_a_tree(&mut self) {
        if let Some(best) = &self.course.search.state.best {
            let before = self.control.clock.elapsed();
            // On this thread: the others have trees before them.
            let _ = self.objective.likeness(&best.genome);
            let tree = self.control.clock.elapsed().saturating_sub(before);
            self.course.set_tree_time(tree);
        }
    }

    /// Replays the rows of earlier parts and tells where things stand.
    fn announce(&mut self) {
        for row in self.course.history.clone() {
            self.tell_all(|observer| observer.generation(&row));
        }
        self.tell_progress();
    }

    fn tell_progress(&mut self) {
        let spent = self.spent();
        let best = self.course.search.state.best.clone();
        let progress = Progress {
            generation: spent.generations,
            evaluations: spent.evaluations,
            evaluations_now: spent.evaluations - self.evaluations_before,
            best: best.as_ref(),
            likeness: self.course.likeness(),
            elapsed: spent.elapsed,
            elapsed_now: spent.elapsed - self.times.earlier,
            used: self.course.budget.used(&spent),
        };
        self.tell_all(|observer| observer.progress(&progress));
    }

    /// After a batch: a row if it finished a generation, progress, a checkpoint if one is due.
    fn after_scores(&mut self) {
        let elapsed = self.elapsed();
        if let Some(row) = self.course.after_scores(self.objective, elapsed) {
            self.tell_all(|observer| observer.generation(&row));
        }
        self.tell_progress();
        let now = self.control.clock.elapsed();
        if self.control.checkpoint.as_ref().is_some_and(|file| now - self.saved >= file.interval) {
            self.saved = now;
            self.try_to_save();
        }
    }

    fn save(&self) -> Result<(), CheckpointError> {
        let Some(file) = &self.control.checkpoint else {
            return Ok(());
        };
        let checkpoint = Checkpoint {
            fingerprint: self.fingerprint.clone(),
            search: self.course.search.state.clone(),
            history: self.course.history.clone(),
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
            finalists: self.course.search.state.finalists.iter().cloned().collect(),
            best: self.course.search.state.best,
            evaluations: self.course.search.state.evaluations,
            generations: self.course.search.state.generation,
            stop,
            history: self.course.history,
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
    for best in state.best.iter().chain(state.finalists.iter()) {
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
