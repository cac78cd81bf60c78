//! `experiment.toml`.

use super::needle::NeedleSpec;
use super::treefit::TreefitSpec;
use anyhow::Context;
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// What an experiment runs.
#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub(super) enum Spec {
    /// Optimisers against each other on goals.
    Fits(FitsSpec),
    /// Time and size of trees, species by species.
    Growth(GrowthSpec),
    /// Blends of species, ours against the dissertation's.
    Blend(BlendSpec),
    /// Measures of how alike pictures of trees are, against each other.
    Likeness(LikenessSpec),
    /// Fits of goals that the search has not grown.
    Treefit(TreefitSpec),
    /// How near to the truth parameters must be.
    Needle(NeedleSpec),
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FitsSpec {
    /// The goals.
    pub(super) goals: Vec<GoalSpec>,
    /// Optimisers by name, at their default settings.
    pub(super) optimizers: Vec<String>,
    /// Searches of each optimiser on each goal, seeded 1, 2, ….
    pub(super) repetitions: u64,
    /// Evaluations of each search.
    pub(super) evaluations: u64,
    /// Seed of every tree.
    pub(super) tree_seed: u64,
    /// What is made small; the default objective if it is not said.
    pub(super) objective: Option<String>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GoalSpec {
    /// The picture, from the experiment's folder.
    pub(super) file: PathBuf,
    /// Height of its tree in metres.
    pub(super) height: f64,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GrowthSpec {
    /// Species by name.
    pub(super) species: Vec<String>,
    /// Seeds 1 to this of each species.
    pub(super) seeds: u64,
    /// Whether growing is timed as well.
    pub(super) timed: bool,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BlendSpec {
    /// Species by name; the palm, the quaking aspen and the silver birch among them.
    pub(super) species: Vec<String>,
    /// Steps from one species to another.
    pub(super) steps: u32,
    /// Random points of the hull.
    pub(super) points: u32,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LikenessSpec {
    /// Species by name.
    pub(super) species: Vec<String>,
    /// Species that had no part in the choice of weights.
    pub(super) unseen_species: Vec<String>,
    /// Seeds 1 to this of each species.
    pub(super) seeds: u64,
    /// Seeds 1 to this had a part in the choice of weights.
    pub(super) tuned_seeds: u64,
    /// Seeds 1 to this of each species are drawn in each other's frames.
    pub(super) shared_scale_seeds: u64,
    /// Folders of pictures by another program, from the experiment's: the first of seed 1, and so on.
    pub(super) reference: Vec<PathBuf>,
    /// Parameters that walk away from the truth, as slots.
    pub(super) walks: Vec<String>,
    /// Steps of each walk.
    pub(super) walk_steps: u32,
    /// Species whose first tree that the weights have not seen is the goal of a row of the sheet.
    pub(super) sheet: Vec<String>,
}

impl Spec {
    pub(super) fn read(folder: &Path) -> anyhow::Result<Self> {
        let path = folder.join("experiment.toml");
        let text = std::fs::read_to_string(&path).with_context(|| {
            format!("cannot read {}: an experiment is a folder with an experiment.toml", path.display())
        })?;
        toml::from_str(&text).with_context(|| format!("{} is no experiment", path.display()))
    }
}
