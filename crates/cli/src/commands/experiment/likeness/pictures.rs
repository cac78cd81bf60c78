//! Pictures of trees: own ones, and those of another program.

use super::measures::{self, Values};
use super::{SIDE, progress};
use anyhow::{Context, bail};
use pleach_silhouette::goal::{Goal, GoalOptions};
use pleach_silhouette::{Bitmap, Frame, Rasteriser, View};
use pleach_tree::{Foliage, Growth, Species, Tree};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// A picture of a tree.
#[derive(Clone)]
pub(super) struct Drawn {
    pub(super) species: String,
    pub(super) seed: u64,
    pub(super) bitmap: Bitmap,
}

/// Seeds 1 to `seeds` of each species, each in its own automatic frame.
///
/// A silhouette has no scale: in frames of their own trees differ by how they look and not by their
/// size, which is the harder task.
pub(super) fn draw(species: &[Species], seeds: u64, foliage: bool) -> anyhow::Result<Vec<Drawn>> {
    grown(species, seeds, foliage, |tree| {
        let frame = Frame::automatic(tree, &View::FRONT, foliage, SIDE, SIDE);
        silhouette(tree, &frame, foliage)
    })
    .map(|trees| trees.into_iter().map(|(species, seed, bitmap)| Drawn { species, seed, bitmap }).collect())
}

pub(super) fn silhouette(tree: &Tree, frame: &Frame, foliage: bool) -> Bitmap {
    let mut bitmap = Bitmap::default();
    Rasteriser::new().draw(tree, &View::FRONT, frame, foliage, &mut bitmap);
    bitmap
}

/// What `look` sees of each seed of each species.
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
            let foliage = if foliage { Foliage::All } else { Foliage::None };
            let tree = species.grow_with(&Growth { foliage, parallel: false, ..Growth::seed(seed) })?;
            Ok((species.name.clone(), seed, look(&tree)))
        })
        .collect()
}

/// Trees in their goal's frame, as a fit sees them: which goals there are, and what every measure
/// says of each tree in the frame of each goal.
pub(super) fn at_goal_scale(
    species: &[Species],
    seeds: u64,
) -> anyhow::Result<(Vec<Drawn>, Vec<Vec<Values>>)> {
    let frames = grown(species, seeds, true, |tree| Frame::automatic(tree, &View::FRONT, true, SIDE, SIDE))?;
    // A tree at a time, in every frame: all trees together would take gigabytes.
    let bar = progress("trees", frames.len() as u64);
    let drawn = grown(species, seeds, true, |tree| {
        let pictures: Vec<Bitmap> =
            frames.iter().map(|(_, _, frame)| silhouette(tree, frame, true)).collect();
        bar.inc(1);
        pictures
    })?;
    bar.finish_and_clear();
    let goals: Vec<Drawn> = drawn
        .iter()
        .enumerate()
        .map(|(g, (species, seed, pictures))| Drawn {
            species: species.clone(),
            seed: *seed,
            bitmap: pictures[g].clone(),
        })
        .collect();
    let values = goals
        .par_iter()
        .enumerate()
        .map(|(g, goal)| {
            drawn.iter().map(|(_, _, pictures)| measures::of(&pictures[g], &goal.bitmap)).collect()
        })
        .collect();
    Ok((goals, values))
}

/// The pictures `SPECIES_SEED_front.png` in `folders`, or `…_front_bare.png`, at our size.
pub(super) fn read(
    folder: &Path,
    folders: &[PathBuf],
    species: &[String],
    foliage: bool,
) -> anyhow::Result<Vec<Drawn>> {
    let options = GoalOptions { max_side: Some(SIDE), ..GoalOptions::default() };
    let ending = if foliage { "_front.png" } else { "_front_bare.png" };
    let mut drawn = Vec::new();
    for name in species {
        for (seed, place) in (1..).zip(folders) {
            let path = folder.join(place).join(format!("{name}_{seed}{ending}"));
            let bitmap =
                Goal::load(&path, &options).with_context(|| format!("cannot use {}", path.display()))?.bitmap;
            if (bitmap.width(), bitmap.height()) != (SIDE, SIDE) {
                bail!("{} is not square", path.display());
            }
            drawn.push(Drawn { species: name.clone(), seed, bitmap });
        }
    }
    Ok(drawn)
}
