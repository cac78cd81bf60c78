//! Goal images: from a file to ink, with the place where the tree stands.
//!
//! 1. The file is read to its end and its structure checked; then it is decoded within limits: at most
//!    [`MAX_SIDE`] pixels wide and high and [`MAX_BYTES`]. Of an animation or of pages, the first is taken.
//! 2. A frame around the picture is left out. The tree is found by opacity where that cuts something out,
//!    else by Otsu's threshold on brightness, or between two values if there are no more; or a mask file says.
//!    Where brightness makes a doubtful tree, what differs from the paper around it is tried.
//! 3. Ground row and axis column are read off the ink, unless set by hand.
//! 4. What is unusual for a silhouette of a tree is reported: [`GoalWarning`].
//! 5. On request the picture is replaced by the tree and a margin: [`Crop`].
//! 6. On request it is reduced to a working size, black from half coverage.
//!
//! How tall the tree is cannot be seen in a silhouette: [`Goal::frame`] takes it in metres.

pub(crate) mod alpha;
mod anchor;
pub(crate) mod border;
mod error;
mod formats;
mod hollow;
pub(crate) mod ink;
mod limits;
mod photograph;
pub(crate) mod read;
mod region;
mod resample;
pub(crate) mod shape;
mod shrink;
mod source;
mod specks;
mod structure;
#[cfg(feature = "pictures")]
mod svg;
#[cfg(feature = "pictures")]
mod svg_bounds;
#[cfg(test)]
mod tests;
mod tiff;
mod uneven;
mod warning;

pub use anchor::Origin;
pub use border::FrameWidths;
pub use error::GoalError;
pub use ink::{Polarity, Split};
pub use limits::{MAX_BYTES, MAX_SIDE, MIN_SIDE};
pub use region::Crop;
pub use source::Encoded;
pub use warning::GoalWarning;

use crate::bitmap::Bitmap;
use crate::view::Frame;
use anchor::Snapping;
use ink::{LowContrast, Reading};
use region::Region;
use std::io::Read;
use std::path::{Path, PathBuf};

/// What may be set by hand about a goal image.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GoalOptions {
    /// A picture of the same size, or of the same shape at another size, that says what is tree; read in the
    /// same way as a goal.
    pub mask: Option<PathBuf>,
    /// Which of the two tones is the tree, in the mask if there is one.
    pub polarity: Polarity,
    /// Where the ground is, in pixels of the file from its top edge.
    pub ground_row: Option<f64>,
    /// Where the trunk stands, in pixels of the file from its left edge.
    pub axis_column: Option<f64>,
    /// Largest width and height of the working picture in pixels; larger ones are reduced. Of a picture that is
    /// [cropped](Crop::ToTree), the tree's height and width reach to 95 % of it, and margins come on top.
    pub max_side: Option<u32>,
    /// What of the picture is compared with.
    pub crop: Crop,
}

/// How a goal was understood, to be shown to its user.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Detection {
    /// Width and height of the picture as it came, in pixels.
    pub original_size: (u32, u32),
    /// Pixels of the working picture to one of the original, at most 1.
    pub reduction: f64,
    /// Where the working picture begins: column and row of the original, below 0 where it begins outside.
    pub origin: (f64, f64),
    /// Longer side of the tree in pixels of the original, where the picture was [cropped](Crop::ToTree) to it: this is
    /// what [`GoalOptions::max_side`] bounds, and not the picture's longer side.
    pub tree_side: Option<f64>,
    /// How tree and paper were separated.
    pub split: Split,
    /// Whether a mask file said what is tree.
    pub masked: bool,
    /// How the ground row came about.
    pub ground: Origin,
    /// How the axis column came about.
    pub axis: Origin,
}

/// A picture of a tree that parameters are to be found for.
#[derive(Clone, Debug, PartialEq)]
pub struct Goal {
    /// The tree as ink, at the working size.
    pub bitmap: Bitmap,
    /// Where the ground is, in pixels of `bitmap` from its top edge; its height at most.
    pub ground_row: f64,
    /// Where the trunk stands, in pixels of `bitmap` from its left edge.
    pub axis_column: f64,
    /// The upper edge of the highest ink, in pixels of `bitmap` from its top edge; above the ground.
    pub top_row: f64,
    /// How the picture was understood.
    pub detection: Detection,
    /// What about the picture is not as a fit expects, in the order of [`GoalWarning`]'s variants.
    pub warnings: Vec<GoalWarning>,
}

