//! What an alpha channel says of a picture: which part is the tree, or nothing at all.
//!
//! Programs make pixels transparent for other reasons than to cut something out: a picture is turned, and
//! its corners are empty; corners are rounded. And stencils have a hole where the tree is.

use super::shape;
use crate::bitmap::Bitmap;
use crate::pieces;

/// What the opaque part of a picture is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Alpha {
    /// The tree, cut out of its background.
    Tree,
    /// What is around the tree: that is the hole.
    Around,
    /// A whole picture, whose edges or corners are missing.
    Picture,
}

/// Opacities from which on a pixel is opaque.
pub(crate) const OPAQUE: u8 = 128;
/// A picture of which more is opaque has nothing cut out of it.
const WHOLE: f64 = 0.98;
/// A picture that was turned or has round corners is convex: this part of its convex hull is opaque ...
const CONVEX: f64 = 0.97;
/// ... it takes at least this part of the whole ...
const LARGE: f64 = 0.5;
/// ... and has tones at least this far apart, leaving out one in two hundred of the darkest and of the
/// lightest. A cut-out of one tone is a silhouette.
const RANGE: u32 = 64;
const TAIL: f64 = 0.005;
/// What surrounds a hole has this part of the left, top and right edges.
const SURROUNDS: f64 = 0.65;
/// A hole in the form of a tree is at least this part of the picture ...
const HOLE: f64 = 0.02;
/// ... at least this part of its height ...
const TALL: f64 = 0.25;
/// ... and more than this part of all that is transparent; gaps in a crown are many.
const MOST: f64 = 0.6;

/// What the opaque part, `opaque`, of a picture of the brightnesses `light` is.
pub(crate) fn role(opaque: &Bitmap, light: impl Fn(u32, u32) -> u8) -> Alpha {
    let share = opaque.ink() as f64 / opaque.area() as f64;
    if share == 0.0 {
        return Alpha::Tree;
    }
    if edge_share(opaque) >= SURROUNDS && has_a_hole(opaque) {
        return Alpha::Around;
    }
    let is_convex = || share >= LARGE && shape::solidity(opaque) >= CONVEX;
    if (share > WHOLE || is_convex()) && range(opaque, light) >= RANGE { Alpha::Picture } else { Alpha::Tree }
}

/// The pixels whose colours are those of the picture: opaque, and away from where a rim was blended.
pub(crate) fn certain(width: u32, height: u32, opacity: impl Fn(u32, u32) -> u8) -> Bitmap {
    const RIM: u32 = 2;
    let doubtful = Bitmap::from_fn(width, height, |x, y| opacity(x, y) < 250);
    let wide = pieces::widened(&doubtful, RIM);
    Bitmap::from_fn(width, height, |x, y| !wide.get(x, y))
}

/// Part of the left, top and right edges that is ink.
fn edge_share(ink: &Bitmap) -> f64 {
    let (width, height) = (ink.width(), ink.height());
    let side = |x| (0..height).filter(|&y| ink.get(x, y)).count();
    let inked = side(0) + side(width - 1) + ink.ink_in_row(0).count();
    inked as f64 / f64::from(2 * height + width)
}

/// Whether most of what is transparent is one piece away from the left, top and right edges.
fn has_a_hole(opaque: &Bitmap) -> bool {
    let (width, height) = (opaque.width(), opaque.height());
    let clear = Bitmap::from_fn(width, height, |x, y| !opaque.get(x, y));
    let Some(largest) = pieces::piece(&clear, &clear, None) else { return false };
    let Some((left, top, right, bottom)) = largest.ink_box() else { return false };
    let is_inside = left > 0 && top > 0 && right + 1 < width;
    let size = largest.ink() as f64;
    is_inside
        && size >= HOLE * opaque.area() as f64
        && size > MOST * clear.ink() as f64
        && f64::from(bottom + 1 - top) >= TALL * f64::from(height)
}

/// How far apart the opaque part's tones are.
fn range(opaque: &Bitmap, light: impl Fn(u32, u32) -> u8) -> u32 {
    let mut histogram = [0_u64; 256];
    for y in 0..opaque.height() {
        for x in opaque.ink_in_row(y) {
            histogram[usize::from(light(x, y))] += 1;
        }
    }
    let tail = (TAIL * opaque.ink() as f64) as u64;
    let beyond = |levels: &mut dyn Iterator<Item = u64>| {
        let mut sum = 0;
        levels
            .take_while(|count| {
                sum += count;
                sum <= tail
            })
            .count() as u32
    };
    let darkest = beyond(&mut histogram.iter().copied());
    let lightest = 255_u32.saturating_sub(beyond(&mut histogram.iter().rev().copied()));
    lightest.saturating_sub(darkest)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIDE: u32 = 100;

    fn tree(x: u32, y: u32) -> bool {
        (46..54).contains(&x) && (20..90).contains(&y) || x.abs_diff(50) + y.abs_diff(40) < 25
    }

    fn shown(x: u32, y: u32) -> u8 {
        if tree(x, y) { 20 } else { 200 }
    }

    fn opaque(is: impl Fn(u32, u32) -> bool) -> Bitmap {
        Bitmap::from_fn(SIDE, SIDE, is)
    }

    #[test]
    fn cut_out_trees_are_trees_and_holes_are_trees() {
        assert_eq!(role(&opaque(tree), shown), Alpha::Tree);
        assert_eq!(role(&opaque(|x, y| !tree(x, y)), shown), Alpha::Around);
        // A crown with gaps that fills the picture.
        let crown = opaque(|x, y| y > 90 || (x % 9 > 2 || y % 9 > 2) && x + y > 12 && x < y + 88);
        assert_eq!(role(&crown, |_, _| 40), Alpha::Tree);
        // A square of one tone.
        assert_eq!(role(&opaque(|x, y| x > 20 && y > 10), |_, _| 90), Alpha::Tree);
    }

    #[test]
    fn turned_and_rounded_pictures_are_whole_pictures() {
        for slope in [0.02, 0.1, 0.3] {
            let turned = opaque(|x, y| {
                let (x, y) = (f64::from(x) - 49.5, f64::from(y) - 49.5);
                let half = 49.0 / (1.0 + slope);
                (x + slope * y).abs() < half && (y - slope * x).abs() < half
            });
            assert_eq!(role(&turned, shown), Alpha::Picture, "{slope}");
        }
        let rounded = opaque(|x, y| {
            let away = |at: u32| (12.0 - f64::from(at.min(SIDE - 1 - at))).max(0.0);
            away(x).hypot(away(y)) < 12.0
        });
        assert_eq!(role(&rounded, shown), Alpha::Picture);
        assert_eq!(role(&opaque(|x, y| x + y > 2), shown), Alpha::Picture);
    }
}
