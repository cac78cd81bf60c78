//! A tree's readings beside what it is.

use super::ciede2000::difference;
use super::pictures::Drawn;
use super::trees::Case;
use crate::record::Fixed;
use pleach_reading::{Colors, Reader, Reading};
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::{Parts, Tree};
use serde::{Deserialize, Serialize};

/// A layer is judged where this part of the tree's pixels is in it.
const MIN_SHARE: f64 = 0.03;
/// What is seen of a tree's truth, from this confidence on.
const SEEN: f64 = 0.5;

/// A tree, what was read in its pictures, and what is true. Lengths are in heights of the tree, angles in degrees.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub(super) struct Read {
    /// Number of the tree, from 1.
    pub(super) tree: usize,
    pub(super) family: String,
    pub(super) species: String,
    pub(super) seed: u64,
    /// How it was leaned.
    pub(super) leaned: Fixed<1>,
    pub(super) stems: usize,
    /// Whether it was grown with leaves.
    pub(super) leafy: bool,
    /// Longer side of the silhouette in pixels.
    pub(super) size: u32,
    pub(super) feet: usize,
    pub(super) true_feet: usize,
    /// Whether a person can see the feet: no foliage hides them.
    pub(super) feet_seen: bool,
    pub(super) feet_confidence: Fixed<2>,
    pub(super) width: Fixed<4>,
    pub(super) true_width: Fixed<4>,
    pub(super) width_confidence: Fixed<2>,
    pub(super) lean: Option<Fixed<1>>,
    pub(super) true_lean: Option<Fixed<1>>,
    pub(super) lean_confidence: Fixed<2>,
    pub(super) bare: Option<Fixed<3>>,
    pub(super) true_bare: Option<Fixed<3>>,
    pub(super) bare_confidence: Fixed<2>,
    pub(super) fork: Option<Fixed<3>>,
    pub(super) true_fork: Option<Fixed<3>>,
    /// Whether a person can see the fork.
    pub(super) fork_seen: bool,
    pub(super) fork_confidence: Fixed<2>,
    pub(super) true_leaves: bool,
    /// Whether leaves that there are can be told: not where they are a few specks.
    pub(super) leaves_seen: bool,
    /// From the silhouette.
    pub(super) leaves: bool,
    pub(super) leaves_confidence: Fixed<2>,
    /// From the colours.
    pub(super) color_leaves: Option<bool>,
    pub(super) color_leaves_confidence: Fixed<2>,
    pub(super) season: String,
    pub(super) true_season: String,
    /// Intersection over union of the layer of wood, and of limbs of at least three pixels.
    pub(super) wood_iou: Option<Fixed<3>>,
    pub(super) limb_iou: Option<Fixed<3>>,
    pub(super) foliage_iou: Option<Fixed<3>>,
    pub(super) layers_confidence: Fixed<2>,
    /// CIEDE2000 from the colour of the leaves themselves.
    pub(super) leaf_difference: Option<Fixed<1>>,
    pub(super) leaf_confidence: Fixed<2>,
    pub(super) bark_difference: Option<Fixed<1>>,
    pub(super) bark_confidence: Fixed<2>,
}

