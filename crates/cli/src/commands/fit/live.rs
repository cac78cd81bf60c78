//! Files to watch while a fit runs.

use super::drawing::Drawing;
use super::run_folder::Claim;
use super::summary::{write_history, write_species};
use crate::output;
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

    fn write(&self, best: &Scored, drawing: &Drawing<'_>, claim: &Claim) -> anyhow::Result<()> {
        let file = |name| claim.file(name);
        claim.ensure_there()?;
        let drawn = drawing.draw(best)?;
        write_species(&file("best.toml"), &drawn.species, &["Of a fit that is not finished.".to_owned()])?;
        let goal = &drawing.goals.full.bitmap;
        drawn.write_silhouettes(goal, &file("best.png"), &file("overlay.png"))?;
        drawn.write_render(&file("render.png"), RENDER_SIZE)?;
        write_history(&file("history.csv"), &self.rows)
    }

    /// Writes the files if something is new and it is time.
    pub(super) fn progress(&mut self, progress: &Progress<'_>, drawing: &Drawing<'_>, claim: &Claim) {
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