impl Goal {
    /// Reads a goal image: PNG, JPEG, WebP or TIFF, with the feature `pictures` GIF, BMP or SVG, recognised by content, not by name.
    ///
    /// ```
    /// use pleach_silhouette::{Goal, GoalOptions};
    ///
    /// let goal = Goal::load("../../targets/palm.png", &GoalOptions::default())?;
    /// println!("{} pixels high, {} warnings", goal.height_in_pixels(), goal.warnings.len());
    /// assert!(goal.bitmap.ink() > 0 && goal.warnings.is_empty());
    /// # Ok::<(), pleach_silhouette::GoalError>(())
    /// ```
    ///
    /// # Errors
    /// See [`GoalError`]: files that cannot be read, are not pictures, are damaged, too large, too
    /// small or of one tone, and places set by hand that are not in the picture.
    pub fn load(path: impl AsRef<Path>, options: &GoalOptions) -> Result<Self, GoalError> {
        Self::from_encoded(&Encoded::load(path)?, options)
    }

    /// Reads a goal image from bytes at hand; `name` is what errors call it.
    ///
    /// # Errors
    /// As [`Goal::load`].
    pub fn from_bytes(
        name: impl Into<PathBuf>,
        bytes: Vec<u8>,
        options: &GoalOptions,
    ) -> Result<Self, GoalError> {
        Self::from_encoded(&Encoded::new(name, bytes), options)
    }

    /// Reads a goal image from any stream, such as standard input; `name` is what
    /// errors call it.
    ///
    /// # Errors
    /// As [`Goal::load`].
    pub fn from_reader(
        name: impl Into<PathBuf>,
        reader: impl Read,
        options: &GoalOptions,
    ) -> Result<Self, GoalError> {
        Self::from_encoded(&Encoded::read(name, reader)?, options)
    }

    /// Decodes a goal image.
    ///
    /// # Errors
    /// As [`Goal::load`].
    pub fn from_encoded(source: &Encoded, options: &GoalOptions) -> Result<Self, GoalError> {
        let (name, mut tones, size) = if let Some(mask) = &options.mask {
            let image_size = read::dimensions(source)?;
            let tones = read::tones(&Encoded::load(mask)?)?;
            let mask_size = (tones.width, tones.height);
            if !resample::is_alike(mask_size, image_size) {
                return Err(GoalError::MaskSize { mask: mask.clone(), mask_size, image_size });
            }
            (mask.as_path(), tones, image_size)
        } else {
            let tones = read::tones(source)?;
            let size = (tones.width, tones.height);
            (source.name(), tones, size)
        };
        let name = name.display().to_string();
        let Reading { mut ink, split, mut inside, warnings: treated } =
            ink::ink_of(&mut tones, options.polarity).map_err(|LowContrast { darkest, lightest }| {
                GoalError::LowContrast { name: name.clone(), darkest, lightest }
            })?;
        let mut warnings = Vec::new();
        if let Split::Brightness { threshold, dark_tree } = split
            && options.mask.is_none()
            && photograph::is_photograph(&tones, threshold, dark_tree)
        {
            warnings.push(GoalWarning::Photograph);
        }
        if tones.several {
            warnings.push(GoalWarning::SeveralPictures);
        }
        warnings.extend(treated);
        if (tones.width, tones.height) != size {
            ink = resample::resampled(&ink, size.0, size.1);
            inside = inside.map(|inside| resample::resampled(&inside, size.0, size.1));
        }
        drop(tones);
        let goal = Self::build(ink, inside.as_ref(), split, &name, options, warnings)?;
        Ok(uneven::by_color(source, &goal, options).unwrap_or(goal))
    }

