//! Trees of a fit, grown and drawn as its goal is.

use super::prepared::Prepared;
use super::report_parts::ViewReport;
use super::words::AppearanceFrom;
use pleach_fit::{FitProblem, Genome, Placement};
use pleach_reading::Reading;
use pleach_silhouette::score::ScoreCard;
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::param::SlotError;
use pleach_tree::{Foliage, GrowError, Growth, Limits, Species, Tree};

/// A tree that a fit has found.
#[derive(Clone, Debug)]
pub struct FittedTree {
    /// Its species, with its seed: [`Species::grow`] with it grows the tree.
    pub species: Species,
    /// Its scores against the goal.
    pub scores: ScoreCard,
    /// What is read in its silhouette; how much of it is foliage is known of it.
    pub measures: Reading,
    /// Its silhouette, of the size and in the frame of [`super::GoalPair::full`].
    pub silhouette: Bitmap,
    /// Its silhouette of the size and in the frame of the goal's file, where that is another.
    pub original: Option<Bitmap>,
    /// How it does in the further pictures that were fitted.
    pub views: Vec<ViewReport>,
}

impl FittedTree {
    /// The silhouette of the size and in the frame of the goal's file.
    #[must_use]
    pub fn over_file(&self) -> &Bitmap {
        self.original.as_ref().unwrap_or(&self.silhouette)
    }
}

/// Grows and draws trees of one fit as its goal is.
#[derive(Clone, Debug)]
pub struct FitDrawing<'a> {
    /// The fit.
    pub prepared: &'a Prepared,
    /// What is fitted, from the species that the search started from.
    pub problem: FitProblem,
    /// Bounds on the size of a tree.
    pub limits: Limits,
    /// Where the tree stands in each picture at its own size, against the frame that was read off it: the goal first.
    pub placements: Vec<Placement>,
}

impl Prepared {
    /// Draws trees of `problem`: that of a [`pleach_fit::PreparedSearch`] or a [`pleach_fit::Fitted`], in frames as they are
    /// known there.
    #[must_use]
    pub fn drawing(&self, problem: &FitProblem, limits: Limits) -> FitDrawing<'_> {
        let placements = problem.goals.iter().map(|goal| goal.registered).collect();
        FitDrawing { prepared: self, problem: problem.clone(), limits, placements }
    }

    /// A species of the fit as it is given back: with the name of the result, and the colours of the goal's picture
    /// where these were asked for.
    #[must_use]
    pub fn named(&self, species: Species) -> Species {
        let appearance = match (&self.reading.colors, self.options.appearance) {
            (Some(colors), AppearanceFrom::Picture) => colors.appearance(&species.appearance),
            _ => species.appearance,
        };
        Species { name: self.name.clone(), description: String::new(), appearance, ..species }
    }
}

impl FitDrawing<'_> {
    /// The species that `genome` is.
    ///
    /// # Errors
    /// A value that the generator does not allow: not of a genome of the same fit.
    pub fn species(&self, genome: &Genome) -> Result<Species, SlotError> {
        Ok(self.prepared.named(self.problem.species(genome)?))
    }

    /// The tree of a species by its own seed.
    ///
    /// # Errors
    /// If it is larger than the limits of the fit.
    pub fn grow(&self, species: &Species) -> Result<Tree, GrowError> {
        let seed = species.tree_seed.unwrap_or(1);
        let growth = Growth { limits: self.limits, foliage: self.problem.foliage, ..Growth::seed(seed) };
        species.grow_with(&growth)
    }

    /// The frame of the goal at its own size.
    #[must_use]
    pub fn frame(&self) -> Frame {
        let Prepared { goal, height, .. } = self.prepared;
        self.placements.first().copied().unwrap_or(Placement::KNOWN).frame(&goal.full.frame(*height))
    }

    /// `tree` as the goal is compared, and in the frame of the goal's file where that is another.
    #[must_use]
    pub fn silhouettes(&self, tree: &Tree) -> (Bitmap, Option<Bitmap>) {
        let (full, frame) = (&self.prepared.goal.full, self.frame());
        let silhouette = self.draw(tree, &self.prepared.view, &frame);
        let original =
            (!full.is_whole()).then(|| self.draw(tree, &self.prepared.view, &full.original_frame(&frame)));
        (silhouette, original)
    }

    /// What is in `silhouette`, a picture of `tree`.
    pub(super) fn measures(&self, tree: &Tree, silhouette: &Bitmap) -> Reading {
        let mut reading = Reading::from_silhouette(silhouette);
        let (mut stems, all) = (Bitmap::default(), silhouette.ink() as f64);
        Rasterizer::new().draw(tree, &self.prepared.view, &self.frame(), Foliage::None.into(), &mut stems);
        let share = if all > 0.0 { (1.0 - stems.ink() as f64 / all).max(0.0) } else { 0.0 };
        (reading.foliage_share, reading.foliage_share_confidence) = (Some(share), 1.0);
        reading
    }

    /// `tree` from `view` in `frame`.
    #[must_use]
    pub fn draw(&self, tree: &Tree, view: &View, frame: &Frame) -> Bitmap {
        let mut bitmap = Bitmap::default();
        Rasterizer::new().draw(tree, view, frame, self.problem.foliage.into(), &mut bitmap);
        bitmap
    }
}
