//! From a photograph of a tree to its silhouette, by classical means.
//!
//! 1. A picture whose alpha channel cuts something out is its own mask, and so is one of two tones. A frame
//!    and corners that were made transparent are left out.
//! 2. The horizon is where colours step at the picture's sides, if they do. Unless the background is said to
//!    be plain or a sky, no horizon, a clear and a faint one are tried, and the most confident mask is taken.
//!    If that is still doubtful, so are what has other colours than all of the picture's edges, and what a graph cut
//!    finds in boxes that are guessed (`guess.rs`).
//! 3. What the background looks like is read off the picture's frame, above and below the horizon,
//!    and continued behind the tree; colours are compared in Oklab.
//! 4. What is farther from it than Otsu's threshold on that distance, and than half of what is usual
//!    for the tree around, stands out.
//!    What has the ground's hue, is darker, wide and flat, and lies low is the tree's shadow (`shadow.rs`).
//! 5. Specks go. Of the pieces that are left, those near to each other belong together: leaves that
//!    hang apart from the crown are tree. The largest is the tree, or the one at the seed point.
//! 6. Small holes are filled, such as glints on leaves; the sky between leaves stays.
//!
//! It takes an even background: sky, clouds, haze, a wall. Before houses and other trees it finds what differs
//! from them in colour, and says that it is doubtful. There a person may show the tree by a box around it, or by points
//! and strokes: a graph cut then takes the place of steps 2 to 4 (`cut.rs`, `refine.rs`).

mod backdrop;
mod boxed;
mod clear_sky;
mod colors;
mod confidence;
mod cut;
mod error;
mod ground;
mod guess;
mod horizon;
mod max_flow;
mod mixture;
mod oklab;
mod photo;
mod pixel_box;
mod prepare;
mod reduced;
mod refine;
mod region;
#[cfg(test)]
mod region_tests;
mod score;
mod shadow;
#[cfg(test)]
mod tests;
mod trunk;

pub use error::MaskError;
pub use horizon::Horizon;
pub use photo::Photo;
pub use pixel_box::PixelBox;
pub use region::Stroke;

use crate::bitmap::Bitmap;
use crate::goal::{GoalWarning, border, shape};
use crate::picture::{MISSED, Picture};
use crate::pieces;
pub use crate::touches::Touches;
use boxed::Boxed;
use confidence::Evidence;
use cut::{Cut, Seeds};
use oklab::Converter;
use prepare::Prepared;
use region::Shown;
use score::{Foreground, foregrounds};

/// What is behind the tree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Background {
    /// Whichever of a sky with a ground below it and one background gives the more confident mask.
    #[default]
    Auto,
    /// A sky, probably with a ground below it: a faint step at the sides is a horizon, too.
    Sky,
    /// One smooth background all around, as a wall or a cloth.
    Plain,
}

/// What an alpha channel is taken for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum AlphaUse {
    /// The mask, unless what is transparent is not the background: corners of a picture that was turned, say.
    #[default]
    Auto,
    /// Nothing. The colours of what is transparent are looked at as all others are.
    Ignore,
}

/// How a mask is made.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MaskOptions {
    /// What is behind the tree.
    pub background: Background,
    /// What an alpha channel is taken for.
    pub alpha: AlphaUse,
    /// A pixel on the tree: column from the left and row from the top, from 0. The largest piece is
    /// the tree if it is not given.
    pub seed_point: Option<(u32, u32)>,
    /// Most pixels of a hole that is filled; 1 of 100,000 of the picture's if it is not given.
    pub fill_holes: Option<u64>,
    /// A box that all of the tree is in, as a person drags it. What is outside is background, and tree and
    /// background inside are separated by a graph cut; `background` does not count then.
    pub region: Option<PixelBox>,
    /// What is tree, for the graph cut. Without a region, all of the picture is looked at.
    pub include: Vec<Stroke>,
    /// What is not tree, for the graph cut. What is both included and excluded is excluded.
    pub exclude: Vec<Stroke>,
}

