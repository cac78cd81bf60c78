//! The loop of a search: it asks, submits, collects and tells until the budget is used up.

use super::course::Course;
use super::queue::{WorkQueue, with_queue};
use crate::control::{Control, Observer, Outcome, Progress, Spent, StopReason};
use crate::error::FitError;
use crate::evaluator::Evaluate;
use crate::method::{Method, MethodSettings};
use crate::run::checkpoint::{BodyProblem, Checkpoint, CheckpointError};
use crate::run::fingerprint::Fingerprint;
use crate::run::settings::FitSettings;
use crate::search::{AskTell as _, Search, SearchState};
use crate::space::SearchSpace;
use serde::{Serialize, de::DeserializeOwned};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

/// Searches `space` for the individual of least cost by `objective`.
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
    with_queue(objective, |queue| driver.search(&queue))?;
    Ok(driver.finish())
}

/// Longest time by the caller's clock between two checks of the budget and of whether a checkpoint is due. The
/// threads do not wait for them.
const CHECK: Duration = Duration::from_millis(100);

/// A method that can be saved.
pub(crate) trait State: Method + Clone + Serialize + DeserializeOwned {}

impl<M: Method + Clone + Serialize + DeserializeOwned> State for M {}

struct Driver<'a, 'e, M> {
    /// For likenesses that scores do not contain.
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
    /// The clock when the time of this part began: a resumed run does again, before its search, what the first
    /// part has done and counted.
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
        // Fails before hours of work if the folder cannot be written.
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

    /// Asks, submits, collects and tells until there is a reason to stop.
    fn search(&mut self, queue: &WorkQueue<'_, '_, impl Evaluate + Sync>) -> Result<(), FitError> {
        while self.verdict().is_none() {
            let search = &mut self.course.search;
            loop {
                let chunk = search.ask();
                if chunk.genomes.is_empty() {
                    break;
                }
                queue.submit(chunk);
            }
            let collected = queue.collect(self.course.search.awaited(), self.until_check());
            let scores = collected.map_err(|panic| FitError::ScoringPanicked { message: panic.0 })?;
            if self.course.search.tell(&scores).is_some() {
                self.after_scores();
            }
        }
        Ok(())
    }

    /// The reason to stop now, if there is one. Where the upper bound of the reserve would end the search, a tree
    /// like the best is timed first: the work on the result may need less.
    fn verdict(&mut self) -> Option<StopReason> {
        let spent = self.spent();
        let verdict = self.course.verdict(&spent);
        if verdict == Some(StopReason::Timeout) && self.course.wants_evaluation_time(spent.elapsed) {
            self.time_evaluation();
            return self.course.verdict(&self.spent());
        }
        verdict
    }

    /// Whether the next check of the budget is due, or the stop flag is raised.
    fn until_check(&self) -> impl Fn() -> bool + use<'a, M> {
        let Control { clock, stop, .. } = self.control;
        let due = clock.elapsed() + CHECK;
        move || stop.load(Ordering::Relaxed) || clock.elapsed() >= due
    }

    fn notify(&mut self, tell: impl Fn(&mut dyn Observer)) {
        self.control.observers.iter_mut().for_each(|observer| tell(&mut **observer));
    }

    /// Times one evaluation of a tree like the best.
    fn time_evaluation(&mut self) {
        if let Some(best) = &self.course.search.state.best {
            let before = self.control.clock.elapsed();
            // On this thread: the others have queued trees to score.
            let _ = self.objective.likeness(&best.genome);
            let evaluation = self.control.clock.elapsed().saturating_sub(before);
            self.course.set_evaluation_time(evaluation);
        }
    }

    /// Replays the rows of earlier parts to the observers, then reports progress.
    fn announce(&mut self) {
        for row in self.course.history.clone() {
            self.notify(|observer| observer.generation(&row));
        }
        self.notify_progress();
    }

    fn notify_progress(&mut self) {
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
        self.notify(|observer| observer.progress(&progress));
    }

    /// After scores: a row if they finished a generation, progress, a checkpoint if one is due.
    fn after_scores(&mut self) {
        let elapsed = self.elapsed();
        if let Some(row) = self.course.after_scores(self.objective, elapsed) {
            self.notify(|observer| observer.generation(&row));
        }
        self.notify_progress();
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

    /// Saves the state; observers hear of a failure, and the search goes on.
    fn try_to_save(&mut self) {
        if let Err(error) = self.save() {
            self.notify(|observer| observer.checkpoint_failed(&error));
        }
    }

    fn finish(mut self) -> Outcome {
        // Only the flag can be lowered again after it has ended the search.
        let stop = self.verdict().unwrap_or(StopReason::Interrupted);
        self.notify_progress();
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

/// Whether a search in `space` can have written this checkpoint, which is of the right run.
fn check<S: MethodSettings>(
    checkpoint: &Checkpoint<S::Method>,
    settings: &FitSettings,
    method: &S,
    space: &SearchSpace,
) -> Result<(), BodyProblem> {
    let state = &checkpoint.search;
    // An individual with a score has grown, so its values are valid for this generator.
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
