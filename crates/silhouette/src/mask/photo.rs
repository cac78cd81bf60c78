//! A photograph in memory.

use crate::bitmap::Bitmap;
use crate::goal::{Encoded, GoalError};
use crate::goal::{border, read};
use std::path::{Path, PathBuf};

/// A picture in colour with opacity.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Photo {
    width: u32,
    height: u32,
    pixels: Vec<[u8; 4]>,
    several: bool,
}

impl Photo {
    /// Reads PNG, JPEG, WebP or TIFF, turned as its note on orientation says.
    ///
    /// # Errors
    /// As for a goal image: files that cannot be read, are not pictures, are damaged, too large or
    /// too small.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, GoalError> {
        Self::from_encoded(&Encoded::load(path)?)
    }

    /// Reads a photograph from bytes at hand; `name` is what errors call it.
    ///
    /// # Errors
    /// As [`Photo::load`].
    pub fn from_bytes(name: impl Into<PathBuf>, bytes: Vec<u8>) -> Result<Self, GoalError> {
        Self::from_encoded(&Encoded::new(name, bytes))
    }

    /// Decodes a photograph.
    ///
    /// # Errors
    /// As [`Photo::load`].
    pub fn from_encoded(source: &Encoded) -> Result<Self, GoalError> {
        let (picture, several) = read::picture(source)?;
        let picture = picture.into_rgba8();
        let (width, height) = picture.dimensions();
        let pixels = picture.into_raw().as_chunks::<4>().0.to_vec();
        Ok(Self { width, height, pixels, several })
    }

    /// The picture whose pixels are `at(x, y)`: red, green, blue and opacity.
    #[must_use]
    pub fn from_fn(width: u32, height: u32, mut at: impl FnMut(u32, u32) -> [u8; 4]) -> Self {
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| at(x, y));
        Self { width, height, pixels: pixels.collect(), several: false }
    }

    /// Width in pixels.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// Whether the file held further pictures, as pages or an animation; this is the first.
    #[must_use]
    pub const fn has_further(&self) -> bool {
        self.several
    }

    /// Red, green, blue and opacity, row by row.
    #[must_use]
    pub fn pixels(&self) -> &[[u8; 4]] {
        &self.pixels
    }

    pub(super) fn rgb(&self, x: u32, y: u32) -> [u8; 3] {
        let [r, g, b, _] = self.pixels[y as usize * self.width as usize + x as usize];
        [r, g, b]
    }

    pub(super) fn opacity(&self, x: u32, y: u32) -> u8 {
        self.pixels[y as usize * self.width as usize + x as usize][3]
    }

    /// Brightness from 0 to 255.
    pub(super) fn light(&self, x: u32, y: u32) -> u8 {
        // As the decoder of goals has it (Rec. 709).
        let [r, g, b] = self.rgb(x, y).map(u32::from);
        ((2126 * r + 7152 * g + 722 * b) / 10_000) as u8
    }

    /// The picture with the nearest colours inside in place of those that are not, all of it opaque.
    pub(super) fn extended(&self, inside: &Bitmap) -> Self {
        let mut out = self.clone();
        border::extend(&mut out.pixels, inside);
        out.opaque()
    }

    /// The picture with all of its colours shown.
    pub(super) fn opaque(mut self) -> Self {
        self.pixels.iter_mut().for_each(|pixel| pixel[3] = 255);
        self
    }

    /// Least and greatest opacity.
    pub(super) fn opacities(&self) -> (u8, u8) {
        self.pixels.iter().fold((255, 0), |(least, most), p| (least.min(p[3]), most.max(p[3])))
    }
}
