//! The fit of one goal, from the picture to the run folder.

use super::args::Fit;
use super::request::Request;
use super::run_folder::{Mode, RunFolder};
use super::summary::{self, Summary};
use super::watch::Watch;
use super::{drawing, flags, goal};
use crate::input;
use crate::segmenter::Segmenter;
use anyhow::ensure;
use pleach::{Encoded, FitOptions, FitSource, Spent};
use pleach_fit::{CheckpointSettings, Control, FitError, GuessLibrary};
use pleach_tree::Species;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// A goal, how it is fitted, and where to.
#[derive(Clone, Debug)]
pub(super) struct Task {
    pub(super) goal: PathBuf,
    pub(super) options: FitOptions,
    /// The program that makes the goal's mask.
    pub(super) segmenter: Option<Segmenter>,
    /// The species that `--from` says, where it came from standard input.
    pub(super) start: Option<Species>,
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
    pub(super) fn request(&self, source: &Encoded) -> anyhow::Result<Request> {
        // As a fit has it that goes on from nothing.
        Request::new(&self.goal, source, &self.options.after(&Spent::default()), self.segmenter.as_ref())
    }

    /// The summary of the fit that `--resume` leaves as it is: one that is finished and was asked for the same.
    ///
    /// # Errors
    /// A finished one that was asked for something else.
    pub(super) fn done_before(&self) -> anyhow::Result<Option<Value>> {
        if self.folder.is_unfinished() {
            return Ok(None);
        }
        let Some(summary) = self.folder.finished() else { return Ok(None) };
        let differences = self.request(&input::picture(&self.goal)?)?.differences(&summary);
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
        mode: Mode,
        library: &mut GuessLibrary,
        stop: &Arc<AtomicBool>,
    ) -> anyhow::Result<Ended> {
        // To read a large photograph takes time too.
        let started = Instant::now();
        // Whatever can be refused is refused before the folder is touched.
        let picture = input::picture(&self.goal)?;
        let spent = match mode {
            Mode::Continue => spent(self.folder.finished().as_ref()),
            _ => Spent::default(),
        };
        let request =
            Request::new(&self.goal, &picture, &self.options.after(&spent), self.segmenter.as_ref())?;
        let picture = match &self.segmenter {
            Some(segmenter) => segmenter.cut_out(&picture)?,
            None => picture,
        };
        // Standard input is called so in errors, and `stdin` in what is made of it.
        let name = input::stem(&self.goal).map(|stem| stem.to_string_lossy().into_owned());
        let pictures = input::converted_pictures(&self.options)?;
        let source = FitSource { start: self.start.clone(), name, pictures, ..picture.into() };
        let prepared = self.options.prepare_after(&source, &spent).map_err(flags::named)?;
        drop(source);
        goal::say(&self.goal, &prepared.goal, fit.verbose);
        let (writing, further) = (drawing::writing(&prepared.goal), drawing::writing_further(&prepared.goal));
        let prepared = prepared.with_result_cost(writing, further);
        let mut claim = self.folder.clone().claim(mode, &request)?;

        let clock = || started.elapsed();
        let checkpoint = CheckpointSettings {
            path: claim.checkpoint(),
            interval: fit.checkpoint_every,
            resume: claim.resumes(),
        };
        let mut watch = Watch::new(&mut claim, &prepared, !fit.is_batch());
        let control = Control {
            observers: vec![&mut watch],
            checkpoint: Some(checkpoint),
            ..Control::new(&clock, stop)
        };
        let fitted = prepared.fit(library, control);
        drop(watch);
        let fitted = match fitted {
            Err(FitError::Interrupted) => return Ok(Ended::Interrupted(None)),
            fitted => fitted?,
        };
        let summary = summary::write(&claim, &prepared, prepared.report(fitted)?, request)?;
        if summary.interrupted() {
            return Ok(Ended::Interrupted(Some(Box::new(summary))));
        }
        // Before anything is printed: closed or full output does not make a finished fit unfinished.
        claim.finish()?;
        Ok(Ended::Finished(Box::new(summary)))
    }
}

/// What a finished fit has used of its budgets.
fn spent(finished: Option<&Value>) -> Spent {
    let count = |key: &str| finished.and_then(|summary| summary[key].as_u64()).unwrap_or(0);
    let seconds = finished.and_then(|summary| summary["seconds"].as_f64()).unwrap_or(0.0);
    Spent {
        time: Duration::try_from_secs_f64(seconds).unwrap_or_default(),
        evaluations: count("evaluations"),
        generations: count("generations"),
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
