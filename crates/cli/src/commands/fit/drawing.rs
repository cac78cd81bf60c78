//! What is written of a tree that is found: a species file, its silhouette over the goal, a shaded picture.

use crate::commands::sheet::render;
use crate::files;
use pleach::{FitDrawing, GoalPair, Reading, annotate};
use pleach_fit::CostModel;
use pleach_render::png_file;
use pleach_silhouette::{Bitmap, picture};
use pleach_tree::Species;
use std::path::Path;
use std::time::Duration;

/// Pixels a side of the shaded picture of a result.
pub(super) const RENDER_SIZE: u32 = 512;

/// What it takes to draw, score, paint and write the tree of a result.
pub(super) fn writing(goal: &GoalPair) -> CostModel {
    let ratio = goal.full.height_in_pixels() / goal.working.height_in_pixels();
    let parallel = if ratio > 1.0 { REGISTERED * ratio } else { 0.0 };
    CostModel { fixed: PAINTED + scored(goal), serial: PAINTED_TREES, parallel }
}

/// What it takes to draw and score a further individual.
pub(super) fn writing_further(goal: &GoalPair) -> CostModel {
    CostModel { fixed: scored(goal), serial: FURTHER_TREES, parallel: 0.0 }
}

/// What a score card and its pictures take, by the size of the goal.
fn scored(goal: &GoalPair) -> Duration {
    A_MEGAPIXEL.mul_f64(goal.full.bitmap.area() as f64 / 1e6)
}

/// A shaded picture whatever the tree, and how many times as long as to grow and score it in a search it takes to
/// paint one: between what a palm, a black oak and a willow take. `experiments/on-time` says what comes of it.
const PAINTED: Duration = Duration::from_millis(200);
const PAINTED_TREES: f64 = 14.0;
/// Drawings at the goal's own size that register its frame, as trees of a search on all threads: for each pixel that
/// one of the search's is high.
const REGISTERED: f64 = 20.0;
/// It is grown and drawn, and a free tree beside it.
const FURTHER_TREES: f64 = 6.0;
/// The score card of a million pixels, which takes 0.34 s, and their silhouettes.
const A_MEGAPIXEL: Duration = Duration::from_millis(500);

/// Writes a species file with comments at its head.
pub(super) fn write_species(path: &Path, species: &Species, comments: &[String]) -> anyhow::Result<()> {
    files::write_text(path, &species.to_toml(comments))
}

/// Writes a silhouette, of the size and in the frame of the goal's file.
pub(super) fn write_silhouette(path: &Path, over_file: &Bitmap) -> anyhow::Result<()> {
    files::write_whole(path, |file| Ok(over_file.write_png(file)?))
}

/// Writes a silhouette over its goal in two colours, with the margins that are compared.
pub(super) fn write_overlay(path: &Path, silhouette: &Bitmap, goal: &Bitmap) -> anyhow::Result<()> {
    let picture = picture::overlay(silhouette, goal);
    files::write_whole(path, |file| Ok(picture.write_png(file)?))
}

/// Writes what was read of a goal, over the goal.
pub(super) fn write_reading(path: &Path, goal: &Bitmap, reading: &Reading) -> anyhow::Result<()> {
    let picture = annotate(goal, reading);
    files::write_whole(path, |file| Ok(picture.write_png(file)?))
}

/// Writes a shaded picture of `size` × `size` pixels: a silhouette hides absurd stems and leaves.
pub(super) fn write_render(
    path: &Path,
    drawing: &FitDrawing<'_>,
    species: &Species,
    size: u32,
) -> anyhow::Result<()> {
    let picture = render(&drawing.grow(species)?, species, size);
    files::write_whole(path, |file| Ok(png_file::write(file, &[picture], 0)?))
}
