//! From a photograph and its mask to layers and colours.
//!
//! 1. The tree is reduced to 512 cells a side. Pixels that touch the background count only where there are no others
//!    ([`grid`]).
//! 2. A picture without colours has no layers: black ink, greys.
//! 3. Trunks are followed from the foot up while they stay about as wide ([`trunk`]). Their colours are what wood looks
//!    like in this picture, unless they are those of foliage. Without a trunk, wood looks as bark mostly does.
//! 4. The tree is leafy if enough of the rest is green, yellow to red, white or pink beside that wood, or if it is
//!    thicker than limbs are ([`evidence`]). White that lies on limbs with nothing above it is snow. A bare tree is all
//!    wood.
//! 5. What foliage looks like is fitted to the rest ([`mixture`]), and each cell is more like one or the other, in hue
//!    per lightness, which shade leaves unchanged.
//! 6. Wood is what is likely wood along a line, and hangs together with the trunk or over a length ([`lines`]). The
//!    rest is foliage, but for the sky's colour, which is neither.
//! 7. Colours are medians of the layers ([`tones`]); the season follows from them ([`season`]).
//!
//! Snow on an evergreen is taken for blossom, and fruit for foliage.

mod appearance;
mod evidence;
mod flat;
mod grid;
mod layers;
mod lines;
mod mixture;
mod oklab;
mod season;
mod statistics;
#[cfg(test)]
mod tests;
mod tones;
mod trunk;
mod words;

use crate::error::ReadingError;
use grid::Grid;
use layers::{Kind, Layers};
use pleach_plant::{Color, Season};
use pleach_silhouette::Bitmap;
use pleach_silhouette::mask::Photo;
use serde::{Deserialize, Serialize};
use statistics::ramp;
use tones::Tones;

/// The colours of a tree in a photograph, each with a confidence in 0..=1, and its layers.
///
/// What is not known is `None`, with a confidence of 0. The names of the fields are those of the JSON.
///
/// ```
/// use pleach_reading::Colors;
/// use pleach_silhouette::Bitmap;
/// use pleach_silhouette::mask::Photo;
///
/// let crown = |x: u32, y: u32| (30..70).contains(&x) && y < 60;
/// let trunk = |x: u32, y: u32| (46..54).contains(&x) && y >= 60;
/// let photo = Photo::from_fn(100, 100, |x, y| if crown(x, y) { [92, 131, 54, 255] } else { [107, 76, 48, 255] });
/// let tree = Bitmap::from_fn(100, 100, |x, y| crown(x, y) || trunk(x, y));
/// let colors = Colors::read(&photo, &tree)?;
/// assert_eq!(colors.leaves, Some(true));
/// assert_eq!(colors.leaf.map(|leaf| leaf.to_string()).as_deref(), Some("#5c8336"));
/// # Ok::<(), pleach_reading::ReadingError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Colors {
    /// Colour of the leaves themselves, for `[appearance]`: that of sunlit leaves as seen, less what sunlight does to
    /// its saturation. How bright the light was is unknown; it is taken to show sunlit leaves as light as they are.
    /// Of a smooth crown, as icons have, it is the median.
    #[serde(with = "words::color")]
    pub leaf: Option<Color>,
    /// Median colour of leaves, as seen.
    #[serde(with = "words::color")]
    pub leaf_typical: Option<Color>,
    /// Median colour of leaves in the sun, the lighter third, as seen.
    #[serde(with = "words::color")]
    pub leaf_sunlit: Option<Color>,
    /// Median colour of leaves in the shade, the darker third, as seen.
    #[serde(with = "words::color")]
    pub leaf_shaded: Option<Color>,
    /// Mean distance of the leaves' colours from the typical one, in Oklab.
    pub leaf_spread: Option<f64>,
    /// Confidence in the four colours of leaves.
    pub leaf_confidence: f64,
    /// Median colour of the trunk's bark as seen, or of all wood where no trunk was seen.
    #[serde(with = "words::color")]
    pub bark: Option<Color>,
    /// Confidence in the colour of bark.
    pub bark_confidence: f64,
    /// Colour of blossoms, the lighter third of them; `None` if there are none.
    #[serde(with = "words::color")]
    pub blossom: Option<Color>,
    /// Confidence in the colour of blossoms.
    pub blossom_confidence: f64,
    /// Autumn if leaves have turned, winter if there are none, spring with blossom, else summer.
    #[serde(with = "words::season")]
    pub season: Option<Season>,
    /// Confidence in the season.
    pub season_confidence: f64,
    /// Whether there are leaves or blossoms.
    pub leaves: Option<bool>,
    /// Confidence in whether there are.
    pub leaves_confidence: f64,
    /// Trunk and limbs that are seen, of the photograph's size; no pixel is in both layers. Not serialised.
    #[serde(skip)]
    pub wood: Bitmap,
    /// Leaves, blossoms and fruit. Not serialised.
    #[serde(skip)]
    pub foliage: Bitmap,
    /// Confidence in the two layers.
    pub layers_confidence: f64,
    /// Part of the tree's pixels that have the colour of their right and lower neighbours, 0..=1: below 0.1 in
    /// photographs, near 1 in drawings of flat colours; `None` of a picture without colours.
    pub flat_share: Option<f64>,
}