impl Read {
    /// Reads the pictures of `case`, tree number `number` of `family`; `None` if it does not grow or has no foot.
    pub(super) fn new(number: usize, family: &str, case: &Case, reader: &mut Reader) -> Option<Self> {
        let tree = case.grow()?;
        let (picture, truth) = silhouette(case, &tree);
        let mut reading = Reading::default();
        reader.read(&picture, &mut reading);
        let _ = truth.feet.first()?;
        let drawn = Drawn::new(case, tree)?;
        let colors = Colors::read(&drawn.photo, &drawn.tree).ok()?;
        let widest = |r: &Reading| r.feet.iter().map(|foot| foot.width).fold(0.0, f64::max);
        let season = |season: Option<pleach_tree::Season>| season.map_or("", pleach_tree::Season::name);
        let read = Self {
            tree: number,
            family: family.to_owned(),
            species: case.name.clone(),
            seed: case.seed,
            leaned: Fixed(case.lean),
            stems: case.stems,
            leafy: case.parts == Parts::LEAFY,
            size: case.size,
            feet: reading.feet.len(),
            true_feet: truth.feet.len(),
            feet_seen: truth.feet_confidence > SEEN,
            feet_confidence: Fixed(reading.feet_confidence),
            width: Fixed(widest(&reading)),
            true_width: Fixed(widest(&truth)),
            width_confidence: Fixed(reading.width_confidence),
            lean: reading.lean_deg.map(Fixed),
            true_lean: truth.lean_deg.map(Fixed),
            lean_confidence: Fixed(reading.lean_deg_confidence),
            bare: reading.bare_height.map(Fixed),
            true_bare: truth.bare_height.map(Fixed),
            bare_confidence: Fixed(reading.bare_height_confidence),
            fork: reading.first_fork.map(Fixed),
            true_fork: truth.first_fork.map(Fixed),
            fork_seen: truth.first_fork.is_some() && truth.first_fork_confidence > SEEN,
            fork_confidence: Fixed(reading.first_fork_confidence),
            true_leaves: truth.leaves,
            leaves_seen: truth.leaves_confidence > SEEN,
            leaves: reading.leaves,
            leaves_confidence: Fixed(reading.leaves_confidence),
            color_leaves: colors.leaves,
            color_leaves_confidence: Fixed(colors.leaves_confidence),
            season: season(colors.season).to_owned(),
            true_season: season(Some(drawn.season)).to_owned(),
            layers_confidence: Fixed(colors.layers_confidence),
            leaf_confidence: Fixed(colors.leaf_confidence),
            bark_confidence: Fixed(colors.bark_confidence),
            ..Self::default()
        };
        Some(read.with_layers(&drawn, &colors))
    }

    fn with_layers(mut self, drawn: &Drawn, colors: &Colors) -> Self {
        let all = drawn.tree.ink() as f64;
        let is_much = |layer: &Bitmap| layer.ink() as f64 >= MIN_SHARE * all;
        if is_much(&drawn.wood) {
            self.wood_iou = Some(Fixed(iou(&colors.wood, &drawn.wood)));
            self.bark_difference =
                Some(Fixed(colors.bark.map_or(100.0, |bark| difference(bark, drawn.bark))));
        }
        let limbs = opened(&drawn.wood);
        if is_much(&limbs) {
            // Twigs of one or two pixels count neither way.
            let found = limbs.intersection(&colors.wood) as f64;
            let missed = limbs.ink() as f64 - found;
            let wrong = colors.wood.intersection(&drawn.foliage) as f64;
            self.limb_iou = Some(Fixed(found / (found + missed + wrong).max(1.0)));
        }
        if is_much(&drawn.foliage) {
            self.foliage_iou = Some(Fixed(iou(&colors.foliage, &drawn.foliage)));
            self.leaf_difference =
                Some(Fixed(colors.leaf.map_or(100.0, |leaf| difference(leaf, drawn.leaf))));
        }
        self
    }

    /// Whether the number of feet is right.
    pub(super) const fn has_feet(&self) -> bool {
        self.feet == self.true_feet
    }

    /// Whether there are leaves, by silhouette and colours: what is more confident.
    pub(super) fn leaves_by_both(&self) -> bool {
        match self.color_leaves {
            Some(leaves) if self.color_leaves_confidence.0 > self.leaves_confidence.0 => leaves,
            _ => self.leaves,
        }
    }
}

/// The silhouette of `tree`, and the reading of its skeleton.
pub(super) fn silhouette(case: &Case, tree: &Tree) -> (Bitmap, Reading) {
    let frame = Frame::automatic(tree, &View::FRONT, case.parts, case.size, case.size);
    let truth = Reading::from_skeleton(tree, &View::FRONT, &frame, case.parts);
    let mut picture = Bitmap::default();
    Rasterizer::new().draw(tree, &View::FRONT, &frame, case.parts, &mut picture);
    (picture, truth)
}

fn iou(a: &Bitmap, b: &Bitmap) -> f64 {
    let both = a.intersection(b) as f64;
    both / (a.ink() as f64 + b.ink() as f64 - both).max(1.0)
}

/// What is left of a layer without all that is thinner than three pixels.
fn opened(layer: &Bitmap) -> Bitmap {
    let (width, height) = (layer.width(), layer.height());
    let around = |x: u32, y: u32| {
        let rows = y.saturating_sub(1)..(y + 2).min(height);
        rows.flat_map(move |v| (x.saturating_sub(1)..(x + 2).min(width)).map(move |u| (u, v)))
    };
    let eroded = Bitmap::from_fn(width, height, |x, y| around(x, y).all(|(u, v)| layer.get(u, v)));
    Bitmap::from_fn(width, height, |x, y| around(x, y).any(|(u, v)| eroded.get(u, v)))
}
