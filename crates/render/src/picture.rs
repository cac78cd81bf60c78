//! Pictures with colours and opacity.

/// A picture: rows from the top, four bytes per pixel, red, green, blue and alpha (not multiplied).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// sRGB and alpha.
    pub rgba: Vec<u8>,
}

impl Picture {
    /// Copies `other` with its upper left corner at (`x`, `y`); pixels beyond the edge are left out.
    pub fn paste(&mut self, other: &Self, x: u32, y: u32) {
        let width = other.width.min(self.width.saturating_sub(x)) as usize * 4;
        let rows = other.height.min(self.height.saturating_sub(y)) as usize;
        if width == 0 {
            return;
        }
        for (row, pixels) in other.rgba.chunks_exact(other.width as usize * 4).enumerate().take(rows) {
            let start = ((y as usize + row) * self.width as usize + x as usize) * 4;
            self.rgba[start..start + width].copy_from_slice(&pixels[..width]);
        }
    }
}