/// From this part of pixels of one colour with their neighbours on, a picture is a drawing. Of 41 cut-outs of photographs
/// none has more than 0.06; an icon has 0.87.
const DRAWN: f64 = 0.5;

impl Colors {
    /// Whether it is a drawing in flat colours and no photograph.
    #[must_use]
    pub fn is_drawn(&self) -> bool {
        self.flat_share.is_some_and(|share| share >= DRAWN)
    }

    /// Reads the part of `photo` that is `tree`; both are of one size. Pixels less than half opaque have no colour.
    ///
    /// # Errors
    /// [`ReadingError::MaskSize`] if photograph and mask differ in size.
    pub fn read(photo: &Photo, tree: &Bitmap) -> Result<Self, ReadingError> {
        let sizes = ((tree.width(), tree.height()), (photo.width(), photo.height()));
        if sizes.0 != sizes.1 {
            return Err(ReadingError::MaskSize { mask: sizes.0, photo: sizes.1 });
        }
        let mut colors = Self {
            wood: Bitmap::new(tree.width(), tree.height()),
            foliage: Bitmap::new(tree.width(), tree.height()),
            ..Self::default()
        };
        let Some(grid) = Grid::new(photo, tree) else { return Ok(colors) };
        let Some(layers) = Layers::new(&grid) else { return Ok(colors) };
        colors.flat_share = flat::flat_share(photo, tree);
        colors.wood = grid.layer(tree, |at| layers.kinds[at] == Kind::Wood);
        colors.foliage = grid.layer(tree, |at| layers.kinds[at] == Kind::Foliage);
        colors.read_wood(&grid, &layers);
        colors.read_foliage(&grid, &layers);
        colors.round();
        Ok(colors)
    }

    /// To thousandths: more would be noise, and these come back from JSON as they were.
    fn round(&mut self) {
        let thousandths = |value: &mut f64| *value = (1000.0 * *value).round() / 1000.0;
        self.leaf_spread.iter_mut().chain(&mut self.flat_share).for_each(thousandths);
        for confidence in [
            &mut self.leaf_confidence,
            &mut self.bark_confidence,
            &mut self.blossom_confidence,
            &mut self.season_confidence,
            &mut self.leaves_confidence,
            &mut self.layers_confidence,
        ] {
            thousandths(confidence);
        }
    }

    fn read_wood(&mut self, grid: &Grid, layers: &Layers) {
        let seen = Tones::new(grid, layers.trunk.iter().copied());
        let is_trunk = seen.is_some();
        let Some(bark) = seen.or_else(|| Tones::new(grid, layers.cells(Kind::Wood))) else { return };
        self.bark = Some(oklab::to_color(bark.typical));
        self.bark_confidence = ramp(4.0, 40.0, bark.count as f64) * if is_trunk { 0.9 } else { 0.4 };
        if layers.evidence.has_leaves() {
            // A trunk that looks as the leaves do may be leaves.
            self.bark_confidence *= ramp(0.4, 1.2, layers.evidence.apart);
        }
    }

    fn read_foliage(&mut self, grid: &Grid, layers: &Layers) {
        let evidence = &layers.evidence;
        self.leaves = Some(evidence.has_leaves());
        self.leaves_confidence = evidence.leaves_confidence();
        self.layers_confidence = evidence.layers_confidence();
        let parts = season::Parts::new(grid, layers);
        let (season, confidence) = season::season(parts, layers, self.leaves_confidence);
        (self.season, self.season_confidence) = (Some(season), confidence);
        let is_petal = |at: &usize| layers.wood.is_petal(grid.colors[*at]);
        let in_blossom = season == Season::Spring;
        let foliage = || layers.cells(Kind::Foliage);
        if let Some(leaf) = Tones::new(grid, foliage().filter(|at| !in_blossom || !is_petal(at))) {
            self.leaf = Some(oklab::to_color(leaf.albedo()));
            self.leaf_typical = Some(oklab::to_color(leaf.typical));
            self.leaf_sunlit = Some(oklab::to_color(leaf.sunlit));
            self.leaf_shaded = Some(oklab::to_color(leaf.shaded));
            self.leaf_spread = Some(leaf.spread);
            self.leaf_confidence = self.leaves_confidence * ramp(10.0, 120.0, leaf.count as f64);
            // Of a tree all in blossom, what is left are petals in the shade.
            self.leaf_confidence *= 1.0 - ramp(0.4, 0.8, parts.petals);
        }
        if in_blossom && let Some(blossom) = Tones::new(grid, foliage().filter(is_petal)) {
            self.blossom = Some(oklab::to_color(blossom.sunlit));
            self.blossom_confidence = confidence;
        }
    }
}
