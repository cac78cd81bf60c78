//! The goal's own tree: what is said and written of it.

use super::drawing::{RENDER_SIZE, write_overlay, write_render, write_silhouette, write_species};
use super::run_folder::Claim;
use crate::output;
use pleach::{FitDrawing, FittedTree, IndividualReport, ScoreCard};

/// Writes individual.toml and its pictures.
pub(super) fn write(
    claim: &Claim,
    drawing: &FitDrawing<'_>,
    tree: &FittedTree,
    found: &IndividualReport,
) -> anyhow::Result<()> {
    let FittedTree { species, scores, .. } = tree;
    let comments = [format!(
        "This very tree: {} stems have draws of their own, chosen among {} by pleach {}. IoU {:.4}, likeness \
         {:.4}. Other seeds of this file are trees of its kind.",
        found.stems,
        found.trials,
        env!("CARGO_PKG_VERSION"),
        scores.iou,
        scores.likeness
    )];
    write_species(&claim.file("individual.toml"), species, &comments)?;
    write_silhouette(&claim.file("individual.png"), tree.over_file())?;
    let goal = &drawing.prepared.goal.full.bitmap;
    write_overlay(&claim.file("overlay-individual.png"), &tree.silhouette, goal)?;
    write_render(&claim.file("individual-render.png"), drawing, species, RENDER_SIZE)
}

/// The scores of the tree of the `kind` and of the goal's own, side by side.
pub(super) fn beside(one: &IndividualReport, kind: &ScoreCard) -> String {
    let scores = &one.scores;
    let row = |name: &str, kind: f64, one: f64, note: String| {
        vec![name.to_owned(), format!("{kind:.4}"), format!("{one:.4}"), note]
    };
    let head = ["", "the kind", "this very tree", ""].map(str::to_owned).to_vec();
    let ellipse = format!("best single ellipse {:.4}", scores.best_ellipse_iou);
    let rows = vec![
        head,
        row("likeness", kind.likeness, scores.likeness, String::new()),
        row("IoU", kind.iou, scores.iou, ellipse),
        row("boundary F", kind.boundary_f, scores.boundary_f, String::new()),
        row("blurred IoU", kind.blurred_iou.sixty_fourth, scores.blurred_iou.sixty_fourth, "1/64".to_owned()),
    ];
    format!(
        "\n{}\n{} of its stems have draws of their own ({} tried, {:.0} a second)\n\n",
        output::table(&rows, &[1, 2]),
        one.stems,
        one.trials,
        one.trials_per_second
    )
}
