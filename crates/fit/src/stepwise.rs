//! A whole fit that its caller drives, batch by batch.

use crate::begun::Begun;
use crate::budget::StopReason;
use crate::control::{Control, Outcome};
use crate::driver::Course;
use crate::error::FitError;
use crate::evaluator::Evaluator;
use crate::fit_goal::{Fitted, GoalSettings, begin, conclude};
use crate::genome::{Genome, Score, Scored, Size};
use crate::guess::GuessLibrary;
use crate::history::Row;
use crate::optimizer::AnyMethod;
use crate::problem::FitProblem;
use crate::run::{evaluator_in, search_space};
use crate::search::{Search, SearchState};
use crate::solver::AskTell as _;
use std::sync::Arc;
use std::time::Duration;

/// A fit as [`crate::fit_goal`] makes it, for callers that cannot wait in one call and whose trees are grown
/// elsewhere: in other processes, or in the workers of a web page.
///
/// [`Stepwise::ask`] gives the individuals of the next batch, an [`crate::evaluator`] of the same problem and
/// settings scores them anywhere and in any order, [`Stepwise::tell`] takes the scores, and [`Stepwise::finish`]
/// judges what was found. It has the bits of `fit_goal`, however batches are cut. Searches numbers:
/// [`crate::FitSettings::rules`] are not looked at.
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
/// let begun = fit.begun();
/// let evaluator = evaluator(&begun.problem, &begun.settings)?;
/// while fit.ended(Duration::ZERO).is_none() {
///     let batch = fit.ask(1);
///     let scores = evaluator.scores(&batch.genomes, batch.most);
///     fit.tell(&scores, Duration::ZERO);
/// }
/// let fitted = fit.finish(Control::new(&clock, &stop))?;
/// assert_eq!(fitted.outcome.evaluations, 60);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Stepwise {
    begun: Begun,
    settings: GoalSettings,
    library: GuessLibrary,
    /// For what scores do not tell.
    objective: Evaluator,
    course: Course<AnyMethod>,
    /// What had passed when the search began.
    before_search: Duration,
}

/// Individuals to be scored.
#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    /// The individuals.
    pub genomes: Vec<Genome>,
    /// A tree larger than this may be given up as one that does not grow.
    pub most: Size,
}

impl Stepwise {
    /// Makes the first guess, and stands before the first batch.
    ///
    /// # Errors
    /// Those of [`crate::fit_goal`].
    pub fn begin(
        problem: &FitProblem,
        settings: &GoalSettings,
        mut library: GuessLibrary,
        mut control: Control<'_>,
    ) -> Result<Self, FitError> {
        let begun = begin(problem, settings, &mut library, &mut control)?;
        let space = search_space(&begun.problem, &begun.settings)?;
        let objective = evaluator_in(&space, &begun.problem, &begun.settings)?;
        let search = &begun.settings;
        let method = search.optimizer.method(search.seed, search.start.clone());
        let state = SearchState::new(method, &search.start);
        let now = control.clock.elapsed();
        let course = Course::new(Search::resume(state, Arc::new(space)), search.budget, Vec::new(), now);
        Ok(Self { begun, settings: settings.clone(), library, objective, course, before_search: now })
    }

    /// Where the search began.
    #[must_use]
    pub const fn begun(&self) -> &Begun {
        &self.begun
    }

    /// Why the search is over, if it is; `now` is the time since the fit began.
    #[must_use]
    pub fn ended(&self, now: Duration) -> Option<StopReason> {
        self.course.verdict(&self.course.spent(now, false))
    }

    /// The next individuals: about a third of a second's for so many workers, or as many as there are.
    ///
    /// May be asked again before the last ones are told; with many untold it gives none.
    pub fn ask(&mut self, workers: usize) -> Asked {
        let most = self.course.search.state.most();
        let mut genomes = Vec::new();
        let wanted = self.course.batch_size(workers);
        while genomes.len() < wanted {
            self.course.search.batch = wanted - genomes.len();
            let some = self.course.search.ask().genomes;
            if some.is_empty() {
                break;
            }
            genomes.extend_from_slice(some);
        }
        Asked { genomes, most }
    }

    /// Takes the scores of the oldest individuals that were asked for and not told, in their order; the rows of the
    /// generations that they finished.
    pub fn tell(&mut self, mut scores: &[Score], now: Duration) -> Vec<Row> {
        let mut rows = Vec::new();
        while !scores.is_empty() {
            let brood = self.course.search.awaited().min(scores.len());
            if brood == 0 {
                // Scores of what nobody has asked for.
                break;
            }
            let (these, others) = scores.split_at(brood);
            self.course.search.tell(these);
            rows.extend(self.course.after_scores(&self.objective, now));
            scores = others;
        }
        self.course.set_pace(now);
        rows
    }

    /// The best individual so far; none before the first batch.
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

    /// The largest used share of any part of the budget, in 0..=1; none without a bound.
    #[must_use]
    pub fn used(&self, now: Duration) -> Option<f64> {
        self.course.budget.used(&self.course.spent(now, false))
    }

    /// One row for every finished generation.
    #[must_use]
    pub fn history(&self) -> &[Row] {
        &self.course.history
    }

    /// Ends the search where it is and judges what it has found, by the clock of `control`. A search that was
    /// not over counts as interrupted, and is judged all the same.
    ///
    /// # Errors
    /// Those of [`crate::fit_goal`].
    pub fn finish(self, control: Control<'_>) -> Result<Fitted, FitError> {
        let Self { begun, settings, mut library, course, before_search, .. } = self;
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
        conclude(begun, outcome, &settings, &mut library, control)
    }
}
