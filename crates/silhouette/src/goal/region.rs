//! The part of the world that a goal shows: the tree with paper around it, whatever the picture's own margins are.
//!
//! A search sees only what is in its picture. Where a picture ends at the crown, branches beyond the edge cost
//! nothing; where the tree is small in it, most of the working picture is paper. So a picture that leaves no room
//! beside the tree, or too much, is replaced by one with the tree in the middle of a fixed margin. A picture that
//! leaves room is taken as it is, so that its scores are those of the file.

use crate::bitmap::Bitmap;

/// What of a picture is compared with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Crop {
    /// The picture as it came.
    #[default]
    Keep,
    /// The tree and a margin, unless the picture has about that already.
    ToTree,
}

/// Paper on the left and on the right of the tree, as a part of the larger of its height and width.
const BESIDE: f64 = 0.25;
/// Part of the height of the region, or of its width without margins, that the tree fills.
const FILL: f64 = 0.95;
/// A picture is taken as it is if it has at least this much paper on either side, in the same unit …
const ENOUGH_BESIDE: f64 = 0.1;
/// … and the tree fills at least this part of its longer side.
const ENOUGH_FILLED: f64 = 0.6;

/// A part of a picture, which may reach beyond its edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Region {
    /// Column and row of the picture that the region's first pixel is.
    pub(super) left: i64,
    pub(super) top: i64,
    pub(super) width: u32,
    pub(super) height: u32,
}

impl Region {
    /// All of a picture.
    pub(super) fn whole(ink: &Bitmap) -> Self {
        Self { left: 0, top: 0, width: ink.width(), height: ink.height() }
    }

    /// The region around a tree whose ink lies in columns `left..=right` and rows `top..=bottom`, and that stands
    /// at `ground_row`; all of the picture if that is as good.
    pub(super) fn around_tree(
        ink: &Bitmap,
        (left, top, right, bottom): (u32, u32, u32, u32),
        ground_row: f64,
    ) -> Self {
        // What hangs below a ground set by hand is tree all the same; paper below the ground shows nothing.
        let floor = i64::from(bottom + 1).max(ground_row.ceil() as i64);
        let (left, top, right) = (i64::from(left), i64::from(top), i64::from(right) + 1);
        let size = (right - left).max(floor - top) as f64;
        let (width, height) = (i64::from(ink.width()), i64::from(ink.height()));
        let narrowest = left.min(width - right) as f64;
        let is_filled = size >= ENOUGH_FILLED * width.max(height) as f64;
        if is_filled && narrowest >= ENOUGH_BESIDE * size {
            return Self::whole(ink);
        }
        let beside = (BESIDE * size).ceil() as i64;
        let above = (size * (1.0 / FILL - 1.0)).ceil() as i64;
        Self {
            left: left - beside,
            top: top - above,
            width: (right - left + 2 * beside) as u32,
            height: (floor - top + above) as u32,
        }
    }

    /// Whether it is all of `ink` and no more.
    pub(super) fn is_whole(&self, ink: &Bitmap) -> bool {
        *self == Self::whole(ink)
    }

    /// How many pixels the tree's longer side has where the longer side of a picture has `side`: a wide crown has
    /// its margins on top.
    pub(super) fn tree_side(side: u32) -> f64 {
        FILL * f64::from(side)
    }

    /// The picture in the region: paper beyond its edges.
    pub(super) fn cut(&self, ink: &Bitmap) -> Bitmap {
        let mut out = Bitmap::new(self.width, self.height);
        for y in 0..self.height {
            let Ok(row) = u32::try_from(self.top + i64::from(y)) else { continue };
            if row >= ink.height() {
                break;
            }
            for column in ink.ink_in_row(row) {
                let x = i64::from(column) - self.left;
                if (0..i64::from(self.width)).contains(&x) {
                    out.set(x as u32, y, true);
                }
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A crown on a trunk, `left` and `above` from the upper left corner.
    fn tree(width: u32, height: u32, left: u32, above: u32) -> Bitmap {
        Bitmap::from_fn(width, height, |x, y| {
            let (x, y) = (x.wrapping_sub(left), y.wrapping_sub(above));
            x < 60 && y < 50 || (28..32).contains(&x) && y < 100
        })
    }

    fn region(ink: &Bitmap) -> Region {
        let bounds = ink.ink_box().unwrap();
        Region::around_tree(ink, bounds, f64::from(bounds.3 + 1))
    }

    #[test]
    fn a_tight_crop_and_a_wide_picture_have_the_same_region() {
        let tight = tree(60, 100, 0, 0);
        let cut = region(&tight).cut(&tight);
        assert_eq!((cut.width(), cut.height(), cut.ink()), (110, 106, tight.ink()));
        for (width, height, left, above) in [(132, 220, 36, 60), (1000, 700, 300, 13), (60, 400, 0, 300)] {
            let wide = tree(width, height, left, above);
            let found = region(&wide);
            assert!(!found.is_whole(&wide));
            assert!(found.cut(&wide) == cut, "{width} by {height}");
        }
    }

    #[test]
    fn a_picture_with_room_is_taken_as_it_is() {
        let roomy = tree(106, 106, 20, 6);
        assert!(region(&roomy).is_whole(&roomy));
    }
}
