//! Goal pictures: read, masked, painted over, and scored.

use crate::error::thrown;
use crate::tree::ink;
use pleach::{
    Anchor, Bitmap, Colors, Corrections, Encoded, FitOptions, FitSource, Goal as Read, GoalOptions,
    GoalWarning, Mask, MaskHints, MaskOptions, Photo, PictureReading, ScoreCard, read_picture,
};
use serde_json::json;
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;

/// Pixels of the longer side of the backdrop that is shown.
const SHOWN_SIDE: u32 = 2048;

/// A picture of a tree that parameters are to be found for.
#[wasm_bindgen]
pub struct Goal {
    name: String,
    /// The ink as it was read or painted, before specks are taken out.
    painted: Bitmap,
    places: Places,
    pub(crate) full: Read,
    /// How sure the mask is, where one was made.
    confidence: Option<f64>,
    /// What is to be said of the mask, where one was made.
    mask_warnings: Vec<GoalWarning>,
    photo: Option<Photo>,
    /// Colours of the tree, where the page has seen them.
    pub(crate) colors: Option<Colors>,
}

/// Where the tree stands, so far as the user has said.
#[derive(Clone, Copy, Default)]
struct Places {
    ground_row: Option<f64>,
    axis_column: Option<f64>,
}

impl Places {
    fn options(self) -> GoalOptions {
        let Self { ground_row, axis_column } = self;
        GoalOptions { ground_row, axis_column, ..GoalOptions::default() }
    }
}

impl Goal {
    /// The ink that a fit is made to.
    pub(crate) const fn ink(&self) -> &Bitmap {
        &self.painted
    }

    /// The ground's row and the trunk's column, where the user has said them.
    pub(crate) const fn places(&self) -> (Option<f64>, Option<f64>) {
        (self.places.ground_row, self.places.axis_column)
    }

    /// A name for the species that is found.
    pub(crate) fn species_name(&self) -> String {
        let stem = std::path::Path::new(&self.name).file_stem().unwrap_or_default();
        stem.to_string_lossy().into_owned()
    }
}

#[wasm_bindgen]
impl Goal {
    /// Reads a PNG, JPEG, WebP or TIFF file. With `mask` `auto` what looks like a photograph is masked, with `photo`
    /// whatever it is, and with `off` nothing is: then it is split by brightness.
    ///
    /// `hints`, JSON, show the tree in a photograph: see [`MaskHints`]. Where they show anything, it is one.
    pub fn read(name: &str, bytes: Vec<u8>, mask: &str, hints: Option<String>) -> Result<Self, JsError> {
        let hints: MaskHints = serde_json::from_str(hints.as_deref().unwrap_or("{}")).map_err(thrown)?;
        let source = Encoded::new(name, bytes);
        let by_tone = Read::from_encoded(&source, &GoalOptions::default());
        let is_photo = match (mask, &by_tone) {
            _ if !hints.is_empty() => true,
            ("photo", _) => true,
            ("off", _) | ("auto", Err(_)) => false,
            ("auto", Ok(goal)) => goal.warnings.contains(&GoalWarning::Photograph),
            _ => return Err(thrown(format!("the mask is `{mask}`, expected auto, photo or off"))),
        };
        if is_photo {
            let photo = Photo::from_encoded(&source).map_err(thrown)?;
            let options = hints.over(MaskOptions::default(), &photo, &source.into()).map_err(thrown)?;
            let found = Mask::from_photo(&photo, &options).map_err(thrown)?;
            let full = Read::from_ink(found.bitmap.clone(), &GoalOptions::default()).map_err(thrown)?;
            return Ok(Self {
                name: name.to_owned(),
                painted: found.bitmap,
                places: Places::default(),
                full,
                confidence: Some(found.confidence),
                mask_warnings: found.warnings,
                photo: Some(photo),
                colors: None,
            });
        }
        let full = by_tone.map_err(thrown)?;
        let photo = Photo::from_encoded(&source).ok();
        Ok(Self {
            name: name.to_owned(),
            painted: full.bitmap.clone(),
            places: Places::default(),
            full,
            confidence: None,
            mask_warnings: Vec::new(),
            photo,
            colors: None,
        })
    }

    /// A goal from ink at hand: one byte per pixel, row by row, 0 for paper.
    pub fn from_pixels(name: &str, width: u32, height: u32, pixels: &[u8]) -> Result<Self, JsError> {
        let painted = bitmap(width, height, pixels)?;
        Ok(Self {
            name: name.to_owned(),
            full: Read::from_bitmap(painted.clone()).map_err(thrown)?,
            painted,
            places: Places::default(),
            confidence: None,
            mask_warnings: Vec::new(),
            photo: None,
            colors: None,
        })
    }

    /// What was found in the picture: JSON.
    #[must_use]
    pub fn info(&self) -> String {
        let goal = &self.full;
        let mut warnings: Vec<GoalWarning> = Vec::new();
        for warning in self.mask_warnings.iter().chain(&goal.warnings) {
            if !warnings.contains(warning) {
                warnings.push(*warning);
            }
        }
        json!({
            "name": self.name,
            "width": goal.bitmap.width(),
            "height": goal.bitmap.height(),
            "ink": goal.bitmap.ink(),
            "masked": self.confidence.is_some(),
            "confidence": self.confidence,
            "ground_row": goal.ground_row,
            "axis_column": goal.axis_column,
            "height_in_pixels": goal.height_in_pixels(),
            "warnings": warnings,
        })
        .to_string()
    }

