//! An individual as what people look at: a species file, its silhouette over the goal, a shaded picture.

use super::args::GoalArgs;
use super::goal::Goals;
use crate::files;
use anyhow::Context as _;
use pleach_fit::{Aftermath, FitProblem, FoundIndividual, Genome, Placement, Scored};
use pleach_mesh::Palette;
use pleach_render::{Preview, PreviewSettings, png_file};
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View, picture};
use pleach_tree::species::safe_name;
use pleach_tree::{Growth, Limits, Species, Tree};
use std::path::Path;
use std::time::Duration;

/// What it takes to draw, score, paint and write the tree of a result.
pub(super) fn writing(goals: &Goals) -> Aftermath {
    let ratio = goals.full.height_in_pixels() / goals.working.height_in_pixels();
    let spread = if ratio > 1.0 { REGISTERED * ratio } else { 0.0 };
    Aftermath { fixed: PAINTED + scored(goals), trees: PAINTED_TREES, spread }
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
/// Drawings at the goal's own size that register its frame, as trees of a search on all threads: for each pixel that
/// one of the search's is high.
const REGISTERED: f64 = 20.0;
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
    /// Where the tree stands at the goal's own size, once that is registered.
    pub(super) placed: Option<Placement>,
}

/// An individual, grown and drawn as the goal is.
pub(super) struct Drawn {
    pub(super) species: Species,
    pub(super) tree: Tree,
    /// In the frame that is compared: [`Goals::full`].
    pub(super) bitmap: Bitmap,
    /// In the frame of the goal's file, where that is another.
    original: Option<Bitmap>,
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
        let (full, frame) = (&self.goals.full, self.frame());
        let mut rasterizer = Rasterizer::new();
        let mut draw = |frame: &Frame| {
            let mut bitmap = Bitmap::default();
            rasterizer.draw(&tree, &self.view, frame, foliage.into(), &mut bitmap);
            bitmap
        };
        let bitmap = draw(&frame);
        let original = (!full.is_whole()).then(|| draw(&full.original_frame(&frame)));
        Ok(Drawn { species, tree, bitmap, original })
    }

    /// The frame of the goal at its own size, as far as it is known.
    pub(super) fn frame(&self) -> Frame {
        self.placement().frame(&self.goals.full.frame(self.args.height))
    }

    fn placement(&self) -> Placement {
        self.placed.unwrap_or(self.problem.goals[0].registered)
    }

    /// Registers the frame at the goal's own size by the tree of `best`.
    pub(super) fn register(&mut self, best: &Scored) -> anyhow::Result<()> {
        let goals = (&self.goals.full, &self.goals.working);
        let foliage = self.problem.foliage;
        let growth = Growth { limits: self.limits, foliage, ..Growth::seed(best.genome.tree_seed) };
        let tree = self.species(&best.genome)?.grow_with(&growth)?;
        let (view, height) = (&self.problem.goals[0], self.args.height);
        self.placed = Some(pleach::place_at_full_size(&tree, foliage, goals, view, height));
        Ok(())
    }
}

impl Drawn {
    /// Writes the silhouette, of the size and in the frame of the goal's file, and the same over the goal in two
    /// colours, with the margins that are compared.
    pub(super) fn write_silhouettes(&self, goal: &Bitmap, best: &Path, overlay: &Path) -> anyhow::Result<()> {
        let silhouette = self.original.as_ref().unwrap_or(&self.bitmap);
        files::write_whole(best, |file| Ok(silhouette.write_png(file)?))?;
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
