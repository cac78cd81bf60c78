//! Pictures for people: overlays of fit and goal, and sheets of silhouettes side by side.

use crate::bitmap::Bitmap;
use crate::raster::Rasterizer;
use crate::view::{Frame, View};
use font8x8::UnicodeFonts;
use pleach_plant::{Parts, Tree};
use std::io::{self, Write};

/// Red, green, blue.
pub type Rgb = [u8; 3];

const WHITE: Rgb = [255; 3];
const BLACK: Rgb = [0; 3];
/// Ink in both pictures of an overlay.
pub const BOTH: Rgb = [60, 60, 60];
/// Ink of the goal alone: what the fit misses. Vermilion of Okabe and Ito 2008.
pub const MISSED: Rgb = [213, 94, 0];
/// Ink of the fit alone: what it adds. Blue of Okabe and Ito 2008.
pub const ADDED: Rgb = [0, 114, 178];

/// A picture in colour.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    width: u32,
    height: u32,
    pixels: Vec<Rgb>,
}

impl Picture {
    /// A white picture.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        Self { width, height, pixels: vec![WHITE; width as usize * height as usize] }
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

    /// The colour at (x, y); white outside.
    #[must_use]
    pub fn get(&self, x: u32, y: u32) -> Rgb {
        if x < self.width && y < self.height { self.pixels[(y * self.width + x) as usize] } else { WHITE }
    }

    /// Sets the colour at (x, y); nothing happens outside.
    pub fn set(&mut self, x: u32, y: u32, color: Rgb) {
        if x < self.width && y < self.height {
            self.pixels[(y * self.width + x) as usize] = color;
        }
    }

    /// Draws the ink of `bitmap` in `color` with its upper left corner at (x, y).
    pub fn stamp(&mut self, bitmap: &Bitmap, x: u32, y: u32, color: Rgb) {
        for row in 0..bitmap.height() {
            for column in bitmap.ink_in_row(row) {
                self.set(x + column, y + row, color);
            }
        }
    }

    /// Copies `other` with its upper left corner at (x, y).
    pub fn paste(&mut self, other: &Self, x: u32, y: u32) {
        for row in 0..other.height {
            for column in 0..other.width {
                self.set(x + column, y + row, other.get(column, row));
            }
        }
    }

    /// Writes `text` in black with its upper left corner at (x, y), [`LETTER`] pixels a letter;
    /// letters that the font lacks are left out.
    pub fn write(&mut self, text: &str, x: u32, y: u32) {
        for (i, letter) in (0..).zip(text.chars()) {
            let glyph = font8x8::BASIC_FONTS.get(letter).or_else(|| font8x8::LATIN_FONTS.get(letter));
            for (row, bits) in (0..).zip(glyph.unwrap_or_default()) {
                for column in (0..8).filter(|c| bits >> c & 1 == 1) {
                    self.set(x + i * LETTER + column, y + row, BLACK);
                }
            }
        }
    }

