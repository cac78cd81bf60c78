//! Whether a picture is drawn in flat colours, as icons are.

use pleach_silhouette::Bitmap;
use pleach_silhouette::mask::Photo;

/// Largest difference of two pixels of one colour, in levels of 255.
const SAME: u8 = 2;

/// The part of the pixels of `tree` that have the colour of the ones to the right and below, of those that have such
/// neighbours in the tree; `None` where no pixel has.
pub(super) fn flat_share(photo: &Photo, tree: &Bitmap) -> Option<f64> {
    let (width, height) = (tree.width(), tree.height());
    let pixel = |x: u32, y: u32| photo.pixels()[y as usize * width as usize + x as usize];
    let is_same = |one: [u8; 4], other: [u8; 4]| one.iter().zip(other).all(|(a, b)| a.abs_diff(b) <= SAME);
    let (mut all, mut same) = (0_u64, 0_u64);
    for y in 0..height.saturating_sub(1) {
        for x in tree.ink_in_row(y) {
            if x + 1 < width && tree.get(x + 1, y) && tree.get(x, y + 1) {
                let own = pixel(x, y);
                all += 1;
                same += u64::from(is_same(own, pixel(x + 1, y)) && is_same(own, pixel(x, y + 1)));
            }
        }
    }
    (all > 0).then(|| same as f64 / all as f64)
}