/// How tree and background were separated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Segmentation {
    /// The tree is what is at least half opaque, or the hole in it.
    Opacity,
    /// The picture has two tones, and the tree is the one that the picture's edge does not have.
    TwoTones,
    /// The tree is what differs in colour.
    Color {
        /// Distance that all of the tree has from the background, in spreads of that.
        threshold: f64,
        /// Where the ground begins, if it was seen.
        horizon: Option<Horizon>,
    },
    /// The tree is what is in the middle and has other colours than the picture's edges.
    Colors,
    /// The tree is what a graph cut finds in a box.
    Cut {
        /// The box, dragged by a person or guessed.
        region: PixelBox,
    },
}

/// A tree in a photograph.
#[derive(Clone, Debug, PartialEq)]
pub struct Mask {
    /// The tree as ink, of the photograph's size.
    pub bitmap: Bitmap,
    /// How tree and background were separated.
    pub segmentation: Segmentation,
    /// Pixels that stood out and were not taken for tree.
    pub dropped: u64,
    /// Pixels of holes that were filled.
    pub filled: u64,
    /// Where the crown is cut off by the picture's edge.
    pub touches: Touches,
    /// How likely the mask is a good one, in 0..=1, to sort masks by: those below 0.45 want a look.
    ///
    /// It falls with what would be tree or not if the least distance from the background were a little
    /// other, with what else stood out, with how much of the picture's edge is tree, more so if that is both
    /// the left and the right one, and with a foot that is wide as a hill's. Of an alpha channel, what counts as the least distance is half opaque, and a foot
    /// may be as wide as it likes. Of a box, it is how far the tree's colours are its own, whether it spills out to the
    /// sides of the box, and how fine its outline is.
    pub confidence: f64,
    /// What about the mask is not as a fit expects, as of a goal.
    pub warnings: Vec<GoalWarning>,
}

/// Pixels of the picture to one of the smallest piece that is kept.
const SPECK: u64 = 200_000;
/// Pixels of the picture to one of the largest hole that is filled.
const HOLE: u64 = 100_000;
/// Pieces nearer than this part of the shorter side belong together.
const NEAR: f64 = 0.015;
/// Pixels of the picture to one of the smallest tree.
const SMALLEST: u64 = 1_000;
/// Trees are at least this part of the picture's height.
const LOWEST: f64 = 0.1;
/// What covers more than this part of the picture is not a tree before a background.
const MAX_INK: f64 = 0.9;

impl Mask {
    /// Finds the tree.
    ///
    /// ```
    /// use pleach_silhouette::mask::{Mask, MaskOptions, Photo};
    ///
    /// // A brown trunk before a blue sky.
    /// let photo = Photo::from_fn(60, 60, |x, y| {
    ///     if (25..35).contains(&x) && y > 10 { [90, 60, 30, 255] } else { [120, 170, 230, 255] }
    /// });
    /// let mask = Mask::from_photo(&photo, &MaskOptions::default())?;
    /// assert!(mask.bitmap.get(30, 40) && !mask.bitmap.get(5, 5));
    /// # Ok::<(), pleach_silhouette::mask::MaskError>(())
    /// ```
    ///
    /// # Errors
    /// See [`MaskError`]: no tree, or a seed point that is not on one.
    pub fn from_photo(photo: &Photo, options: &MaskOptions) -> Result<Self, MaskError> {
        let (width, height) = (photo.width(), photo.height());
        if let Some((x, y)) = options.seed_point
            && (x >= width || y >= height)
        {
            return Err(MaskError::SeedOutside { x, y, width, height });
        }
        let shown = Shown::new(photo, options.region, &options.include, &options.exclude)?;
        let prepared = Prepared::new(photo, options.alpha);
        let mut made = match (prepared.foreground, &shown) {
            (Some(foreground), _) => Self::from_foreground(foreground)?,
            (None, Some(shown)) => Self::from_cut(&prepared.photo, shown, options)?,
            (None, None) => Self::most_confident(&prepared.photo, options)?,
        };
        let said = said(&made.bitmap, photo, prepared.warnings, made.confidence);
        made.warnings = said;
        if let Some(inside) = &prepared.inside {
            made.bitmap = border::within(&made.bitmap, inside);
            made.touches = touches(&made.bitmap);
            check(&made.bitmap)?;
        }
        Ok(made)
    }

