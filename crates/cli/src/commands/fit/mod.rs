//! `pleach fit`: from goal images to run folders.
//!
//! What is typed (`args.rs`, `values.rs`) becomes [`pleach::FitOptions`] (`options.rs`). A `task.rs` is the fit of one
//! goal into a `run_folder/`, a `batch.rs` is many of them. `summary.rs` writes the files of a result, and `report.rs`
//! says it in words.

mod args;
mod batch;
mod drawing;
pub(super) mod flags;
mod goal;
mod guess;
mod help;
mod individual;
mod judged;
pub(super) mod list;
mod live;
mod names;
mod options;
mod posterior;
mod progress;
mod report;
pub(super) mod request;
mod rows;
pub(super) mod run_folder;
mod several;
mod signals;
mod summary;
pub(super) mod table;
mod task;
pub(super) mod values;
mod views;
mod watch;

use crate::interrupted::Interrupted;
use crate::{input, output};
use anyhow::bail;
pub(crate) use args::Fit;
use names::RUNS;
pub(super) use names::run_name;
use pleach::plan::library;
use pleach::{FitOptions, FitSource, StartFrom};
use pleach_tree::Species;
use run_folder::{Mode, RunFolder};
use std::path::Path;
use task::{Ended, Task, how_to_go_on};

impl Fit {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        if self.search.settings.iter().any(|setting| setting == "help") {
            return output::line(options::describe(&self.search.optimizer)?);
        }
        let options = self.options(&self.goal_options)?;
        if self.is_batch() && !(options.views.is_empty() && options.holdout_views.is_empty()) {
            bail!("further views are of one tree, and there are {} goals", self.goals.len());
        }
        // Standard input is read once.
        let start = match &options.from {
            StartFrom::Species(name) if name == "-" => Some(input::species(name)?),
            _ => None,
        };
        // Before a folder is made.
        let source = FitSource { start: start.clone(), ..Path::new("").into() };
        let _ = options.start(&source).map_err(flags::named)?;
        if let StartFrom::Species(name) = &options.from {
            input::note_untranslated(name);
        }
        match &self.goals[..] {
            [goal] if !self.is_batch() => self.single(goal, options, start),
            _ => batch::run(self, start.as_ref()),
        }
    }

    /// Fits one goal and shows its score card.
    fn single(&self, goal: &Path, options: FitOptions, start: Option<Species>) -> anyhow::Result<()> {
        let path = self
            .out
            .clone()
            .unwrap_or_else(|| Path::new(RUNS).join(run_name(goal).unwrap_or_else(|| "goal".to_owned())));
        let segmenter = self.goal_options.mask_command.clone();
        let folder = RunFolder::at(path.clone());
        let task = Task { goal: goal.to_owned(), options, segmenter, start, folder };
        let mode = self.mode();
        if mode == Mode::Resume
            && let Some(summary) = task.done_before()?
        {
            output::note(format!(
                "{} holds a finished fit of the same; --continue searches on",
                path.display()
            ));
            return if self.json { output::json(&summary) } else { Ok(()) };
        }
        let mut library = library().for_one_goal();
        let ended = task.run(self, mode, &mut library, &signals::catch()?)?;
        let (summary, interrupted) = match ended {
            Ended::Finished(summary) => (Some(summary), None),
            Ended::Interrupted(summary) => {
                let has_begun = summary.is_some() || RunFolder::at(path.clone()).is_unfinished();
                (summary, Some(Interrupted::new(how_to_go_on(goal, &path, mode, has_begun))))
            }
        };
        if let Some(summary) = summary {
            if self.json {
                output::json(&summary)?;
            } else {
                let folder = RunFolder::at(path).of_results(interrupted.is_some());
                output::line(report::report(&summary.report, goal, &folder))?;
            }
        }
        interrupted.map_or(Ok(()), |interrupted| Err(interrupted.into()))
    }
}
