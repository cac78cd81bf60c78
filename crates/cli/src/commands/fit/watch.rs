//! What is seen of a fit while it runs: bars in the terminal, files in the run folder.

use super::guess;
use super::live::Live;
use super::progress::Bar;
use super::run_folder::Claim;
use crate::{files, memory, output};
use indicatif::{ProgressBar, ProgressStyle};
use pleach::{FitDrawing, Prepared};
use pleach_fit::{
    CheckpointError, IndividualProgress, Observer, ObserverError, PreparedSearch, Progress, Row,
};
use std::time::Duration;

/// Watches one fit, and makes room for it in its folder once its search begins.
pub(super) struct Watch<'a> {
    claim: &'a mut Claim,
    prepared: &'a Prepared,
    /// Whether it is said what the goal looks like.
    says: bool,
    guessing: Option<ProgressBar>,
    search: Option<Search<'a>>,
    assessing: Option<ProgressBar>,
    individual: Option<ProgressBar>,
    learning: Option<ProgressBar>,
}

/// What is shown of the search.
struct Search<'a> {
    bar: Bar,
    live: Live,
    drawing: FitDrawing<'a>,
}

impl<'a> Watch<'a> {
    pub(super) fn new(claim: &'a mut Claim, prepared: &'a Prepared, says: bool) -> Self {
        Self {
            claim,
            prepared,
            says,
            guessing: None,
            search: None,
            assessing: None,
            individual: None,
            learning: None,
        }
    }

    fn begin(&mut self, search: &PreparedSearch) -> anyhow::Result<()> {
        end(&mut self.guessing);
        if let (Some(guess), true) = (&search.guess, self.says) {
            output::note(guess::said(guess, self.prepared.detects_leaves));
            guess::raced(guess).into_iter().for_each(output::note);
        }
        // The drawings that the goal was compared with.
        memory::give_back_the_rest();
        self.claim.begin()?;
        let drawing = self.prepared.drawing(&search.problem, search.settings.limits);
        if let Some(mask) = &self.prepared.goal.mask {
            files::write_whole(&self.claim.file("mask.png"), |file| Ok(mask.bitmap.write_png(file)?))?;
        }
        self.search = Some(Search { bar: Bar::new(&search.settings), live: Live::new(), drawing });
        Ok(())
    }
}

impl Observer for Watch<'_> {
    fn guessing(&mut self, done: usize, all: usize) {
        show_trees(&mut self.guessing, "first guess {wide_bar} {pos} of {len} trees", done, all);
    }

    fn prepared(&mut self, prepared: &PreparedSearch) -> Result<(), ObserverError> {
        Ok(self.begin(prepared)?)
    }

    fn progress(&mut self, progress: &Progress<'_>) {
        if let Some(Search { bar, live, drawing }) = &mut self.search {
            bar.progress(progress);
            live.progress(progress, drawing, self.claim);
        }
    }

    fn generation(&mut self, row: &Row) {
        if let Some(search) = &mut self.search {
            search.live.generation(row);
        }
    }

    fn checkpoint_failed(&mut self, error: &CheckpointError) {
        if let Some(search) = &mut self.search {
            search.bar.checkpoint_failed(error);
        }
    }

    fn assessing(&mut self) {
        self.search = None;
        let bar = if output::is_watched() { ProgressBar::new_spinner() } else { ProgressBar::hidden() };
        bar.enable_steady_tick(Duration::from_millis(100));
        bar.set_message("judging the result: other seeds, and every parameter");
        self.assessing = Some(bar);
    }

    fn individual(&mut self, progress: &IndividualProgress) {
        const STEPS: f64 = 1000.0;
        self.search = None;
        end(&mut self.assessing);
        let bar = self.individual.get_or_insert_with(|| {
            let bar =
                if output::is_watched() { ProgressBar::new(STEPS as u64) } else { ProgressBar::hidden() };
            match ProgressStyle::with_template("this very tree {wide_bar} {msg}") {
                Ok(style) => bar.with_style(style),
                Err(_) => bar,
            }
        });
        let IndividualProgress { number, trials, iou, likeness, used, .. } = progress;
        bar.set_position((used * STEPS) as u64);
        let which = if *number == 0 { String::new() } else { format!("tree {}: ", number + 1) };
        bar.set_message(format!("{which}likeness {likeness:.3}, IoU {iou:.3}; {trials} branches tried"));
    }

    fn learning(&mut self, done: usize, all: usize) {
        self.search = None;
        end(&mut self.assessing);
        end(&mut self.individual);
        show_trees(&mut self.learning, "how sure it is {wide_bar} {pos} of {len} trees", done, all);
    }
}

/// Shows how many trees are grown.
fn show_trees(bar: &mut Option<ProgressBar>, template: &str, done: usize, all: usize) {
    let bar = bar.get_or_insert_with(|| {
        let bar = if output::is_watched() { ProgressBar::new(1) } else { ProgressBar::hidden() };
        match ProgressStyle::with_template(template) {
            Ok(style) => bar.with_style(style),
            Err(_) => bar,
        }
    });
    bar.set_length(all as u64);
    bar.set_position(done as u64);
}

/// Takes a bar from the terminal.
fn end(bar: &mut Option<ProgressBar>) {
    if let Some(bar) = bar.take() {
        bar.finish_and_clear();
    }
}

impl Drop for Watch<'_> {
    fn drop(&mut self) {
        end(&mut self.guessing);
        end(&mut self.assessing);
        end(&mut self.individual);
        end(&mut self.learning);
    }
}