    /// A goal from a picture of ink at hand, its places detected.
    ///
    /// # Errors
    /// [`GoalError::TooSmall`], [`GoalError::NoInk`], [`GoalError::AllInk`].
    pub fn from_bitmap(bitmap: Bitmap) -> Result<Self, GoalError> {
        Self::from_ink(bitmap, &GoalOptions::default())
    }

    /// A goal from a picture of ink at hand; of the options, mask and polarity are not looked at.
    ///
    /// # Errors
    /// As [`Goal::from_bitmap`], and for places set by hand that are not in the picture.
    pub fn from_ink(bitmap: Bitmap, options: &GoalOptions) -> Result<Self, GoalError> {
        Self::build(bitmap, None, Split::None, "the picture", options, Vec::new())
    }

    fn build(
        ink: Bitmap,
        inside: Option<&Bitmap>,
        split: Split,
        name: &str,
        options: &GoalOptions,
        mut warnings: Vec<GoalWarning>,
    ) -> Result<Self, GoalError> {
        let original_size = (ink.width(), ink.height());
        let (width, height) = original_size;
        let name = || name.to_owned();
        if width.min(height) < MIN_SIDE {
            return Err(GoalError::TooSmall { name: name(), width, height });
        }
        if ink.ink() == ink.area() {
            return Err(GoalError::AllInk { name: name() });
        }
        if ink.ink() == 0 {
            return Err(GoalError::NoInk { name: name() });
        }
        warnings.extend(shape::warnings(&ink));
        let is_noisy = warnings.iter().any(|warning| matches!(warning, GoalWarning::Noise { .. }));
        let clean = is_noisy.then(|| specks::cleaned(&ink)).filter(|clean| clean.ink() > 0);
        let ink = clean.unwrap_or(ink);
        // A tree that a frame cuts off was continued into it, so that what was said above knows.
        let ink = inside.map(|inside| border::within(&ink, inside)).unwrap_or(ink);
        let bounds = ink.ink_box().ok_or_else(|| GoalError::NoInk { name: name() })?;
        let (top, bottom) = specks::rows(&ink, bounds.1, bounds.3);
        let bounds = (bounds.0, top, bounds.2, bottom);
        let top_row = f64::from(top);
        let given_ground = user_value("the ground row", options.ground_row, height)?;
        let lowest = f64::from(bounds.3) + 1.0;
        let region = match options.crop {
            Crop::Keep => Region::whole(&ink),
            Crop::ToTree => Region::around_tree(&ink, bounds, given_ground.map_or(lowest, |(row, _)| row)),
        };
        // Margins that are replaced say nothing about the tree.
        let snapping = if region.is_whole(&ink) { Snapping::On } else { Snapping::Off };
        let (ground_row, ground) = given_ground.unwrap_or_else(|| anchor::ground(&ink, bounds.3, snapping));
        if ground_row <= top_row {
            return Err(GoalError::GroundAboveTree { ground_row, top_row });
        }
        // Ink below a ground set by hand is not the trunk.
        let foot = (ground_row.ceil() as u32).min(bounds.3 + 1);
        let (axis_column, axis) = user_value("the axis column", options.axis_column, width)?
            .unwrap_or_else(|| anchor::axis(&ink, bounds, foot, snapping));
        let (ink, tree_side) = if region.is_whole(&ink) {
            (ink, None)
        } else {
            let (left, top, right, _) = bounds;
            let tree = f64::from(right + 1 - left).max(ground_row.ceil() - f64::from(top));
            (region.cut(&ink), Some(tree))
        };
        let reduction = options.max_side.map_or(1.0, |side| reduction(side, original_size, tree_side));
        let bitmap = if reduction < 1.0 { shrink::shrink(&ink, reduction) } else { ink };
        let origin = (region.left as f64, region.top as f64);
        if bitmap.ink() == 0 {
            return Err(GoalError::NoInk { name: name() + AT_WORKING_SIZE });
        }
        let masked = options.mask.is_some();
        Ok(Self {
            bitmap,
            ground_row: (ground_row - origin.1) * reduction,
            axis_column: (axis_column - origin.0) * reduction,
            top_row: (top_row - origin.1) * reduction,
            detection: Detection { original_size, reduction, origin, tree_side, split, masked, ground, axis },
            warnings,
        })
    }

