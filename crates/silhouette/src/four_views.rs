//! The four standard views of a tree in one picture.

use crate::bitmap::Bitmap;
use crate::raster::Rasterizer;
use crate::view::{Frame, Projection, View};
use glam::DVec3;
use pleach_plant::{Leaf, Parts, Tree};
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
    let extents = FOUR_VIEWS.map(|view| Extent::new(tree, parts, &view));
    let needed = extents.iter().zip(FOUR_VIEWS).map(|(extent, view)| extent.size(&view));
    let scale = needed.fold(1e-9, f64::max) / (f64::from(quarter.max(1)) * Frame::FILL);
    let mut sheet = Bitmap::new(size, size);
    let (mut rasterizer, mut bitmap) = (Rasterizer::new(), Bitmap::default());
    for ((number, view), extent) in (0..).zip(FOUR_VIEWS).zip(extents) {
        let frame = extent.frame(&view, quarter, scale);
        rasterizer.draw(tree, &view, &frame, parts, &mut bitmap);
        let (left, top) = (number % 2 * quarter, number / 2 * quarter);
        for y in 0..bitmap.height() {
            bitmap.ink_in_row(y).for_each(|x| sheet.set(left + x, top + y, true));
        }
    }
    sheet
}

/// From where to where a tree reaches in a view, in metres to the right of the trunk's foot and above it.
///
/// Closer than the corners of its bounding box, which are far from the tree in a view across.
#[derive(Clone, Copy, Debug)]
struct Extent {
    right: (f64, f64),
    up: (f64, f64),
}

impl Extent {
    fn new(tree: &Tree, parts: Parts, view: &View) -> Self {
        let [right, up, _] = view.axes();
        let mut extent = Self { right: (0.0, 0.0), up: (0.0, 0.0) };
        let mut add = |point: DVec3, radius: f64| {
            for (range, at) in [(&mut extent.right, point.dot(right)), (&mut extent.up, point.dot(up))] {
                *range = (range.0.min(at - radius), range.1.max(at + radius));
            }
        };
        for stem in tree.stems.iter().filter(|stem| parts.has_stem(stem.kind)) {
            tree.knots_of(stem).iter().for_each(|knot| add(knot.point, knot.radius));
        }
        let mut add_shape = |leaf: &Leaf, u: f32, v: f32, w: f32| {
            let point = leaf.position + leaf.across * u + leaf.along * v + leaf.normal() * w;
            add(point.as_dvec3(), 0.0);
        };
        if parts.contains(Parts::LEAVES) {
            for leaf in &tree.leaves {
                tree.outline_of(leaf).corners().iter().for_each(|p| add_shape(leaf, p[0], p[1], 0.0));
            }
        }
        if parts.contains(Parts::BLOSSOMS) {
            for blossom in &tree.blossoms {
                let faces = tree.blossom_shapes[usize::from(blossom.shape)].faces();
                faces.vertices.iter().for_each(|p| add_shape(blossom, p[0], p[1], p[2]));
            }
        }
        if parts.contains(Parts::BLOBS) {
            tree.blob_vertices.iter().for_each(|vertex| add(vertex.as_dvec3(), 0.0));
        }
        extent
    }

    /// Metres across or up that a square picture of the view has to show.
    fn size(&self, view: &View) -> f64 {
        let (right, up) = (self.right, self.up);
        if view.elevation == 0.0 {
            // The foot is in the middle; what hangs below the ground is cut off.
            (2.0 * right.1.max(-right.0)).max(up.1)
        } else {
            (right.1 - right.0).max(up.1 - up.0)
        }
    }

    fn frame(&self, view: &View, quarter: u32, scale: f64) -> Frame {
        let middle = f64::from(quarter) / 2.0;
        let (axis_column, ground_row) = if view.elevation == 0.0 {
            (middle, f64::from(quarter))
        } else {
            let (x, y) = ((self.right.0 + self.right.1) / 2.0, (self.up.0 + self.up.1) / 2.0);
            (middle - x / scale, middle + y / scale)
        };
        Frame { width: quarter, height: quarter, meters_per_pixel: scale, axis_column, ground_row }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;
    use pleach_plant::{Knot, Stem, StemKind};

    /// A straight trunk and a level branch from its top.
    fn gallows(branch: DVec3) -> Tree {
        let top = dvec3(0.0, 0.0, 4.0);
        let mut tree = Tree::default();
        for (parent, kind, ends) in
            [(None, StemKind::Trunk, [DVec3::ZERO, top]), (Some(0), StemKind::Branch, [top, top + branch])]
        {
            let first_knot = tree.knots.len() as u32;
            let level = u16::from(parent.is_some());
            tree.stems.push(Stem { parent, level, kind, number: 0, offset: 0.0, first_knot, knot_count: 2 });
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
        assert!(south.0.abs_diff(above.0) <= 2 && above.1 < 8, "{south:?} {above:?}");
        assert!(south.1.abs_diff(east.1) <= 2, "one scale: {south:?} {east:?}");
        assert!((46..=49).contains(&south.0), "the largest fills 95 % of its side: {south:?}");
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