    /// A mask that the picture itself has.
    fn from_foreground(foreground: Foreground) -> Result<Self, MaskError> {
        if foreground.segmentation == Segmentation::TwoTones {
            check(&foreground.ink)?;
        }
        let evidence = Evidence::new(&foreground.ink, &foreground);
        Ok(Self {
            touches: touches(&foreground.ink),
            warnings: Vec::new(),
            bitmap: foreground.ink,
            segmentation: foreground.segmentation,
            dropped: 0,
            filled: 0,
            confidence: evidence.of_a_cutout().confidence(),
        })
    }

    /// The best mask by colour. Of equals the one with the clearest horizon. Where one way finds no tree, a
    /// doubtful mask by another is none, either: before a meadow without a tree, the meadow stands out.
    fn most_confident(photo: &Photo, options: &MaskOptions) -> Result<Self, MaskError> {
        let mut best: Option<Self> = None;
        let mut failed = None;
        for foreground in foregrounds(photo, options.background) {
            match foreground.and_then(|foreground| Self::by_color(&foreground, options)) {
                Ok(mask) if best.as_ref().is_none_or(|b| mask.confidence > b.confidence) => best = Some(mask),
                Ok(_) => {}
                Err(error) => failed = failed.or(Some(error)),
            }
        }
        if failed.is_some() {
            best = best.filter(|mask| mask.confidence >= DOUBTFUL);
        }
        if options.background == Background::Auto && best.as_ref().is_none_or(|b| b.confidence < DOUBTFUL) {
            let colors = colors::foreground(photo).and_then(|found| Self::by_color(&found, options).ok());
            // A tree that nothing else sees is not made up of an empty lawn.
            let colors = colors.filter(|mask| mask.confidence > LEAST);
            let is_seen = best.is_some() || colors.is_some();
            let guess = best.iter().chain(&colors).find_map(|mask| guess::around(&mask.bitmap, photo));
            let by_colors = colors.as_ref().map_or(0.0, |mask| mask.confidence);
            // Each with what it is chosen by.
            let mut all: Vec<(f64, Self)> = best.into_iter().map(|mask| (mask.confidence, mask)).collect();
            for region in [guess::middle(photo)].into_iter().chain(guess).filter(|_| is_seen) {
                if let Ok((mask, _)) =
                    Self::from_seeds(photo, &Seeds::guessed(region, photo), options, Evidence::confidence)
                {
                    let (score, confidence) = guess::score(mask.confidence, &mask.bitmap, &region, by_colors);
                    all.push((score, Self { confidence, ..mask }));
                }
            }
            let confidence = BY_COLORS * by_colors;
            all.extend(colors.map(|mask| (confidence, Self { confidence, ..mask })));
            best = all.into_iter().max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, mask)| mask);
        }
        let none = MaskError::NoTree { why: "nothing stands out from the background" };
        best.ok_or_else(|| failed.unwrap_or(none))
    }

    /// The tree in a box or under strokes.
    fn from_cut(photo: &Photo, shown: &Shown, options: &MaskOptions) -> Result<Self, MaskError> {
        let (made, cut) = Self::from_seeds(photo, &Seeds::shown(shown, photo), options, Evidence::firm)?;
        let confidence = Boxed::new(&cut, &made.bitmap).confidence(made.confidence);
        Ok(Self { confidence, ..made })
    }

    /// The tree that a cut finds, with what `judge` makes of the evidence, and the cut.
    fn from_seeds(
        photo: &Photo,
        seeds: &Seeds<'_>,
        options: &MaskOptions,
        judge: impl Fn(Evidence) -> f64,
    ) -> Result<(Self, Cut), MaskError> {
        let none = MaskError::NoTree { why: "nothing in the box differs from what is around it" };
        let converter = Converter::new();
        let cut = Cut::new(photo, &converter, seeds).ok_or(none)?;
        let foreground = refine::refined(photo, &converter, &cut, seeds);
        let made = Self::with_pieces(&foreground, options, seeds.include, judge)?;
        Ok((made, cut))
    }

    fn by_color(foreground: &Foreground, options: &MaskOptions) -> Result<Self, MaskError> {
        Self::with_pieces(foreground, options, None, Evidence::confidence)
    }

    /// The largest piece, and all that were marked, with what `judge` makes of the evidence.
    fn with_pieces(
        foreground: &Foreground,
        options: &MaskOptions,
        marked: Option<&Bitmap>,
        judge: impl Fn(Evidence) -> f64,
    ) -> Result<Self, MaskError> {
        let (width, height) = (foreground.ink.width(), foreground.ink.height());
        let ink = pieces::without_specks(&foreground.ink, foreground.ink.area() / SPECK);
        let near = (NEAR * f64::from(width.min(height)) / 2.0).round() as u32;
        let grounds = pieces::widened(&ink, near);
        let tree = pieces::piece(&ink, &grounds, options.seed_point);
        let mut bitmap = match (tree, options.seed_point) {
            (Some(tree), _) => tree,
            (None, Some((x, y))) => return Err(MaskError::SeedOnBackground { x, y }),
            (None, None) => return Err(MaskError::NoTree { why: "nothing stands out from the background" }),
        };
        if let Some(marked) = marked {
            bitmap.unite(&pieces::pieces_at(
                &foreground.ink,
                &pieces::widened(&foreground.ink, near),
                marked,
            ));
        }
        let dropped = foreground.ink.ink() - bitmap.ink();
        check(&bitmap)?;
        let largest = options.fill_holes.unwrap_or(bitmap.area() / HOLE);
        let filled = pieces::fill_holes(&mut bitmap, largest);
        let confidence = judge(Evidence::new(&bitmap, foreground));
        Ok(Self {
            touches: touches(&bitmap),
            warnings: Vec::new(),
            bitmap,
            segmentation: foreground.segmentation,
            dropped,
            filled,
            confidence,
        })
    }

    /// The photograph with all but the tree faded, and the tree's outline drawn in.
    #[must_use]
    pub fn overlay(&self, photo: &Photo) -> Picture {
        let mut out = Picture::new(photo.width(), photo.height());
        for y in 0..photo.height() {
            for x in 0..photo.width() {
                let color = photo.rgb(x, y);
                let ink = |dx, dy| match (x.checked_add_signed(dx), y.checked_add_signed(dy)) {
                    (Some(x), Some(y)) => self.bitmap.get(x, y),
                    _ => false,
                };
                let beside = || ink(-1, 0) || ink(1, 0) || ink(0, -1) || ink(0, 1);
                let shown = if self.bitmap.get(x, y) {
                    color
                } else if beside() {
                    MISSED
                } else {
                    color.map(|v| 170 + v / 3)
                };
                out.set(x, y, shown);
            }
        }
        out
    }
}