    /// One byte per pixel, 1 for tree.
    #[must_use]
    pub fn pixels(&self) -> Vec<u8> {
        ink(&self.full.bitmap)
    }

    /// The picture itself in four bytes per pixel, for a backdrop; empty if there is none, or a very large one.
    #[must_use]
    pub fn photo(&self) -> Vec<u8> {
        let Some(photo) = &self.photo else { return Vec::new() };
        if photo.width().max(photo.height()) > SHOWN_SIDE {
            return Vec::new();
        }
        photo.pixels().as_flattened().to_vec()
    }

    /// The same with the ground and the trunk where the user says: in pixels from the upper left.
    pub fn with_ground(&self, row: Option<f64>, axis: Option<f64>) -> Result<Self, JsError> {
        let places = Places { ground_row: row, axis_column: axis };
        Ok(Self {
            name: self.name.clone(),
            full: Read::from_ink(self.painted.clone(), &places.options()).map_err(thrown)?,
            painted: self.painted.clone(),
            places,
            confidence: self.confidence,
            mask_warnings: self.mask_warnings.clone(),
            photo: self.photo.clone(),
            colors: self.colors.clone(),
        })
    }

    /// What is in the picture. `photo` are its colours, four bytes per pixel; `corrections`, JSON, what is otherwise than it
    /// is read.
    pub fn look(&self, photo: Option<Vec<u8>>, corrections: &str) -> Result<Look, JsError> {
        let tree = self.ink();
        let (width, height) = (tree.width(), tree.height());
        let photo = photo.filter(|bytes| bytes.len() == 4 * width as usize * height as usize);
        let colors = photo.and_then(|bytes| {
            let (pixels, _) = bytes.as_chunks();
            let photo =
                Photo::from_fn(width, height, |x, y| pixels[y as usize * width as usize + x as usize]);
            // A picture in black and white has none.
            Colors::read(&photo, tree).ok().filter(|colors| colors.leaves.is_some())
        });
        let options = FitOptions {
            reading: Corrections::from_json(corrections).map_err(thrown)?,
            ..FitOptions::default()
        };
        let source = FitSource { colors, ..tree.clone().into() };
        let PictureReading { found, silhouette, .. } = read_picture(source, &options).map_err(thrown)?;
        let words = found.colors.iter().flat_map(Colors::table);
        let table: Vec<_> = found.measures.table().into_iter().chain(words).collect();
        let anchor = Anchor::new(&silhouette, &found.measures);
        Ok(Look {
            json: json!({ "found": found, "table": table, "anchor": anchor }).to_string(),
            layers: found.colors.as_ref().map(layers).unwrap_or_default(),
        })
    }

    /// The same goal with these colours and layers of its tree, as `look` has found them.
    pub fn with_colors(self, colors: &str, layers: &[u8]) -> Result<Self, JsError> {
        let (width, height) = (self.painted.width(), self.painted.height());
        let layer = |kind: u8| -> Result<Bitmap, JsError> {
            let of_kind: Vec<u8> = layers.iter().map(|&layer| u8::from(layer == kind)).collect();
            bitmap(width, height, &of_kind)
        };
        let colors: Colors = serde_json::from_str(colors).map_err(thrown)?;
        let colors = Colors { wood: layer(WOOD)?, foliage: layer(FOLIAGE)?, ..colors };
        Ok(Self { colors: Some(colors), ..self })
    }

    /// The score card of a picture of the same size: JSON.
    pub fn score(&self, pixels: &[u8]) -> Result<String, JsError> {
        let picture = bitmap(self.full.bitmap.width(), self.full.bitmap.height(), pixels)?;
        let card = ScoreCard::new(&picture, &self.full.bitmap).map_err(thrown)?;
        serde_json::to_string(&card).map_err(thrown)
    }
}

/// What is in a picture.
#[wasm_bindgen(getter_with_clone)]
pub struct Look {
    /// JSON: `found` is what `pleach read --json` gives, `table` the same in words, with confidences, and `anchor` where the
    /// tree stands in pixels.
    pub json: String,
    /// One byte per pixel, 1 for wood and 2 for foliage; empty of a picture without colours.
    pub layers: Vec<u8>,
}

/// What a byte of a layer says of its pixel.
const WOOD: u8 = 1;
const FOLIAGE: u8 = 2;

fn layers(colors: &Colors) -> Vec<u8> {
    let kind = |x, y| match (colors.wood.get(x, y), colors.foliage.get(x, y)) {
        (true, _) => WOOD,
        (_, true) => FOLIAGE,
        _ => 0,
    };
    let (width, height) = (colors.wood.width(), colors.wood.height());
    (0..height).flat_map(|y| (0..width).map(move |x| kind(x, y))).collect()
}

fn bitmap(width: u32, height: u32, pixels: &[u8]) -> Result<Bitmap, JsError> {
    let expected = width as usize * height as usize;
    if pixels.len() != expected {
        return Err(thrown(format!("there are {} pixels, expected {width} × {height}", pixels.len())));
    }
    Ok(Bitmap::from_fn(width, height, |x, y| pixels[y as usize * width as usize + x as usize] != 0))
}
