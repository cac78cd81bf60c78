//! Letters: a subset of DejaVu Sans that comes with the crate, so that pictures are the same
//! everywhere and need no fonts of the system.

use tiny_skia::{Path, PathBuilder, Transform};
use ttf_parser::{Face, OutlineBuilder};

static BYTES: &[u8] = include_bytes!("../../assets/DejaVuSans-subset.ttf");

/// The font, read.
pub(super) struct Font(Face<'static>);

impl Font {
    pub(super) fn new() -> Self {
        Self(Face::parse(BYTES, 0).expect("the font that comes with the crate is whole"))
    }

    /// Width in pixels of a line of `text`, `size` pixels to the em. Letters that the font lacks are
    /// drawn as question marks.
    pub(super) fn width(&self, text: &str, size: f64) -> f64 {
        let units: u32 = text.chars().map(|c| u32::from(self.advance(c))).sum();
        f64::from(units) * size / f64::from(self.0.units_per_em())
    }

    fn glyph(&self, letter: char) -> Option<ttf_parser::GlyphId> {
        self.0.glyph_index(letter).or_else(|| self.0.glyph_index('?'))
    }

    fn advance(&self, letter: char) -> u16 {
        self.glyph(letter).and_then(|g| self.0.glyph_hor_advance(g)).unwrap_or(0)
    }

    /// The outlines of `text`, its baseline starting at (x, y).
    pub(super) fn outline(&self, text: &str, size: f64, x: f64, y: f64) -> Option<Path> {
        let scale = size as f32 / f32::from(self.0.units_per_em());
        let mut outline = Outline { builder: PathBuilder::new(), x: 0.0 };
        for letter in text.chars() {
            if let Some(glyph) = self.glyph(letter) {
                self.0.outline_glyph(glyph, &mut outline);
            }
            outline.x += f32::from(self.advance(letter));
        }
        let place = Transform::from_row(scale, 0.0, 0.0, -scale, x as f32, y as f32);
        outline.builder.finish()?.transform(place)
    }
}

struct Outline {
    builder: PathBuilder,
    x: f32,
}

impl OutlineBuilder for Outline {
    fn move_to(&mut self, x: f32, y: f32) {
        self.builder.move_to(self.x + x, y);
    }
    fn line_to(&mut self, x: f32, y: f32) {
        self.builder.line_to(self.x + x, y);
    }
    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.builder.quad_to(self.x + x1, y1, self.x + x, y);
    }
    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.builder.cubic_to(self.x + x1, y1, self.x + x2, y2, self.x + x, y);
    }
    fn close(&mut self) {
        self.builder.close();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_have_width_and_ink() {
        let font = Font::new();
        assert!(font.width("Wi", 10.0) > font.width("ii", 10.0));
        assert_eq!(font.width("é", 10.0), font.width("?", 10.0));
        let bounds = font.outline("A", 100.0, 10.0, 200.0).unwrap().bounds();
        assert!((bounds.bottom() - 200.0).abs() < 1.0 && bounds.height() > 60.0);
    }
}
