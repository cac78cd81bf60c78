//! A whole fit that its caller drives, batch by batch.

use super::settings::{Fitted, GoalSettings};
use super::stages::{begin, conclude};
use crate::control::{Control, Outcome, PreparedSearch, Row, StopReason};
use crate::error::FitError;
use crate::evaluator::Evaluator;
use crate::guess::GuessLibrary;
use crate::method::AnyMethod;
use crate::problem::{FitProblem, Genome, Score, Scored, Size};
use crate::run::{Course, evaluator_in, search_space};
use crate::search::{AskTell as _, Search, SearchState};
use std::sync::Arc;
use std::time::Duration;

/// [`crate::fit_goal`] step by step, for callers that cannot block in one call, and whose trees are grown
/// elsewhere: in other processes, or in the workers of a web page.
///
/// [`Stepwise::ask`] gives the individuals of the next batch, an [`crate::evaluator`] of the same problem and
/// settings scores them anywhere and in any order, [`Stepwise::tell`] takes the scores, and [`Stepwise::finish`]
/// assesses the result. It has the bits of `fit_goal`, whatever the sizes of batches. Searches numbers only:
/// [`crate::FitSettings::rules`] are ignored.
///
/// ```
/// use pleach_fit::{
///     Budget, Candidate, Control, Evaluate as _, FitProblem, FitSettings, GoalSettings, GoalView, GuessLibrary,
///     Stepwise, evaluator,
/// };
/// use pleach_silhouette::{Frame, View, silhouette};
/// use std::sync::atomic::AtomicBool;
/// use std::time::Duration;
///
/// let palm = pleach_generators::preset("palm").unwrap();
/// let tree = palm.grow(7)?;
/// let frame = Frame::automatic(&tree, &View::FRONT, pleach_tree::Parts::LEAFY, 64, 64);
/// let problem = FitProblem::new(palm.clone(), GoalView::new(silhouette(&tree, View::FRONT, 64), View::FRONT, frame));
/// let search = FitSettings { budget: Budget::evaluations(60), ..FitSettings::default() };
/// let settings = GoalSettings { search, ..GoalSettings::new(vec![Candidate::from(palm)]) };
///
/// let (clock, stop) = (|| Duration::ZERO, AtomicBool::new(false));
/// let mut fit = Stepwise::begin(&problem, &settings, GuessLibrary::new(), Control::new(&clock, &stop))?;
/// let prepared = fit.prepared();
/// let evaluator = evaluator(&prepared.problem, &prepared.settings)?;
/// while fit.ended(Duration::ZERO).is_none() {
///     let batch = fit.ask(1);
///     let scores = evaluator.scores(&batch.genomes, batch.max_size);
///     fit.tell(&scores, Duration::ZERO);
/// }
/// let fitted = fit.finish(Control::new(&clock, &stop))?;
/// assert_eq!(fitted.outcome.evaluations, 60);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Stepwise {
    prepared: PreparedSearch,
    settings: GoalSettings,
    library: GuessLibrary,
    /// For likenesses that scores do not contain.
    objective: Evaluator,
    course: Course<AnyMethod>,
    /// Time that had passed when the search began.
    before_search: Duration,
}

/// Individuals that need scores.
#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    /// The individuals.
    pub genomes: Vec<Genome>,
    /// A tree larger than this may be abandoned and scored as invalid.
    pub max_size: Size,
}

impl Stepwise {
    /// Makes the first guess; then the first batch can be asked for.
    ///
    /// # Errors
    /// Those of [`crate::fit_goal`].
    pub fn begin(
        problem: &FitProblem,
        settings: &GoalSettings,
        mut library: GuessLibrary,
        mut control: Control<'_>,
    ) -> Result<Self, FitError> {
        let prepared = begin(problem, settings, &mut library, &mut control)?;
        let space = search_space(&prepared.problem, &prepared.settings)?;
        let objective = evaluator_in(&space, &prepared.problem, &prepared.settings)?;
        let search = &prepared.settings;
        let method = search.optimizer.method(search.seed, search.start.clone());
        let state = SearchState::new(method, &search.start);
        let now = control.clock.elapsed();
        let course = Course::new(Search::resume(state, Arc::new(space)), search.budget, Vec::new(), now);
        Ok(Self { prepared, settings: settings.clone(), library, objective, course, before_search: now })
    }

