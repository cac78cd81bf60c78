//! A whole fit that its caller drives, batch by batch.

use super::driven::{Asked, Driven};
use super::settings::{Fitted, GoalSettings};
use super::stages::{begin, conclude};
use crate::control::{Control, Outcome, PreparedSearch, Row, StopReason};
use crate::error::FitError;
use crate::guess::GuessLibrary;
use crate::problem::{FitProblem, Score, Scored};
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
    driven: Driven,
    /// Time that had passed when the search began.
    before_search: Duration,
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
        Self::of_prepared(prepared, settings.clone(), library, control.clock.elapsed())
    }

    /// The search that `prepared` begins with, from `now` on.
    pub(super) fn of_prepared(
        prepared: PreparedSearch,
        settings: GoalSettings,
        library: GuessLibrary,
        now: Duration,
    ) -> Result<Self, FitError> {
        let driven = Driven::new(&prepared.problem, &prepared.settings, now)?;
        Ok(Self { prepared, settings, library, driven, before_search: now })
    }

    /// The fit as its search begins.
    #[must_use]
    pub const fn prepared(&self) -> &PreparedSearch {
        &self.prepared
    }

    /// The reason why the search is over, if it is; `now` is the time since the fit began.
    #[must_use]
    pub fn ended(&self, now: Duration) -> Option<StopReason> {
        self.driven.ended(now)
    }

    /// The next individuals: as many as take about a third of a second on `workers` workers, or fewer.
    ///
    /// May be called again before the scores of the last ones are told; with too many in flight it returns none.
    pub fn ask(&mut self, workers: usize) -> Asked {
        self.driven.ask(workers)
    }

    /// Takes the scores of the oldest individuals without a score, in the order in which they were asked for. Returns
    /// the rows of the generations that they finished.
    pub fn tell(&mut self, scores: &[Score], now: Duration) -> Vec<Row> {
        self.driven.tell(scores, now)
    }

    /// The best individual so far; `None` before the first score.
    #[must_use]
    pub const fn best(&self) -> Option<&Scored> {
        self.driven.course.search.state.best.as_ref()
    }

    /// Likeness of the best individual, in 0..=1, once it is known.
    #[must_use]
    pub fn likeness(&self) -> Option<f64> {
        self.driven.course.likeness()
    }

    /// Individuals evaluated.
    #[must_use]
    pub const fn evaluations(&self) -> u64 {
        self.driven.course.search.state.evaluations
    }

    /// The largest used share of any limit of the budget, in 0..=1; `None` without a limit.
    #[must_use]
    pub fn used(&self, now: Duration) -> Option<f64> {
        self.driven.used(now)
    }

    /// One row for every finished generation.
    #[must_use]
    pub fn history(&self) -> &[Row] {
        &self.driven.course.history
    }

    /// Ends the search where it is and assesses its result, by the clock of `control`. A search that was not over
    /// counts as interrupted, and is assessed all the same.
    ///
    /// # Errors
    /// Those of [`crate::fit_goal`].
    pub fn finish(self, control: Control<'_>) -> Result<Fitted, FitError> {
        let Self { prepared, settings, mut library, driven: Driven { course, .. }, before_search } = self;
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
