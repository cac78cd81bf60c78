//! `summary.json` and the other files of a result.

use super::drawing::{
    RENDER_SIZE, write_overlay, write_reading, write_render, write_silhouette, write_species,
};
use super::request::Request;
use super::rows::{write_history, write_table};
use super::run_folder::Claim;
use super::run_folder::names::{POSTERIOR, SUMMARY};
use super::views::write_overlays;
use super::{individual, judged, posterior, several};
use crate::files;
use pleach::{FitReport, Prepared};
use serde::Serialize;

/// `summary.json`.
#[derive(Debug, Serialize)]
pub(super) struct Summary {
    #[serde(flatten)]
    pub(super) report: FitReport,
    /// The files that were read: a later run compares them.
    #[serde(flatten)]
    request: Request,
}

impl Summary {
    /// Whether the fit can go on.
    pub(super) const fn interrupted(&self) -> bool {
        !self.report.finished
    }
}

/// Writes everything but the checkpoint into the folder of `claim`.
pub(super) fn write(
    claim: &Claim,
    prepared: &Prepared,
    report: FitReport,
    request: Request,
) -> anyhow::Result<Summary> {
    let (kind, fitted) = (&report.kind, &report.fitted);
    let drawing = &prepared.drawing(&fitted.problem, fitted.settings.limits);
    let goal = &prepared.goal;
    claim.ensure_there()?;

    let mut comments = vec![
        format!(
            "Fitted by pleach {} in {} evaluations ({}).",
            env!("CARGO_PKG_VERSION"),
            report.evaluations,
            report.optimizer
        ),
        format!(
            "IoU {:.4}, pixel accuracy {:.4} with tree_seed below.",
            report.scores.iou, report.scores.pixel_accuracy
        ),
    ];
    comments.extend(judged::comments(fitted, kind.species.generator.space()));
    if let Some(assessment) = &fitted.assessment {
        write_table(&claim.file("parameters.csv"), judged::table(assessment, &report.parameters))?;
    }
    write_species(&claim.file("best.toml"), &kind.species, &comments)?;
    let reading = &report.readings.goal;
    files::write_text(&claim.file("reading.json"), &(serde_json::to_string_pretty(reading)? + "\n"))?;
    write_reading(&claim.file("reading.png"), &goal.full.bitmap, &reading.measures)?;
    write_silhouette(&claim.file("best.png"), kind.over_file())?;
    write_overlay(&claim.file("overlay.png"), &kind.silhouette, &goal.full.bitmap)?;
    write_history(&claim.file("history.csv"), &fitted.outcome.history)?;
    // Shaded pictures take most of the time and the memory of all of this, so that there is one at a time.
    write_render(&claim.file("render.png"), drawing, &kind.species, RENDER_SIZE)?;
    if let (Some(found), Some(tree)) = (&report.individual, report.trees.first()) {
        individual::write(claim, drawing, tree, found)?;
    }
    if let Some(sides) = &report.individuals {
        several::write(claim, &goal.working.bitmap, &report.trees, sides)?;
    }
    if let Some(found) = &report.posterior {
        posterior::write(claim, drawing, found)?;
        write_table(&claim.file(POSTERIOR), posterior::table(found))?;
    }
    write_overlays(claim, "overlay-view", &prepared.views, &report.views)?;
    write_overlays(claim, "overlay-holdout", &prepared.holdout_views, &report.holdout_views)?;
    let summary = Summary { report, request };
    files::write_text(&claim.file(SUMMARY), &(serde_json::to_string_pretty(&summary)? + "\n"))?;
    Ok(summary)
}