    /// The fit as its search begins.
    #[must_use]
    pub const fn prepared(&self) -> &PreparedSearch {
        &self.prepared
    }

    /// The reason why the search is over, if it is; `now` is the time since the fit began.
    #[must_use]
    pub fn ended(&self, now: Duration) -> Option<StopReason> {
        self.course.verdict(&self.course.spent(now, false))
    }

    /// The next individuals: as many as take about a third of a second on `workers` workers, or fewer.
    ///
    /// May be called again before the scores of the last ones are told; with too many in flight it returns none.
    pub fn ask(&mut self, workers: usize) -> Asked {
        let max_size = self.course.search.state.max_size();
        let mut genomes = Vec::new();
        let wanted = self.course.batch_size(workers);
        while genomes.len() < wanted {
            self.course.search.max_chunk = wanted - genomes.len();
            let some = self.course.search.ask().genomes;
            if some.is_empty() {
                break;
            }
            genomes.extend_from_slice(some);
        }
        Asked { genomes, max_size }
    }

    /// Takes the scores of the oldest individuals without a score, in the order in which they were asked for. Returns
    /// the rows of the generations that they finished.
    pub fn tell(&mut self, mut scores: &[Score], now: Duration) -> Vec<Row> {
        let mut rows = Vec::new();
        while !scores.is_empty() {
            let awaited = self.course.search.awaited().min(scores.len());
            if awaited == 0 {
                // More scores than individuals.
                break;
            }
            let (these, others) = scores.split_at(awaited);
            self.course.search.tell(these);
            rows.extend(self.course.after_scores(&self.objective, now));
            scores = others;
        }
        self.course.set_pace(now);
        rows
    }

    /// The best individual so far; `None` before the first score.
    #[must_use]
    pub const fn best(&self) -> Option<&Scored> {
        self.course.search.state.best.as_ref()
    }

    /// Likeness of the best individual, in 0..=1, once it is known.
    #[must_use]
    pub fn likeness(&self) -> Option<f64> {
        self.course.likeness()
    }

    /// Individuals evaluated.
    #[must_use]
    pub const fn evaluations(&self) -> u64 {
        self.course.search.state.evaluations
    }

    /// The largest used share of any limit of the budget, in 0..=1; `None` without a limit.
    #[must_use]
    pub fn used(&self, now: Duration) -> Option<f64> {
        self.course.budget.used(&self.course.spent(now, false))
    }

    /// One row for every finished generation.
    #[must_use]
    pub fn history(&self) -> &[Row] {
        &self.course.history
    }

    /// Ends the search where it is and assesses its result, by the clock of `control`. A search that was not over
    /// counts as interrupted, and is assessed all the same.
    ///
    /// # Errors
    /// Those of [`crate::fit_goal`].
    pub fn finish(self, control: Control<'_>) -> Result<Fitted, FitError> {
        let Self { prepared, settings, mut library, course, before_search, .. } = self;
        let elapsed = control.clock.elapsed();
        let stop = course.verdict(&course.spent(elapsed, false)).unwrap_or(StopReason::Interrupted);
        let state = course.search.state;
        let outcome = Outcome {
            finalists: state.finalists.iter().cloned().collect(),
            best: state.best,
            evaluations: state.evaluations,
            generations: state.generation,
            elapsed,
            before_search,
            stop,
            history: course.history,
        };
        conclude(prepared, outcome, &settings, &mut library, control)
    }
}
