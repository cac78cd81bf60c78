//! A rectangle of a picture.

use super::photo::Photo;

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct PixelBox {
    /// First column, from 0 at the left.
    pub x: u32,
    /// First row, from 0 at the top.
    pub y: u32,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

impl PixelBox {
    /// Whether a pixel is inside.
    #[must_use]
    pub const fn contains(&self, x: u32, y: u32) -> bool {
        x >= self.x && y >= self.y && x - self.x < self.width && y - self.y < self.height
    }

    /// The whole of a picture.
    pub(super) const fn whole(photo: &Photo) -> Self {
        Self { x: 0, y: 0, width: photo.width(), height: photo.height() }
    }

    /// The box with some pixels more on each side, as far as the picture goes.
    pub(super) fn widened(self, by: u32, photo: &Photo) -> Self {
        let (x, y) = (self.x.saturating_sub(by), self.y.saturating_sub(by));
        let end = |start: u32, side: u32, most: u32| start.saturating_add(side).saturating_add(by).min(most);
        Self {
            x,
            y,
            width: end(self.x, self.width, photo.width()) - x,
            height: end(self.y, self.height, photo.height()) - y,
        }
    }
}
