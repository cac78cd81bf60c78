//! The fit of one goal, from the picture to the run folder.

use super::Fit;
use super::aftermath::Aftermath;
use super::args::GoalArgs;
use super::drawing::Drawing;
use super::goal::Goals;
use super::live::Live;
use super::progress::Bar;
use super::request::Request;
use super::run_folder::{Mode, RunFolder};
use super::summary::{self, Results, Summary};
use super::views;
use crate::files;
use anyhow::bail;
use pleach_fit::{
    CheckpointSettings, Control, FitError, FitProblem, FitSettings, GoalView, GuessLibrary, StopReason,
    Unknown, check_freedom,
};
use pleach_silhouette::goal::{Encoded, Goal};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// A goal, how it is fitted, and where to.
#[derive(Clone, Debug)]
pub(super) struct Task {
    pub(super) goal: PathBuf,
    pub(super) args: GoalArgs,
    pub(super) folder: RunFolder,
}

/// How a task ended that did not fail.
pub(super) enum Ended {
    Finished(Box<Summary>),
    /// It was asked to stop; with what was found until then, if anything was.
    Interrupted(Option<Box<Summary>>),
}

impl Task {
    /// What is asked for of this goal, whose file is `source`.
    pub(super) fn request(
        &self,
        fit: &Fit,
        source: &Encoded,
        settings: &FitSettings,
    ) -> anyhow::Result<Request> {
        Request::new(fit, &self.goal, source, &self.args, settings)
    }

    /// Fits the goal.
    pub(super) fn run(
        &self,
        fit: &Fit,
        asked_for: &FitSettings,
        mode: Mode,
        library: &mut GuessLibrary,
        stop: &Arc<AtomicBool>,
    ) -> anyhow::Result<Ended> {
        // Whatever can be refused is refused before the folder is touched.
        let goals = Goals::load(&self.goal, &self.args, fit.verbose)?;
        let mut problem = self.problem(fit, &goals.working)?;
        check_freedom(problem.generator.space(), &asked_for.freedom, asked_for.tree_seed)?;
        let mut settings = asked_for.clone();
        if mode == Mode::Continue {
            extend(&mut settings, self.folder.finished().as_ref());
        }
        let request = self.request(fit, &goals.source, &settings)?;
        let mut claim = self.folder.clone().claim(mode, &request)?;

        let mut started = Instant::now();
        let leaves = self.args.leaves();
        let parts = (&mut problem, &mut settings);
        let begun = match fit.search.from.begin(fit.is_batch(), leaves, parts, library, stop) {
            Err(error) if is_interruption(&error) => return Ok(Ended::Interrupted(None)),
            result => result?,
        };
        claim.begin()?;
        if let Some(mask) = &goals.mask {
            files::write_whole(&claim.file("mask.png"), |file| Ok(mask.write_png(file)?))?;
        }
        if claim.resumes() {
            // The first guess is made again, but its time has been counted.
            started = Instant::now();
        }
        let (view, further) = views::sort(&self.args.view)?;
        let drawing = Drawing {
            goals: &goals,
            args: &self.args,
            view,
            problem: &problem,
            limits: settings.limits,
            appearance: fit.search.from.appearance(&begun.looks_like)?,
        };
        let clock = || started.elapsed();
        let (mut bar, mut live) = (Bar::new(&settings), Live::new(drawing, &claim));
        let checkpoint = CheckpointSettings {
            path: claim.checkpoint(),
            interval: fit.checkpoint_every,
            resume: claim.resumes(),
        };
        let control = Control {
            observers: vec![&mut bar, &mut live],
            checkpoint: Some(checkpoint),
            ..Control::new(&clock, stop)
        };
        let mut outcome = pleach_fit::fit(&problem, &settings, control)?;
        bar.finish();

        let Some(best) = outcome.best.clone().filter(|best| best.score.cost.is_finite()) else {
            if outcome.stop == StopReason::Interrupted {
                return Ok(Ended::Interrupted(None));
            }
            bail!("no parameter list that grows a tree was found in {} evaluations", outcome.evaluations);
        };
        let aftermath = match outcome.stop {
            // Whoever waits for the prompt has it at once.
            StopReason::Interrupted => None,
            _ => match Aftermath::of(&problem, &settings, &best, begun.references.clone(), library, stop) {
                Err(FitError::Interrupted) => None,
                result => Some(result?),
            },
        };
        if aftermath.is_none() {
            // The search may have come to its end, the fit has not.
            outcome.stop = StopReason::Interrupted;
        }
        let best = aftermath.as_ref().map_or(&best, |aftermath| &aftermath.best);
        let drawn = drawing.draw(best)?;
        let (height, foliage) = (self.args.height, problem.foliage);
        let placements = pleach_fit::placements(&problem.goals, &best.genome.nuisances);
        // The first is the goal's own.
        let views = further
            .iter()
            .zip(placements.iter().skip(1))
            .map(|(picture, placement)| picture.score(&drawn.tree, foliage, height, placement));
        let holdouts = self.args.holdout_view.iter();
        let holdouts = holdouts.map(|picture| picture.score(&drawn.tree, foliage, height));
        let summary = summary::write(
            &claim,
            Results {
                settings: &settings,
                outcome: &outcome,
                best,
                drawn: &drawn,
                drawing,
                aftermath: aftermath.as_ref(),
                views: views.collect::<anyhow::Result<_>>()?,
                holdout_views: holdouts.collect::<anyhow::Result<_>>()?,
                from: fit.search.from.to_string(),
                begun: &begun,
                request,
            },
        )?;
        if summary.interrupted() {
            return Ok(Ended::Interrupted(Some(Box::new(summary))));
        }
        // Before anything is printed: closed or full output does not make a finished fit unfinished.
        claim.finish()?;
        Ok(Ended::Finished(Box::new(summary)))
    }