    /// Writes the picture as a PNG.
    ///
    /// # Errors
    /// What `out` reports.
    pub fn write_png(&self, out: &mut impl Write) -> io::Result<()> {
        let mut encoder = png::Encoder::new(out, self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(self.pixels.as_flattened())?;
        writer.finish()?;
        Ok(())
    }
}

/// Height and width of a letter in pixels.
pub const LETTER: u32 = 8;

/// Fit and goal in one picture: [`BOTH`], [`MISSED`] and [`ADDED`] on white.
///
/// # Panics
/// If the two differ in size.
#[must_use]
pub fn overlay(fit: &Bitmap, goal: &Bitmap) -> Picture {
    assert_eq!((fit.width(), fit.height()), (goal.width(), goal.height()), "pictures of one size");
    let mut picture = Picture::new(goal.width(), goal.height());
    picture.stamp(fit, 0, 0, ADDED);
    for y in 0..goal.height() {
        for x in goal.ink_in_row(y) {
            picture.set(x, y, if fit.get(x, y) { BOTH } else { MISSED });
        }
    }
    picture
}

/// `parts` of a tree in two flat colours, bark below foliage, with soft edges.
///
/// Depth is not shown: foliage covers bark wherever both are.
#[must_use]
pub fn two_colors(tree: &Tree, view: &View, frame: &Frame, parts: Parts) -> Picture {
    const BARK: Rgb = [92, 70, 52];
    const GREEN: Rgb = [86, 125, 62];
    const BLOSSOM: Rgb = [222, 160, 178];
    let layers = [
        (Parts::ROOTS, BARK),
        (Parts::STEMS, BARK),
        (Parts::LEAVES, GREEN),
        (Parts::BLOBS, GREEN),
        (Parts::BLOSSOMS, BLOSSOM),
    ];
    let mut picture = Picture::new(frame.width, frame.height);
    let mut rasterizer = Rasterizer::new();
    let (mut bitmap, mut coverage) = (Bitmap::default(), Vec::new());
    for (part, color) in layers.into_iter().filter(|(part, _)| parts.contains(*part)) {
        rasterizer.draw(tree, view, frame, part, &mut bitmap);
        rasterizer.coverage(&mut coverage);
        for (pixel, &samples) in picture.pixels.iter_mut().zip(&coverage) {
            let share = f32::from(samples) / f32::from(rasterizer.samples());
            for (under, over) in pixel.iter_mut().zip(color) {
                *under = (f32::from(*under) * (1.0 - share) + f32::from(over) * share).round() as u8;
            }
        }
    }
    picture
}

/// Silhouettes side by side in rows of `columns`, each under its label.
///
/// Cells are as large as the largest silhouette; labels that do not fit are cut off.
#[must_use]
pub fn sheet(cells: &[(String, Bitmap)], columns: usize) -> Picture {
    let pictures: Vec<(&str, Picture)> = cells
        .iter()
        .map(|(label, bitmap)| {
            let mut picture = Picture::new(bitmap.width(), bitmap.height());
            picture.stamp(bitmap, 0, 0, BLACK);
            (label.as_str(), picture)
        })
        .collect();
    sheet_of_pictures(&pictures, columns)
}

/// Pictures side by side in rows of `columns`, each under its label; as [`sheet`].
#[must_use]
pub fn sheet_of_pictures(cells: &[(&str, Picture)], columns: usize) -> Picture {
    const GAP: u32 = 8;
    const HEAD: u32 = LETTER + 6;
    let width = cells.iter().map(|c| c.1.width).max().unwrap_or(1);
    let height = cells.iter().map(|c| c.1.height).max().unwrap_or(1);
    let columns = columns.clamp(1, cells.len().max(1));
    let rows = cells.len().div_ceil(columns).max(1);
    let mut sheet =
        Picture::new(columns as u32 * (width + GAP) + GAP, rows as u32 * (height + HEAD + GAP) + GAP);
    for (i, (label, picture)) in cells.iter().enumerate() {
        let x = GAP + (i % columns) as u32 * (width + GAP);
        let y = GAP + (i / columns) as u32 * (height + HEAD + GAP);
        let room = (width / LETTER) as usize;
        sheet.write(&label.chars().take(room).collect::<String>(), x, y);
        sheet.paste(picture, x + (width - picture.width) / 2, y + HEAD);
    }
    sheet
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overlays_say_what_agrees_what_is_missed_and_what_is_added() {
        let picture = overlay(&Bitmap::from_ascii("##.."), &Bitmap::from_ascii("#.#."));
        let row: Vec<Rgb> = (0..4).map(|x| picture.get(x, 0)).collect();
        assert_eq!(row, [BOTH, ADDED, MISSED, WHITE]);
    }

    #[test]
    fn sheets_have_a_cell_a_picture_and_legible_labels() {
        let cell = |label: &str| (label.to_owned(), Bitmap::from_fn(40, 30, |x, y| x == y));
        let sheet = sheet(&[cell("Fig 1é"), cell("b"), cell("c")], 2);
        assert_eq!((sheet.width(), sheet.height()), (2 * 48 + 8, 2 * (30 + 14 + 8) + 8));
        let ink = |x0: u32, x1: u32, y0: u32, y1: u32| {
            (y0..y1)
                .flat_map(|y| (x0..x1).map(move |x| (x, y)))
                .filter(|&(x, y)| sheet.get(x, y) != WHITE)
                .count()
        };
        assert_eq!(ink(8, 48, 22, 52), 30, "the diagonal of the first cell");
        assert!(ink(8, 16, 8, 16) > 8, "a letter");
        assert_eq!(ink(56, 104, 60, 112), 0, "the last cell is empty");
    }

    #[test]
    fn png_can_be_read_back() {
        let picture = overlay(&Bitmap::from_ascii("##.."), &Bitmap::from_ascii("#.#."));
        let mut bytes = Vec::new();
        picture.write_png(&mut bytes).unwrap();
        let read = image::load_from_memory(&bytes).unwrap().to_rgb8();
        assert_eq!(read.get_pixel(2, 0).0, MISSED);
    }
}
