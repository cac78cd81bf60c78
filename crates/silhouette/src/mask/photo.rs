//! A photograph in memory.

use crate::goal::GoalError;
use crate::goal::read;
use std::path::Path;

/// A picture in colour with opacity.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Photo {
    width: u32,
    height: u32,
    pixels: Vec<[u8; 4]>,
}

impl Photo {
    /// Reads PNG, JPEG or WebP, turned as its note on orientation says.
    ///
    /// # Errors
    /// As for a goal image: files that cannot be read, are no pictures, are damaged, too large or
    /// too small.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, GoalError> {
        let picture = read::picture(path.as_ref())?.into_rgba8();
        let (width, height) = picture.dimensions();
        let pixels = picture.into_raw().as_chunks::<4>().0.to_vec();
        Ok(Self { width, height, pixels })
    }

    /// The picture whose pixels are `at(x, y)`: red, green, blue and opacity.
    #[must_use]
    pub fn from_fn(width: u32, height: u32, mut at: impl FnMut(u32, u32) -> [u8; 4]) -> Self {
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| at(x, y));
        Self { width, height, pixels: pixels.collect() }
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

    pub(super) fn rgb(&self, x: u32, y: u32) -> [u8; 3] {
        let [r, g, b, _] = self.pixels[y as usize * self.width as usize + x as usize];
        [r, g, b]
    }

    pub(super) fn opacity(&self, x: u32, y: u32) -> u8 {
        self.pixels[y as usize * self.width as usize + x as usize][3]
    }

    /// Least and greatest opacity.
    pub(super) fn opacities(&self) -> (u8, u8) {
        self.pixels.iter().fold((255, 0), |(least, most), p| (least.min(p[3]), most.max(p[3])))
    }
}
