//! The fit of one goal, from the picture to the run folder.

use super::args::GoalArgs;
use super::drawing::{self, Drawing};
use super::goal::Goals;
use super::outlined::Outlined;
use super::request::Request;
use super::run_folder::{Mode, RunFolder};
use super::summary::{self, Results, Summary};
use super::watch::Watch;
use super::{Fit, views};
use crate::input;
use anyhow::ensure;
use pleach_fit::{
    Accuracy, CheckpointSettings, Control, FitError, FitProblem, FitSettings, GoalSettings, GoalView,
    GuessLibrary, fit_goal_with,
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

    /// The summary of the fit that `--resume` leaves as it is: one that is finished and was asked for the same.
    ///
    /// # Errors
    /// A finished one that was asked for something else.
    pub(super) fn done_before(&self, fit: &Fit, settings: &FitSettings) -> anyhow::Result<Option<Value>> {
        if self.folder.is_unfinished() {
            return Ok(None);
        }
        let Some(summary) = self.folder.finished() else { return Ok(None) };
        let differences = self.request(fit, &input::picture(&self.goal)?, settings)?.differences(&summary);
        ensure!(
            differences.is_empty(),
            "{} was fitted with other options: {}; --resume skips it with the same ones, --overwrite instead of \
             --resume fits again, and another --out keeps both",
            self.folder.path().display(),
            differences.join(", ")
        );
        Ok(Some(summary))
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
        // To read a large photograph takes time too.
        let started = Instant::now();
        // Whatever can be refused is refused before the folder is touched.
        let goals = Goals::load(&self.goal, &self.args, fit.verbose)?;
        let args = &GoalArgs { height: goals.height, ..self.args.clone() };
        let mut problem = problem(fit, args, &goals.working)?;
        let outlined = match &fit.search.volume_from {
            Some(volume) => Some(Outlined::new(volume, &problem.goals, args.height)?),
            None => None,
        };
        let mut search = asked_for.clone();
        if mode == Mode::Continue {
            extend(&mut search, self.folder.finished().as_ref());
        }
        let (from, generator) = (&fit.search.from, &fit.search.generator()?);
        let settings = match outlined {
            Some(outlined) => {
                problem.start = outlined.species.clone();
                outlined.plan(&search)?
            }
            None => from.plan(*generator, self.args.leaves(), &problem.start, &search)?,
        };
        let settings = GoalSettings { individual: fit.individual_settings()?, ..settings };
        let settings = match fit.shares()? {
            Some(shares) => {
                shares.bound(settings, drawing::writing(&goals), drawing::writing_further(&goals))
            }
            None => settings,
        };
        let request = self.request(fit, &goals.source, &search)?;
        let mut claim = self.folder.clone().claim(mode, &request)?;

        let clock = || started.elapsed();
        let checkpoint = CheckpointSettings {
            path: claim.checkpoint(),
            interval: fit.checkpoint_every,
            resume: claim.resumes(),
        };
        let (view, further) = views::sort(&self.args.view)?;
        let rules = settings.search.rules.as_ref();
        let leaves_detected = fit.search.volume_from.is_none() && from.detects(self.args.leaves(), rules);
        let drawing = |problem: &FitProblem, limits| Drawing {
            goals: &goals,
            args,
            view,
            problem: problem.clone(),
            limits,
            placed: None,
        };
        let mut watch = Watch::new(&mut claim, &drawing, (!fit.is_batch()).then_some(leaves_detected));
        let control = Control {
            observers: vec![&mut watch],
            checkpoint: Some(checkpoint),
            ..Control::new(&clock, stop)
        };
        let fitted = fit_goal_with(&problem, &settings, library, control);
        drop(watch);
        let fitted = match fitted {
            Err(FitError::Interrupted) => return Ok(Ended::Interrupted(None)),
            fitted => fitted?,
        };

        let mut drawing = drawing(&fitted.problem, fitted.settings.limits);
        drawing.register(&fitted.best)?;
        let drawn = drawing.draw(&fitted.best)?;
        let (height, foliage) = (args.height, fitted.problem.foliage);
        let placements = pleach_fit::placements(&fitted.problem.goals, &fitted.best.genome.nuisances);
        // The first is the goal's own.
        let views = further
            .iter()
            .zip(placements.iter().skip(1))
            .map(|(picture, placement)| picture.score(&drawn.tree, foliage, height, placement))
            .collect::<anyhow::Result<_>>()?;
        let holdouts = self.args.holdout_view.iter();
        let holdout_views = holdouts
            .map(|picture| picture.score(&drawn.tree, foliage, height))
            .collect::<anyhow::Result<_>>()?;
        let summary = summary::write(
            &claim,
            Results {
                fitted: &fitted,
                drawn,
                drawing: &drawing,
                views,
                holdout_views,
                from: from.to_string(),
                leaves_detected,
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
}

fn problem(fit: &Fit, args: &GoalArgs, goal: &Goal) -> anyhow::Result<FitProblem> {
    let start = fit.search.start()?;
    let GoalArgs { height, size, free_frame, .. } = *args;
    let (view, further) = views::sort(&args.view)?;
    let accuracy = if args.frame.is_some() { Accuracy::Exact } else { Accuracy::Pixel };
    let mut goals =
        vec![GoalView { accuracy, ..GoalView::new(goal.bitmap.clone(), view, goal.frame(height)) }];
    for picture in further {
        goals.push(picture.goal_view(height, size, free_frame)?);
    }
    // A picture that cannot be read is told before the search and not after it.
    for picture in &args.holdout_view {
        picture.check(height, size)?;
    }
    Ok(FitProblem { start, goals, foliage: args.leaves().expected() })
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
