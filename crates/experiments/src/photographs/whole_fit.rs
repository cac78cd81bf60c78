//! The whole fit of a picture, as a user gets it, and its rows.

use super::row::{Row, Which};
use super::spec::PictureSpec;
use super::verdict::words;
use crate::measures::{Judge, Measures};
use crate::record::Fixed;
use crate::stop;
use anyhow::Context;
use pleach::{FitOptions, FitSource, Prepared};
use pleach_fit::{Control, Fitted};
use pleach_reading::Reading;
use pleach_silhouette::Frame;
use pleach_tree::Species;
use std::path::Path;
use std::time::Instant;

/// Trees of other seeds that the kind is measured by.
const FRESH: u64 = 8;
/// How far their seeds are from the kind's own: beyond those that a fit chooses and judges its kind by.
const FIRST: u64 = 4000;

/// What was found.
pub(super) struct Found {
    /// Of the kind's own tree, of fresh seeds, and of this very tree where there is one.
    pub(super) rows: Vec<Row>,
    /// This very tree, or the kind's own one.
    pub(super) best: Species,
}

/// Fits `picture`, a file of `folder`.
pub(super) fn fit(folder: &Path, picture: &PictureSpec, options: &FitOptions) -> anyhow::Result<Found> {
    let path = folder.join(&picture.file);
    let started = Instant::now();
    let clock = || started.elapsed();
    // The steps of `fit_picture`: goal and frame are needed as well.
    let prepared = options.prepare(&FitSource::from(path.as_path()))?;
    let mut library = pleach::plan::library().for_one_goal();
    let fitted = prepared.fit(&mut library, Control::new(&clock, stop::flag()))?;
    let report = prepared.report(fitted)?;
    let seconds = clock().as_secs_f64();

    let goal = &prepared.goal.full;
    let read = &report.readings.goal.measures;
    let judge = Judge::new(&goal.bitmap, read, goal.frame(prepared.height), prepared.height);
    let frame = goal.working_frame(&Frame {
        width: report.goal_width,
        height: report.goal_height,
        meters_per_pixel: report.meters_per_pixel,
        axis_column: report.axis_column,
        ground_row: report.ground_row,
    });
    let kind = &report.kind;
    let mut measured = vec![(Which::Kind, judge.measure(&kind.silhouette, &kind.measures)?)];
    measured.push((Which::Fresh, fresh(&prepared, &report.fitted, &kind.species, &frame, &judge)?));
    if let Some(tree) = report.trees.first() {
        measured.push((Which::Tree, judge.measure(&tree.silhouette, &tree.measures)?));
    }
    let verdict = |of: fn(&pleach_fit::Verdict) -> pleach_fit::KindVerdict| {
        report.verdict.as_ref().map_or_else(String::new, |verdict| words(of(verdict)))
    };
    let row = Row {
        picture: picture.name(),
        set: picture.set.to_string(),
        family: report.generator.clone(),
        species: report.fitted.problem.start.name.clone(),
        kind_verdict: verdict(|verdict| verdict.kind),
        tree_verdict: verdict(|verdict| verdict.tree),
        share: report.verdict.map(|verdict| Fixed(verdict.share)),
        trees: report.evaluations,
        best_ellipse_iou: Fixed(report.scores.best_ellipse_iou),
        wall_s: Fixed(seconds),
        ..Row::default()
    };
    let rows = measured.iter().map(|(which, measures)| row.with(*which, measures)).collect();
    Ok(Found { rows, best: report.best().species.clone() })
}

/// The means over trees of `kind` of other seeds, drawn in `frame`.
fn fresh(
    prepared: &Prepared,
    fitted: &Fitted,
    kind: &Species,
    frame: &Frame,
    judge: &Judge<'_>,
) -> anyhow::Result<Measures> {
    let drawing = prepared.drawing(&fitted.problem, fitted.settings.limits);
    let own = kind.tree_seed.unwrap_or_default();
    let mut measured = Vec::new();
    for seed in (0..FRESH).map(|i| own.wrapping_add(FIRST + i)) {
        stop::check()?;
        // One that is too large to grow says nothing of the others.
        if let Ok(tree) = drawing.grow(&Species { tree_seed: Some(seed), ..kind.clone() }) {
            let silhouette = drawing.draw(&tree, &prepared.view, frame);
            measured.push(judge.measure(&silhouette, &Reading::from_silhouette(&silhouette))?);
        }
    }
    Measures::mean(&measured).context("no tree of another seed grows")
}
