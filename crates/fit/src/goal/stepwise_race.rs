//! The first part of a fit that its caller drives, batch by batch.

use super::driven::{Asked, Driven};
use super::settings::GoalSettings;
use super::stages::{begin_with, open};
use super::stepwise::Stepwise;
use crate::control::Control;
use crate::error::FitError;
use crate::guess::{GuessLibrary, Leg, OpenGuess};
use crate::problem::{FitProblem, Score, Scored};
use std::time::Duration;

/// The race of a first guess, step by step: what comes before a [`Stepwise`] whose goal may be of several generators.
///
/// [`StepwiseRace::next_leg`] names the next search of one generator, whose batches [`StepwiseRace::ask`] gives and
/// [`StepwiseRace::tell`] takes scores for, until it is over; an [`crate::evaluator`] of the leg's problem and settings
/// gives them. [`StepwiseRace::finish`] begins the search with the winner. A race that was run to its end gives the bits
/// of [`crate::fit_goal`].
///
/// ```
/// # use pleach_fit::{
/// #     Budget, Candidate, Control, FitProblem, FitSettings, GoalSettings, GoalView, GuessLibrary,
/// # };
/// use pleach_fit::{Evaluate as _, StepwiseRace, evaluator};
/// # use pleach_silhouette::{Frame, View, silhouette};
/// # use std::sync::atomic::AtomicBool;
/// # use std::time::Duration;
/// # let palm = pleach_generators::preset("palm").unwrap();
/// # let tree = palm.grow(7)?;
/// # let frame = Frame::automatic(&tree, &View::FRONT, pleach_tree::Parts::LEAFY, 64, 64);
/// # let problem = FitProblem::new(palm.clone(), GoalView::new(silhouette(&tree, View::FRONT, 64), View::FRONT, frame));
/// # let search = FitSettings { budget: Budget::evaluations(60), ..FitSettings::default() };
/// # let settings = GoalSettings { search, ..GoalSettings::new(vec![Candidate::from(palm)]) };
/// # let (clock, stop) = (|| Duration::ZERO, AtomicBool::new(false));
/// let mut race = StepwiseRace::begin(&problem, &settings, GuessLibrary::new(), Control::new(&clock, &stop))?;
/// while let Some(leg) = race.next_leg(Duration::ZERO)? {
///     let evaluator = evaluator(leg.problem, &leg.settings)?;
///     loop {
///         let batch = race.ask(1);
///         if batch.genomes.is_empty() {
///             break;
///         }
///         race.tell(&evaluator.scores(&batch.genomes, batch.max_size), Duration::ZERO);
///     }
/// }
/// let fit = race.finish(Control::new(&clock, &stop))?;
/// # assert!(fit.prepared().guess.is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct StepwiseRace {
    problem: FitProblem,
    settings: GoalSettings,
    library: GuessLibrary,
    /// `None` for fits without a first guess.
    open: Option<OpenGuess>,
    /// The search of the present leg.
    driven: Option<Driven>,
}

impl StepwiseRace {
    /// Compares the goals with the known species; then the race can be run.
    ///
    /// # Errors
    /// Those of [`crate::fit_goal`].
    pub fn begin(
        problem: &FitProblem,
        settings: &GoalSettings,
        mut library: GuessLibrary,
        mut control: Control<'_>,
    ) -> Result<Self, FitError> {
        let open = open(problem, settings, &mut library, &mut control)?;
        Ok(Self { problem: problem.clone(), settings: settings.clone(), library, open, driven: None })
    }

    /// Begins the next search if the last has ended, and names the one that is run now; `None` once the race is over, and where
    /// there is none: without a first guess, or with candidates of one generator. `now` is the time since the fit began.
    ///
    /// # Errors
    /// Those of [`crate::evaluator`].
    pub fn next_leg(&mut self, now: Duration) -> Result<Option<Leg<'_>>, FitError> {
        let Some(open) = &mut self.open else { return Ok(None) };
        if let Some(driven) = self.driven.take_if(|driven| driven.ended(now).is_some()) {
            open.race.take(best_of(driven));
        }
        while self.driven.is_none() {
            let Some(leg) = open.race.leg() else { return Ok(None) };
            match Driven::new(leg.problem, &leg.settings, now) {
                Ok(driven) => self.driven = Some(driven),
                // A generator without free numbers keeps its cost.
                Err(FitError::Space(_)) => open.race.take(None),
                Err(error) => return Err(error),
            }
        }
        Ok(open.race.leg())
    }

    /// The search that is run now; `None` before the first and after the last.
    #[must_use]
    pub fn leg(&self) -> Option<Leg<'_>> {
        self.driven.as_ref().and(self.open.as_ref())?.race.leg()
    }

    /// The next individuals of the present leg; none once it is over, or before there is one. See [`Stepwise::ask`].
    pub fn ask(&mut self, workers: usize) -> Asked {
        match &mut self.driven {
            Some(driven) if driven.ended(Duration::ZERO).is_none() => driven.ask(workers),
            _ => Asked { genomes: Vec::new(), max_size: crate::problem::Size::default() },
        }
    }

    /// Takes scores of the present leg. See [`Stepwise::tell`].
    pub fn tell(&mut self, scores: &[Score], now: Duration) {
        if let Some(driven) = &mut self.driven {
            let _ = driven.tell(scores, now);
        }
    }

    /// The best individual of the present leg so far; `None` before its first score.
    #[must_use]
    pub fn best(&self) -> Option<&Scored> {
        self.driven.as_ref()?.course.search.state.best.as_ref()
    }

    /// Individuals of the present leg that were evaluated.
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        self.driven.as_ref().map_or(0, |driven| driven.course.search.state.evaluations)
    }

    /// The used share of the present leg, in 0..=1; `None` before there is one.
    #[must_use]
    pub fn used(&self) -> Option<f64> {
        self.driven.as_ref()?.used(Duration::ZERO)
    }

    /// Begins the search with the generator that is ahead, whether or not the race is over.
    ///
    /// # Errors
    /// Those of [`crate::fit_goal`].
    pub fn finish(self, mut control: Control<'_>) -> Result<Stepwise, FitError> {
        let Self { problem, settings, mut library, open, driven } = self;
        let mut guess = None;
        if let Some(mut open) = open {
            // The present search may have ended by itself.
            match driven {
                Some(driven) if driven.ended(Duration::ZERO).is_some() => open.race.take(best_of(driven)),
                Some(driven) => open.race.stop(best_of(driven)),
                None => {}
            }
            guess = Some(library.close_guess(open, control.stop)?);
        }
        let prepared = begin_with(&problem, &settings, guess, &library, &mut control)?;
        Stepwise::of_prepared(prepared, settings, library, control.clock.elapsed())
    }
}

fn best_of(driven: Driven) -> Option<Scored> {
    driven.course.search.state.best
}