/// Whether it can be a tree at all.
fn check(ink: &Bitmap) -> Result<(), MaskError> {
    let no_tree = |why| Err(MaskError::NoTree { why });
    let Some((_, top, _, bottom)) = ink.ink_box() else {
        return no_tree("nothing stands out from the background");
    };
    let tall = f64::from(bottom + 1 - top) / f64::from(ink.height());
    if ink.ink() * SMALLEST < ink.area() || tall < LOWEST {
        return no_tree("what stands out from the background is too small");
    }
    if ink.ink() as f64 > MAX_INK * ink.area() as f64 {
        return no_tree("nearly all of the picture differs from its frame");
    }
    Ok(())
}

/// Masks of less confidence are called doubtful.
const DOUBTFUL: f64 = 0.45;

/// Of masks by other colours than the edges', this part of the confidence is reported: they are seldom wholly right.
const BY_COLORS: f64 = 0.5;
/// Where no other way finds a tree, they need more than this; before an empty lawn they have nothing.
const LEAST: f64 = 0.05;

/// What is to be said of a mask, beside what was done to its picture.
fn said(ink: &Bitmap, photo: &Photo, treated: Vec<GoalWarning>, confidence: f64) -> Vec<GoalWarning> {
    let mut warnings = Vec::new();
    if photo.has_further() {
        warnings.push(GoalWarning::SeveralPictures);
    }
    warnings.extend(treated);
    warnings.extend(shape::warnings(ink));
    if confidence < DOUBTFUL {
        warnings.push(GoalWarning::DoubtfulMask { confidence });
    }
    warnings
}

fn touches(ink: &Bitmap) -> Touches {
    let column = |x| (0..ink.height()).any(|y| ink.get(x, y));
    Touches {
        left: column(0),
        top: ink.ink_in_row(0).next().is_some(),
        right: column(ink.width().saturating_sub(1)),
    }
}
