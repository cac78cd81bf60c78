//! Species as silhouettes: grown and drawn side by side on all threads, results in order.

use pleach_silhouette::{Bitmap, Detail, Frame, Rasterizer, View};
use pleach_tree::{GrowError, Growth, Parts, Species, Tree, Workspace};
use rayon::prelude::*;

/// Memory that one thread reuses from tree to tree.
#[derive(Default)]
struct Bench {
    workspace: Workspace,
    tree: Tree,
    rasterizer: Rasterizer,
}

/// Why the tree of one species was not drawn.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("`{species}` does not grow from seed {seed}: {source}")]
pub struct DrawError {
    /// The species.
    pub species: String,
    /// The seed of the tree.
    pub seed: u64,
    /// The reason.
    pub source: GrowError,
}

/// How silhouettes are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drawing {
    /// Height and width in pixels.
    pub pixels: u32,
    /// How finely pixels are sampled.
    pub detail: Detail,
}

/// The silhouettes of the trees of `seed`, each in its own automatic frame from the front: ground at the
/// bottom edge, the trunk's foot in the middle.
///
/// # Errors
/// The first species, in the order given, that does not grow.
pub fn silhouettes(species: &[Species], seed: u64, drawing: Drawing) -> Result<Vec<Bitmap>, DrawError> {
    each_tree(species, seed, |tree, rasterizer| picture(tree, rasterizer, drawing))
}

/// The silhouette of one tree, as [`silhouettes`] draws it.
pub fn picture(tree: &Tree, rasterizer: &mut Rasterizer, drawing: Drawing) -> Bitmap {
    let frame = Frame::automatic(tree, &View::FRONT, Parts::LEAFY, drawing.pixels, drawing.pixels);
    let mut bitmap = Bitmap::default();
    rasterizer.detail = drawing.detail;
    rasterizer.draw(tree, &View::FRONT, &frame, Parts::LEAFY, &mut bitmap);
    bitmap
}

/// Grows every species' tree of `seed` and gives what `look` makes of each, in order.
///
/// # Errors
/// The first species, in the order given, that does not grow.
pub fn each_tree<T: Send>(
    species: &[Species],
    seed: u64,
    look: impl Fn(&Tree, &mut Rasterizer) -> T + Sync,
) -> Result<Vec<T>, DrawError> {
    let grown: Vec<Result<T, DrawError>> = species
        .par_iter()
        .with_max_len(1)
        .map_init(Bench::default, |bench, species| {
            let Bench { workspace, tree, rasterizer } = bench;
            species
                .generator
                .grow(&species.params, &Growth::seed(seed), workspace, tree)
                .map_err(|source| DrawError { species: species.name.clone(), seed, source })?;
            Ok(look(tree, rasterizer))
        })
        .collect();
    grown.into_iter().collect()
}
