//! From colours to the table `[appearance]` of a result.

use super::Colors;
use pleach_plant::{Appearance, BarkPattern, Color, Season};

/// What is read with less confidence than this is left as it was.
const MIN_CONFIDENCE: f64 = 0.5;
/// What palettes mix spring's leaves with, and how much of it.
const YOUNG_LEAF: Color = Color::from_hex(0xa8_c6_4e);
const YOUNG: f32 = 0.45;
/// A bark whose channels add up to less than this is not a pale one with dark dashes.
const PALE: u32 = 330;

impl Colors {
    /// The same of a tree in leaf whose leaves have the colours of wood, as its silhouette shows with `confidence` (0..=1):
    /// it is autumn.
    #[must_use]
    pub fn in_brown_leaf(self, confidence: f64) -> Self {
        Self {
            leaf: self.leaf.or(self.bark),
            leaf_confidence: confidence,
            season: Some(Season::Autumn),
            season_confidence: confidence,
            leaves: Some(true),
            leaves_confidence: confidence,
            ..self
        }
    }

    /// The appearance of the tree in the photograph: `start` with all that was read with confidence in its place.
    ///
    /// The season is set so that pictures show these colours: leaves that have turned are `autumn`, others `leaf`, and
    /// a tree that has turned or is bare is not an evergreen. Spring's pictures make leaves younger, which is taken
    /// off `leaf` first. The pattern of the bark stays, but that dark bark is not banded as a birch's.
    #[must_use]
    pub fn appearance(&self, start: &Appearance) -> Appearance {
        let mut out = *start;
        if let Some(bark) = self.bark.filter(|_| self.bark_confidence >= MIN_CONFIDENCE) {
            out.bark = Some(bark);
            let is_dark = bark.0.iter().map(|&v| u32::from(v)).sum::<u32>() < PALE;
            if is_dark && out.bark_pattern == Some(BarkPattern::Banded) {
                out.bark_pattern = Some(BarkPattern::Furrowed);
            }
        }
        if let Some(blossom) = self.blossom.filter(|_| self.blossom_confidence >= MIN_CONFIDENCE) {
            out.blossom = Some(blossom);
        }
        let season = self.season.filter(|_| self.season_confidence >= MIN_CONFIDENCE);
        let leaf = self.leaf.filter(|_| self.leaf_confidence >= MIN_CONFIDENCE);
        out.season = season.or(start.season);
        match season {
            Some(Season::Winter) => out.evergreen = Some(false),
            Some(Season::Autumn) => {
                out.evergreen = Some(false);
                out.autumn = leaf.or(start.autumn);
            }
            Some(Season::Spring) if !out.evergreen.unwrap_or(false) => {
                out.leaf = leaf.map(grown).or(start.leaf);
            }
            _ => out.leaf = leaf.or(start.leaf),
        }
        out
    }
}

/// The leaf of summer that is shown as `young` in spring, as near as there is one.
fn grown(Color(young): Color) -> Color {
    let channel = |i: usize| {
        let v = (f32::from(young[i]) - YOUNG * f32::from(YOUNG_LEAF.0[i])) / (1.0 - YOUNG);
        v.round().clamp(0.0, 255.0) as u8
    };
    Color([channel(0), channel(1), channel(2)])
}
