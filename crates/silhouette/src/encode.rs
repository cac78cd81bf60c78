//! One-bit PNG.

use crate::bitmap::Bitmap;
use std::io::{self, Write};

impl Bitmap {
    /// Writes the picture as a one-bit grey PNG, black ink on white paper.
    ///
    /// # Errors
    /// What `out` reports.
    pub fn write_png(&self, out: &mut impl Write) -> io::Result<()> {
        let mut encoder = png::Encoder::new(out, self.width().max(1), self.height().max(1));
        encoder.set_color(png::ColorType::Grayscale);
        encoder.set_depth(png::BitDepth::One);
        let mut writer = encoder.write_header()?;
        let bytes = (self.width().max(1) as usize).div_ceil(8);
        let mut data = Vec::with_capacity(bytes * self.height() as usize);
        for y in 0..self.height() {
            // PNG counts pixels from the top bit, and 1 is white.
            let row = self.row(y).iter().flat_map(|w| w.to_le_bytes()).map(|b| !b.reverse_bits());
            data.extend(row.take(bytes));
        }
        data.resize(bytes * self.height().max(1) as usize, 0xff);
        writer.write_image_data(&data)?;
        writer.finish()?;
        Ok(())
    }

    /// The PNG of [`Bitmap::write_png`] in memory.
    #[must_use]
    pub fn to_png(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        self.write_png(&mut bytes).expect("writing to memory does not fail");
        bytes
    }
}
