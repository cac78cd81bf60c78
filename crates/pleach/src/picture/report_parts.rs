//! What a report consists of, as data.

use pleach_fit::{FirstGuess, Identifiability, Interval, Runner};
use pleach_silhouette::Bitmap;
use pleach_silhouette::score::ScoreCard;
use pleach_tree::Species;
use serde::Serialize;

/// A known species that the goal was compared with.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LooksLike {
    /// Its name.
    pub species: String,
    /// How sure that is, in 0..=1.
    pub confidence: f64,
}

/// The goal's own tree.
#[derive(Clone, Debug, Serialize)]
pub struct IndividualReport {
    /// Stems with draws of their own.
    pub stems: usize,
    /// How well it matches the goal.
    #[serde(flatten)]
    pub scores: ScoreCard,
    /// Cost, by the objective `overlap`, of the tree that the search began with.
    pub cost_before: f64,
    /// The same of this tree.
    pub cost: f64,
    /// Trees grown.
    pub trees: u64,
    /// Single stems tried.
    pub trials: u64,
    /// The same per second.
    pub trials_per_second: f64,
    /// Time, in seconds.
    pub seconds: f64,
    /// How it does in the further pictures that were fitted.
    pub views: Vec<ViewReport>,
}

/// The result as the search and its history saw it: against the goal at its working size, the mean over views and over
/// the seeds of a robust fit.
#[derive(Clone, Debug, Serialize)]
pub struct SearchReport {
    /// Width in pixels.
    pub goal_width: u32,
    /// Height in pixels.
    pub goal_height: u32,
    /// Share of inked pixels. Fine twigs and leaves get thicker or thinner as a goal is reduced.
    pub goal_ink: f64,
    /// Intersection over union, in 0..=1.
    pub iou: f64,
    /// Share of equal pixels, in 0..=1.
    pub pixel_accuracy: f64,
}

/// How many of the free parameters the goal determines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct IdentifiabilityCounts {
    /// These it does.
    pub determined: usize,
    /// These loosely.
    pub loosely: usize,
    /// These it does not show.
    pub not_seen: usize,
    /// These were not tried, because time was short.
    pub not_tried: usize,
}

/// How well the goal determines a parameter.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParameterReport {
    /// Its slot.
    pub slot: String,
    /// Its value.
    pub value: f64,
    /// Whether the goal determines it: by [`Self::shrunk`] where that is known, and else by moves of this number alone.
    pub seen: Identifiability,
    /// By how much a picture makes the variance of this number smaller, in 0..=1, over trees around the species of
    /// [`IntervalsReport`]; `None` for numbers that do not vary there.
    pub shrunk: Option<f64>,
    /// Nine times in ten the number of such a tree is in it, since the picture was seen; `None` also where the goal is
    /// not like a picture of such a tree.
    pub interval: Option<Interval>,
    /// The same before the picture was seen.
    pub before: Option<Interval>,
}

/// What the intervals of the parameters are learnt from: trees around a species.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct IntervalsReport {
    /// The species.
    pub species: String,
    /// The share of those trees whose pictures are at least as strange as the goal is, in 0..=1.
    pub familiarity: f64,
    /// Whether the goal is like a picture of such a tree; where it is not, there are no intervals.
    pub is_familiar: bool,
}

/// A grammar that was found.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct RulesReport {
    /// The grammar.
    pub grammar: String,
    /// Its words and signs.
    pub grammar_length: usize,
}

/// How a tree does in a further picture.
#[derive(Clone, Debug, Serialize)]
pub struct ViewReport {
    /// The picture, as the options name it.
    pub file: String,
    /// The direction in degrees, as found.
    pub azimuth: f64,
    /// Degrees above the horizon.
    pub elevation: f64,
    /// Factor on the picture's metres per pixel, as found.
    pub scale: f64,
    /// How far the trunk's foot is to the right of where the picture says, in its widths, and below it, in its heights,
    /// as found.
    pub offset: [f64; 2],
    /// How well the tree matches it.
    #[serde(flatten)]
    pub scores: ScoreCard,
    /// Whether the azimuth was searched.
    #[serde(skip)]
    pub azimuth_found: bool,
    /// Its silhouette in the picture, of the size of the picture as it is compared.
    #[serde(skip)]
    pub silhouette: Bitmap,
}

/// Species with less confidence than this are left out.
const MIN_CONFIDENCE: f64 = 0.05;

impl LooksLike {
    /// The species of a first guess.
    #[must_use]
    pub fn from_guess(guess: Option<&FirstGuess>) -> Vec<Self> {
        let names = guess.into_iter().flat_map(|guess| &guess.names);
        names
            .filter(|(_, confidence)| *confidence >= MIN_CONFIDENCE)
            .map(|(species, confidence)| Self { species: species.clone(), confidence: *confidence })
            .collect()
    }
}

impl IdentifiabilityCounts {
    pub(super) fn new(parameters: &[ParameterReport]) -> Self {
        let count = |seen| parameters.iter().filter(|parameter| parameter.seen == seen).count();
        Self {
            determined: count(Identifiability::Determined),
            loosely: count(Identifiability::Loosely),
            not_seen: count(Identifiability::NotSeen),
            not_tried: count(Identifiability::NotTried),
        }
    }
}

impl RulesReport {
    pub(super) fn new(species: &Species) -> Option<Self> {
        let variation = species.generator.variation()?;
        let grammar = variation.own();
        Some(Self { grammar_length: variation.length(&grammar), grammar })
    }
}

/// The families of generators that a goal was compared with, the best of each, best first; empty if there is only one.
#[must_use]
pub fn best_of_each_family(guess: Option<&FirstGuess>) -> Vec<Runner> {
    let mut best: Vec<Runner> = Vec::new();
    for runner in guess.into_iter().flat_map(|guess| &guess.runners) {
        if best.iter().all(|known| known.family != runner.family) {
            best.push(runner.clone());
        }
    }
    if best.len() < 2 { Vec::new() } else { best }
}
