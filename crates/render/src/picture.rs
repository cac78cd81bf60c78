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

/// Whether a picture of normals is painted beside the colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relief {
    /// Colours alone.
    Omitted,
    /// Colours and normals.
    Painted,
}

impl Picture {
    /// A picture that shows nothing.
    pub(crate) fn transparent(width: u32, height: u32) -> Self {
        Self { width, height, rgba: vec![0; (width * height * 4) as usize] }
    }

    /// A picture of directions that all look towards the viewer.
    pub(crate) fn towards_viewer(width: u32, height: u32) -> Self {
        let pixels = (width * height) as usize;
        Self { width, height, rgba: [128, 128, 255, 255].repeat(pixels) }
    }

    /// Gives transparent pixels the mean colour of the others: filters mix it into the edges.
    pub(crate) fn bleed(&mut self) {
        let (mut sum, mut weight) = ([0_u64; 3], 0);
        for pixel in self.rgba.chunks_exact(4) {
            let alpha = u64::from(pixel[3]);
            (0..3).for_each(|c| sum[c] += u64::from(pixel[c]) * alpha);
            weight += alpha;
        }
        let mean = sum.map(|s| (s / weight.max(1)) as u8);
        for pixel in self.rgba.chunks_exact_mut(4).filter(|p| p[3] == 0) {
            pixel[..3].copy_from_slice(&mean);
        }
    }

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
