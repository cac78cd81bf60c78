//! Trees and pictures as goals, and the species that are found for them.

use anyhow::Context;
use pleach_console::files;
use pleach_fit::GoalView;
use pleach_silhouette::goal::{Goal, GoalOptions};
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::Appearance;
use pleach_tree::{Foliage, Growth, Parts, Species, Tree};
use std::path::Path;

/// Side of every goal in pixels.
pub(super) const SIZE: u32 = 256;

/// A picture of a whole tree, with its foliage or without, in the frame that suits it.
pub(super) fn pictured(tree: &Tree, view: View, foliage: bool) -> GoalView {
    let parts = Parts::with_foliage(foliage);
    let frame = Frame::automatic(tree, &view, parts, SIZE, SIZE);
    let mut goal = Bitmap::default();
    Rasterizer::new().draw(tree, &view, &frame, parts, &mut goal);
    GoalView::new(goal, view, frame)
}

/// The picture in `file`, from `folder`, at the size of goals.
pub(super) fn load(folder: &Path, file: &Path) -> anyhow::Result<Goal> {
    let options = GoalOptions { max_side: Some(SIZE), ..GoalOptions::default() };
    let path = folder.join(file);
    Goal::load(&path, &options).with_context(|| format!("cannot use {}", path.display()))
}

/// That picture of a tree of `height` metres from the front.
pub(super) fn load_view(folder: &Path, file: &Path, height: f64) -> anyhow::Result<GoalView> {
    let picture = load(folder, file)?;
    let frame = picture.frame(height);
    Ok(GoalView::new(picture.bitmap, View::FRONT, frame))
}

/// The silhouette of the tree of `seed` as `view` sees it.
pub(super) fn draw(
    species: &Species,
    seed: u64,
    foliage: Foliage,
    view: &GoalView,
) -> anyhow::Result<Bitmap> {
    let tree = species.grow_with(&Growth { foliage, ..Growth::seed(seed) })?;
    let mut bitmap = Bitmap::default();
    Rasterizer::new().draw(&tree, &view.view, &view.frame, foliage.into(), &mut bitmap);
    Ok(bitmap)
}

/// Writes what was found as a species file, so that anybody can grow it.
pub(super) fn write_species(path: &Path, name: &str, species: &Species) -> anyhow::Result<()> {
    let species = Species {
        name: name.to_owned(),
        description: String::new(),
        appearance: Appearance::default(),
        ..species.clone()
    };
    files::write_text(path, &species.to_toml(&[]))
}
