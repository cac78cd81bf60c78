//! The four standard views of a tree in one picture.

use crate::bitmap::Bitmap;
use crate::raster::Rasterizer;
use crate::view::{Frame, Projection, View};
use pleach_tree::{Parts, Tree};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

/// From the south, the south-east and the east, with +x east and +y north, and from above, north at the
/// top: the views that the listing of Coffey 2025, Figure 24, draws. (Its text calls the second and the
/// third south-west and west, which its own coordinates are not.)
pub const FOUR_VIEWS: [View; 4] = [level(0.0), level(FRAC_PI_4), level(FRAC_PI_2), ABOVE];

const ABOVE: View = View { azimuth: 0.0, elevation: FRAC_PI_2, projection: Projection::Orthographic };

const fn level(azimuth: f64) -> View {
    View { azimuth, elevation: 0.0, projection: Projection::Orthographic }
}

/// The [`FOUR_VIEWS`] of `parts` of a tree in the quarters of a picture of `size` × `size` pixels, row by
/// row, all at one scale.
///
/// In a level view the ground is the quarter's bottom edge and the trunk's foot in its middle; the view
/// from above has the middle of what is seen in the middle. Where `size` is odd, the last column and row
/// are empty.
#[must_use]
pub fn four_views(tree: &Tree, parts: Parts, size: u32) -> Bitmap {
    let quarter = size / 2;
    let mut frames = FOUR_VIEWS.map(|view| Frame::automatic(tree, &view, parts, quarter, quarter));
    let scale = frames.iter().map(|frame| frame.meters_per_pixel).fold(0.0, f64::max);
    for (frame, view) in frames.iter_mut().zip(FOUR_VIEWS) {
        *frame = if view.elevation == 0.0 {
            Frame { meters_per_pixel: scale, ..*frame }
        } else {
            centered(tree, parts, quarter, scale)
        };
    }
    let mut sheet = Bitmap::new(size, size);
    let (mut rasterizer, mut bitmap) = (Rasterizer::new(), Bitmap::default());
    for ((number, view), frame) in (0..).zip(FOUR_VIEWS).zip(frames) {
        rasterizer.draw(tree, &view, &frame, parts, &mut bitmap);
        let (left, top) = (number % 2 * quarter, number / 2 * quarter);
        for y in 0..bitmap.height() {
            bitmap.ink_in_row(y).for_each(|x| sheet.set(left + x, top + y, true));
        }
    }
    sheet
}

/// The frame of the view from above with the middle of the tree in the middle.
fn centered(tree: &Tree, parts: Parts, quarter: u32, scale: f64) -> Frame {
    let middle = f64::from(quarter) / 2.0;
    let bounds = pleach_tree::stats::Bounds::new(tree, parts);
    let [x, y] = bounds.map_or([0.0; 2], |b| [(b.min.x + b.max.x) / 2.0, (b.min.y + b.max.y) / 2.0]);
    Frame {
        width: quarter,
        height: quarter,
        meters_per_pixel: scale,
        axis_column: middle - x / scale,
        ground_row: middle + y / scale,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec3, dvec3};
    use pleach_tree::{Knot, Stem, StemKind};

    /// A straight trunk and a level branch from its top.
    fn gallows(branch: DVec3) -> Tree {
        let top = dvec3(0.0, 0.0, 4.0);
        let mut tree = Tree::default();
        for (parent, kind, ends) in
            [(None, StemKind::Trunk, [DVec3::ZERO, top]), (Some(0), StemKind::Branch, [top, top + branch])]
        {
            let first_knot = tree.knots.len() as u32;
            let level = u16::from(parent.is_some());
            tree.stems.push(Stem { parent, level, kind, offset: 0.0, first_knot, knot_count: 2 });
            tree.knots.extend(ends.map(|point| Knot {
                point,
                handle_in: point,
                handle_out: point,
                radius: 0.1,
            }));
        }
        tree
    }

    /// Width and height of the ink in each quarter.
    fn extents(sheet: &Bitmap) -> Vec<(u32, u32)> {
        let half = sheet.width() / 2;
        let extent = |number: u32| {
            let (left, top) = (number % 2 * half, number / 2 * half);
            let quarter = Bitmap::from_fn(half, half, |x, y| sheet.get(left + x, top + y));
            let (x0, y0, x1, y1) = quarter.ink_box().unwrap();
            (x1 - x0 + 1, y1 - y0 + 1)
        };
        (0..4).map(extent).collect()
    }

    #[test]
    fn views_are_from_where_they_are_said_to_be_and_at_one_scale() {
        let [south, south_east, east, above] =
            extents(&four_views(&gallows(dvec3(3.0, 0.0, 0.0)), Parts::LEAFY, 200)).try_into().unwrap();
        assert!(south.0 > 4 * east.0, "a branch to the east is seen end on from there: {south:?} {east:?}");
        let ratio = f64::from(south_east.0) / f64::from(south.0);
        assert!((0.65..0.8).contains(&ratio), "{ratio}");
        assert!(south.0.abs_diff(above.0) <= 1 && above.1 < 8, "{south:?} {above:?}");
        assert!(south.1.abs_diff(east.1) <= 1, "one scale: {south:?} {east:?}");
        // Towards the south-east: end on from there.
        let sheet = four_views(&gallows(dvec3(2.0, -2.0, 0.0)), Parts::LEAFY, 200);
        assert!(extents(&sheet)[1].0 < 10, "{:?}", extents(&sheet));
    }

    #[test]
    fn an_odd_size_and_no_tree_at_all_are_drawn() {
        let sheet = four_views(&gallows(dvec3(1.0, 1.0, 0.0)), Parts::LEAFY, 101);
        assert_eq!((sheet.width(), sheet.height()), (101, 101));
        assert!((0..101).all(|i| !sheet.get(100, i) && !sheet.get(i, 100)));
        assert_eq!(four_views(&Tree::default(), Parts::LEAFY, 64).ink(), 0);
    }
}
