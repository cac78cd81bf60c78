//! An individual as what people look at: a species file, its silhouette over the goal, a shaded picture.

use super::args::GoalArgs;
use super::goal::Goals;
use crate::files;
use anyhow::Context as _;
use pleach_fit::{Aftermath, FitProblem, FoundIndividual, Genome, Scored};
use pleach_mesh::Palette;
use pleach_render::{Preview, PreviewSettings, png_file};
use pleach_silhouette::{Bitmap, Rasterizer, View, picture};
use pleach_tree::species::safe_name;
use pleach_tree::{Growth, Limits, Species, Tree};
use std::path::Path;
use std::time::Duration;

/// What it takes to draw, score, paint and write the tree of a result.
pub(super) fn writing(goals: &Goals) -> Aftermath {
    Aftermath { fixed: PAINTED + scored(goals), trees: PAINTED_TREES, spread: 0.0 }
}

/// What it takes to draw and score a further individual.
pub(super) fn writing_further(goals: &Goals) -> Aftermath {
    Aftermath { fixed: scored(goals), trees: FURTHER_TREES, spread: 0.0 }
}

/// What a score card and its pictures take, by the size of the goal.
fn scored(goals: &Goals) -> Duration {
    A_MEGAPIXEL.mul_f64(goals.full.bitmap.area() as f64 / 1e6)
}

/// A shaded picture whatever the tree, and how many times as long as to grow and score it in a search it takes to
/// paint one: between what a palm, a black oak and a willow take. `experiments/on-time` says what comes of it.
const PAINTED: Duration = Duration::from_millis(200);
const PAINTED_TREES: f64 = 13.0;
/// It is grown and drawn twice, and a free tree beside it.
const FURTHER_TREES: f64 = 6.0;
/// The score card of a million pixels, which takes 0.34 s, and their silhouettes.
const A_MEGAPIXEL: Duration = Duration::from_millis(500);

/// Draws individuals of one fit.
#[derive(Clone)]
pub(super) struct Drawing<'a> {
    pub(super) goals: &'a Goals,
    pub(super) args: &'a GoalArgs,
    /// Direction of the goal's own view.
    pub(super) view: View,
    pub(super) problem: FitProblem,
    pub(super) limits: Limits,
}

/// An individual, grown and drawn as the goal is.
pub(super) struct Drawn {
    pub(super) species: Species,
    pub(super) tree: Tree,
    /// Of the goal's own size.
    pub(super) bitmap: Bitmap,
}

impl Drawing<'_> {
    /// The species that an individual is.
    fn species(&self, genome: &Genome) -> anyhow::Result<Species> {
        Ok(Species {
            name: safe_name(&self.goals.name),
            description: String::new(),
            ..self.problem.species(genome)?
        })
    }

    /// Grows and draws `best`.
    pub(super) fn draw(&self, best: &Scored) -> anyhow::Result<Drawn> {
        self.draw_species(self.species(&best.genome)?, best.genome.tree_seed)
    }

    /// Grows and draws a goal's own tree.
    pub(super) fn draw_individual(&self, found: &FoundIndividual) -> anyhow::Result<Drawn> {
        let named = Species {
            name: safe_name(&self.goals.name),
            description: String::new(),
            ..found.species.clone()
        };
        let seed = named.tree_seed.context("an individual has a seed")?;
        self.draw_species(named, seed)
    }

    fn draw_species(&self, species: Species, tree_seed: u64) -> anyhow::Result<Drawn> {
        let foliage = self.problem.foliage;
        let growth = Growth { limits: self.limits, foliage, ..Growth::seed(tree_seed) };
        let tree = species.grow_with(&growth)?;
        let frame = self.goals.full.frame(self.args.height);
        let mut bitmap = Bitmap::default();
        Rasterizer::new().draw(&tree, &self.view, &frame, foliage.into(), &mut bitmap);
        Ok(Drawn { species, tree, bitmap })
    }
}

impl Drawn {
    /// Writes the silhouette, and the same over the goal in two colours.
    pub(super) fn write_silhouettes(&self, goal: &Bitmap, best: &Path, overlay: &Path) -> anyhow::Result<()> {
        files::write_whole(best, |file| Ok(self.bitmap.write_png(file)?))?;
        let picture = picture::overlay(&self.bitmap, goal);
        files::write_whole(overlay, |file| Ok(picture.write_png(file)?))
    }

    /// Writes a shaded picture of `size` × `size` pixels: a silhouette hides absurd stems and leaves.
    pub(super) fn write_render(&self, path: &Path, size: u32) -> anyhow::Result<()> {
        let palette = Palette::new(&self.species, None);
        let tree = palette.dressed(&self.tree);
        let settings = PreviewSettings { width: size, height: size, ..PreviewSettings::default() };
        let picture = Preview::new(&tree, &palette, size).picture(&settings);
        files::write_whole(path, |file| Ok(png_file::write(file, &[picture], 0)?))
    }
}