    /// The same goal as if it had been read with this [`GoalOptions::max_side`]; a goal that is no larger is returned
    /// as it is.
    ///
    /// # Errors
    /// [`GoalError::NoInk`] if nothing of the tree is left at that size.
    pub fn reduced(&self, max_side: u32) -> Result<Self, GoalError> {
        let Detection { original_size, tree_side, reduction: before, .. } = self.detection;
        let reduction = reduction(max_side, original_size, tree_side);
        if reduction >= before {
            return Ok(self.clone());
        }
        let factor = reduction / before;
        let bitmap = shrink::shrink(&self.bitmap, factor);
        if bitmap.ink() == 0 {
            return Err(GoalError::NoInk { name: format!("the picture{AT_WORKING_SIZE}") });
        }
        Ok(Self {
            bitmap,
            ground_row: self.ground_row * factor,
            axis_column: self.axis_column * factor,
            top_row: self.top_row * factor,
            detection: Detection { reduction, ..self.detection },
            warnings: self.warnings.clone(),
        })
    }

    /// Pixels from the ground to the top of the tree; positive.
    #[must_use]
    pub fn height_in_pixels(&self) -> f64 {
        self.ground_row - self.top_row
    }

    /// The frame in which a tree of `height` metres stands as the one in the picture.
    #[must_use]
    pub fn frame(&self, height: f64) -> Frame {
        Frame {
            width: self.bitmap.width(),
            height: self.bitmap.height(),
            meters_per_pixel: height / self.height_in_pixels(),
            axis_column: self.axis_column,
            ground_row: self.ground_row,
        }
    }

    /// The frame of [`Goal::bitmap`] for a frame of the picture as it came: the other way round of
    /// [`Goal::original_frame`].
    #[must_use]
    pub fn working_frame(&self, original: &Frame) -> Frame {
        let Detection { reduction, origin, .. } = self.detection;
        Frame {
            width: self.bitmap.width(),
            height: self.bitmap.height(),
            meters_per_pixel: original.meters_per_pixel / reduction,
            axis_column: (original.axis_column - origin.0) * reduction,
            ground_row: (original.ground_row - origin.1) * reduction,
        }
    }

    /// The frame of the picture as it came, for a frame of [`Goal::bitmap`]: what is drawn in it lies on the file.
    #[must_use]
    pub fn original_frame(&self, frame: &Frame) -> Frame {
        let Detection { original_size: (width, height), reduction, origin, .. } = self.detection;
        Frame {
            width,
            height,
            meters_per_pixel: frame.meters_per_pixel * reduction,
            axis_column: frame.axis_column / reduction + origin.0,
            ground_row: frame.ground_row / reduction + origin.1,
        }
    }

    /// Whether the working picture shows all of the original and no more.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        let Detection { original_size, reduction, origin, .. } = self.detection;
        let size = |side: u32| ((f64::from(side) * reduction).round() as u32).max(1);
        origin == (0.0, 0.0)
            && (self.bitmap.width(), self.bitmap.height()) == (size(original_size.0), size(original_size.1))
    }
}

/// What errors say of a picture that is empty once it is reduced.
const AT_WORKING_SIZE: &str = ", at its working size,";

/// Pixels of a working picture of at most `max_side` to one of the original: see [`GoalOptions::max_side`]; at most 1.
fn reduction(max_side: u32, (width, height): (u32, u32), tree_side: Option<f64>) -> f64 {
    let side = max_side.max(MIN_SIDE);
    let reduction = match tree_side {
        None => f64::from(side) / f64::from(width.max(height)),
        Some(tree) => Region::tree_side(side) / tree,
    };
    reduction.min(1.0)
}

/// A place set by hand, if it is one in the picture.
fn user_value(what: &'static str, value: Option<f64>, size: u32) -> Result<Option<(f64, Origin)>, GoalError> {
    let limit = f64::from(size);
    match value {
        None => Ok(None),
        // A picture that was shrunk ends within what would be its next pixel.
        Some(value) if (0.0..limit + 1.0).contains(&value) => Ok(Some((value, Origin::Given))),
        Some(value) => Err(GoalError::OutsidePicture { what, value, limit }),
    }
}