    fn problem(&self, fit: &Fit, goal: &Goal) -> anyhow::Result<FitProblem> {
        let start = fit.search.from.species()?;
        let GoalArgs { height, size, free_frame, .. } = self.args;
        let (view, further) = views::sort(&self.args.view)?;
        let mut goals = vec![GoalView {
            goal: goal.bitmap.clone(),
            view,
            frame: goal.frame(height),
            unknown: Unknown::default(),
        }];
        for picture in further {
            goals.push(picture.goal_view(height, size, free_frame)?);
        }
        // A picture that cannot be read is told before the search and not after it.
        for picture in &self.args.holdout_view {
            picture.check(height, size)?;
        }
        Ok(FitProblem {
            generator: start.generator,
            base: start.params.values().to_vec(),
            goals,
            foliage: self.args.leaves().are_expected(),
        })
    }
}

/// Adds what a finished fit has used to a budget that is meant to come on top of it.
fn extend(settings: &mut FitSettings, finished: Option<&Value>) {
    let Some(summary) = finished else { return };
    let budget = &mut settings.budget;
    let used = |key: &str| summary[key].as_u64().unwrap_or(0);
    if let Some(timeout) = &mut budget.timeout {
        *timeout +=
            Duration::try_from_secs_f64(summary["seconds"].as_f64().unwrap_or(0.0)).unwrap_or_default();
    }
    if let Some(evaluations) = &mut budget.evaluations {
        *evaluations += used("evaluations");
    }
    if let Some(generations) = &mut budget.generations {
        *generations += used("generations");
    }
}

/// What to do about a fit of `goal` into `out` that was interrupted.
pub(super) fn how_to_go_on(goal: &Path, out: &Path, mode: Mode, has_begun: bool) -> String {
    match mode {
        Mode::Continue => "interrupted; the same command goes on".to_owned(),
        Mode::New | Mode::Overwrite if !has_begun => {
            "interrupted before the search began; no file was changed, and the same command starts again"
                .to_owned()
        }
        _ => format!(
            "interrupted; `pleach fit {} --out {} --resume` with the same options goes on",
            goal.display(),
            out.display()
        ),
    }
}

/// Whether this is a fit that was asked to stop before it had anything to show.
fn is_interruption(error: &anyhow::Error) -> bool {
    matches!(error.downcast_ref(), Some(FitError::Interrupted))
}
