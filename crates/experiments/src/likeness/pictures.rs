//! Pictures of trees: own ones, and those of another program.

use super::measures::{self, Seen, Values};
use super::{LikenessSpec, SIDE, progress, stop};
use anyhow::{Context, bail};
use pleach_silhouette::goal::{Goal, GoalOptions};
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::{Foliage, Growth, Parts, Species, Tree};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// A picture of a tree.
#[derive(Clone)]
pub(super) struct Drawn {
    pub(super) species: String,
    pub(super) seed: u64,
    pub(super) seen: Seen,
}

/// Seeds 1 to `seeds` of each species, each in its own automatic frame.
///
/// A silhouette has no scale: in frames of their own trees differ by how they look and not by their
/// size, which is the harder task.
pub(super) fn draw(species: &[Species], seeds: u64, foliage: bool) -> anyhow::Result<Vec<Drawn>> {
    let look = |tree: &Tree| {
        let frame = Frame::automatic(tree, &View::FRONT, Parts::with_foliage(foliage), SIDE, SIDE);
        Seen::new(silhouette(tree, &frame, foliage))
    };
    let trees = grown(species, seeds, foliage, look)?;
    Ok(trees.into_iter().map(|(species, seed, seen)| Drawn { species, seed, seen }).collect())
}

pub(super) fn silhouette(tree: &Tree, frame: &Frame, foliage: bool) -> Bitmap {
    let mut bitmap = Bitmap::default();
    Rasterizer::new().draw(tree, &View::FRONT, frame, Parts::with_foliage(foliage), &mut bitmap);
    bitmap
}

/// The result of `look` for each seed of each species.
fn grown<T: Send>(
    species: &[Species],
    seeds: u64,
    foliage: bool,
    look: impl Fn(&Tree) -> T + Sync,
) -> anyhow::Result<Vec<(String, u64, T)>> {
    let each: Vec<(&Species, u64)> =
        species.iter().flat_map(|s| (1..=seeds).map(move |seed| (s, seed))).collect();
    each.into_par_iter()
        .map(|(species, seed)| {
            stop::check()?;
            let foliage = if foliage { Foliage::All } else { Foliage::None };
            let tree = species.grow_with(&Growth { foliage, parallel: false, ..Growth::seed(seed) })?;
            Ok((species.name.clone(), seed, look(&tree)))
        })
        .collect()
}

/// Trees in their goal's frame, as a fit sees them: the goals, and what every measure says of tree t
/// in the frame of goal g at `[t][g]`.
pub(super) fn at_goal_scale(
    species: &[Species],
    seeds: u64,
) -> anyhow::Result<(Vec<Drawn>, Vec<Vec<Values>>)> {
    let goals = draw(species, seeds, true)?;
    let frame = |tree: &Tree| Frame::automatic(tree, &View::FRONT, Parts::LEAFY, SIDE, SIDE);
    let frames = grown(species, seeds, true, frame)?;
    // A tree at a time, in every frame: all trees together would take gigabytes.
    let bar = progress("trees", frames.len() as u64);
    let values = grown(species, seeds, true, |tree| {
        let of = |(goal, (_, _, frame)): (&Drawn, &(String, u64, Frame))| {
            measures::compare(&goal.seen, &Seen::new(silhouette(tree, frame, true)))
        };
        let values = goals.iter().zip(&frames).map(of).collect();
        bar.inc(1);
        values
    })?;
    bar.finish_and_clear();
    Ok((goals, values.into_iter().map(|(_, _, values)| values).collect()))
}

/// The pictures `SPECIES_SEED_front.png` in the folders of reference, or `…_front_bare.png`, with
/// species and seed.
pub(super) fn files(folder: &Path, spec: &LikenessSpec, foliage: bool) -> Vec<(String, u64, PathBuf)> {
    let ending = if foliage { "_front.png" } else { "_front_bare.png" };
    let of = |name: &str| -> Vec<(String, u64, PathBuf)> {
        let path = |seed: u64, place: &Path| folder.join(place).join(format!("{name}_{seed}{ending}"));
        (1..).zip(&spec.reference).map(|(seed, place)| (name.to_owned(), seed, path(seed, place))).collect()
    };
    spec.species.iter().flat_map(|name| of(name.get_ref())).collect()
}

/// [`files`] at our size.
pub(super) fn read(folder: &Path, spec: &LikenessSpec, foliage: bool) -> anyhow::Result<Vec<Drawn>> {
    let options = GoalOptions { max_side: Some(SIDE), ..GoalOptions::default() };
    let mut drawn = Vec::new();
    for (species, seed, path) in files(folder, spec, foliage) {
        let bitmap =
            Goal::load(&path, &options).with_context(|| format!("cannot use {}", path.display()))?.bitmap;
        if (bitmap.width(), bitmap.height()) != (SIDE, SIDE) {
            bail!("{} is not square", path.display());
        }
        drawn.push(Drawn { species, seed, seen: Seen::new(bitmap) });
    }
    Ok(drawn)
}
