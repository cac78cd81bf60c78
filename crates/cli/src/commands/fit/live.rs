//! Files to watch while a fit runs.

use super::drawing::{write_overlay, write_render, write_silhouette, write_species};
use super::rows::write_history;
use super::run_folder::Claim;
use crate::output;
use pleach::FitDrawing;
use pleach_fit::{Progress, Row, Scored};
use std::time::{Duration, Instant};

/// Shortest time between two rounds of files.
const MIN_INTERVAL: Duration = Duration::from_secs(3);
/// Files take at most one part in this many of the time.
const SHARE: u32 = 50;
/// Pixels a side of the shaded picture while the fit runs.
const RENDER_SIZE: u32 = 256;

/// Writes best.toml, best.png, overlay.png, render.png and history.csv of the best individual so far,
/// now and then.
pub(super) struct Live {
    rows: Vec<Row>,
    /// Cost of the individual that was written last.
    shown: f64,
    due: Instant,
    warned: bool,
}

impl Live {
    pub(super) fn new() -> Self {
        let due = Instant::now() + MIN_INTERVAL;
        Self { rows: Vec::new(), shown: f64::INFINITY, due, warned: false }
    }

    fn write(&self, best: &Scored, drawing: &FitDrawing<'_>, claim: &Claim) -> anyhow::Result<()> {
        let file = |name| claim.file(name);
        claim.ensure_there()?;
        let species = drawing.species(&best.genome)?;
        let (silhouette, original) = drawing.silhouettes(&drawing.grow(&species)?);
        write_species(&file("best.toml"), &species, &["Of a fit that is not finished.".to_owned()])?;
        write_silhouette(&file("best.png"), original.as_ref().unwrap_or(&silhouette))?;
        write_overlay(&file("overlay.png"), &silhouette, &drawing.prepared.goal.full.bitmap)?;
        write_render(&file("render.png"), drawing, &species, RENDER_SIZE)?;
        write_history(&file("history.csv"), &self.rows)
    }

    /// Writes the files if something is new and it is time.
    pub(super) fn progress(&mut self, progress: &Progress<'_>, drawing: &FitDrawing<'_>, claim: &Claim) {
        let Some(best) = progress.best.filter(|best| best.score.cost < self.shown) else { return };
        let started = Instant::now();
        if started < self.due {
            return;
        }
        self.shown = best.score.cost;
        if let Err(error) = self.write(best, drawing, claim)
            && !self.warned
        {
            // Once is enough: the disk will be as full in three seconds.
            self.warned = true;
            output::note(format!("warning: {}; the fit goes on", output::causes(&error, ": ")));
        }
        self.due = Instant::now() + MIN_INTERVAL.max(started.elapsed() * SHARE);
    }

    pub(super) fn generation(&mut self, row: &Row) {
        self.rows.push(*row);
    }
}
