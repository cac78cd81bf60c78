//! The visual hull of one tree: where pictures show ink, and how much.
//!
//! A point is in the hull if every picture has ink where the point would be seen (Laurentini 1994, *The visual hull
//! concept for silhouette-based image understanding*). Pictures are coarse here, and their cells say how dense the ink
//! is, so that a crown that grows into a hull has the gaps of its pictures, too.

use super::draw::rounded;
use crate::math;
use glam::{DVec2, DVec3};

/// What a cell has where the ink is densest.
pub const DENSEST: u8 = 9;

/// One picture of a hull: a level view without perspective. Lengths are over the tree's height.
#[derive(Clone, Debug, PartialEq)]
pub struct HullView {
    /// From where it is taken, in radians as those of cameras: 0 looks along +y with +x to the right.
    pub azimuth: f64,
    /// Width and height of a cell.
    pub cell: f64,
    /// Where the first column begins, to the right of the trunk's foot.
    pub left: f64,
    /// Cells from the ground up, row by row, from left to right: 0, nothing, to [`DENSEST`].
    pub rows: Vec<Vec<u8>>,
}

impl HullView {
    /// The azimuth in degrees, to the places that files write.
    #[must_use]
    pub fn degrees(&self) -> f64 {
        rounded(self.azimuth.to_degrees())
    }

    /// The same with numbers as short as a file has them.
    fn rounded(self) -> Self {
        let azimuth = self.degrees().to_radians();
        Self { azimuth, cell: rounded(self.cell), left: rounded(self.left), ..self }
    }

    /// Towards the right of the picture.
    #[must_use]
    pub fn right(&self) -> DVec2 {
        let (sin, cos) = math::sin_cos(self.azimuth);
        DVec2::new(cos, sin)
    }

    /// What the picture has at `across`, to the right of the foot, and height `z`.
    #[must_use]
    pub fn density(&self, across: f64, z: f64) -> u8 {
        let (column, row) = ((across - self.left) / self.cell, z / self.cell);
        if column < 0.0 || row < 0.0 {
            return 0;
        }
        // A float that is too large becomes the largest integer, which is beyond every row.
        let cell = self.rows.get(row as usize).and_then(|row| row.get(column as usize));
        cell.copied().unwrap_or(0)
    }

    /// From where to where the picture has anything at height `z`; `None` in an empty row.
    #[must_use]
    pub fn extent(&self, z: f64) -> Option<(f64, f64)> {
        if z < 0.0 {
            return None;
        }
        let row = self.rows.get((z / self.cell) as usize)?;
        let first = row.iter().position(|&cell| cell > 0)?;
        let last = row.iter().rposition(|&cell| cell > 0)?;
        let at = |column: usize| self.left + column as f64 * self.cell;
        Some((at(first), at(last + 1)))
    }

    /// Heights between which the picture has anything; `None` if it has nothing.
    #[must_use]
    pub fn rise(&self) -> Option<(f64, f64)> {
        let has_ink = |row: &Vec<u8>| row.iter().any(|&cell| cell > 0);
        let first = self.rows.iter().position(has_ink)?;
        let last = self.rows.iter().rposition(has_ink)?;
        Some((first as f64 * self.cell, (last + 1) as f64 * self.cell))
    }
}

/// The hull of a crown, and the course of its trunk. Lengths are over the tree's height, from the trunk's foot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hull {
    /// Its pictures, at least one. Widths follow from the first.
    pub views: Vec<HullView>,
    /// Where the first picture shows the trunk: to the right, and up, from the ground upwards. Empty where it is not
    /// seen.
    pub trunk: Vec<[f64; 2]>,
    /// Seed of the draws by which the crown fills it; 0: the tree's own.
    pub seed: u32,
}

impl Hull {
    /// Most cells of a picture in each direction.
    pub const MAX_CELLS: usize = 256;
    /// Most pictures.
    pub const MAX_VIEWS: usize = 16;
    /// Most points of a trunk.
    pub const MAX_POINTS: usize = 256;

    /// The same with numbers as short as a file has them, so that a tree is the one that its file grows.
    #[must_use]
    pub fn rounded(self) -> Self {
        let views = self.views.into_iter().map(HullView::rounded).collect();
        let trunk = self.trunk.into_iter().map(|point| point.map(rounded)).collect();
        Self { views, trunk, ..self }
    }

    /// Density at a place, 0..=1: the least of all pictures.
    #[must_use]
    pub fn density(&self, place: DVec3) -> f64 {
        let least =
            self.views.iter().map(|view| view.density(place.truncate().dot(view.right()), place.z)).min();
        f64::from(least.unwrap_or(0)) / f64::from(DENSEST)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    fn view(azimuth: f64, rows: &[&[u8]]) -> HullView {
        HullView { azimuth, cell: 0.25, left: -0.5, rows: rows.iter().map(|row| row.to_vec()).collect() }
    }

    #[test]
    fn a_cell_is_found_by_its_place() {
        let view = view(0.0, &[&[0, 0, 0, 0], &[0, 9, 3, 0], &[0, 0, 5, 0], &[0, 0, 0, 0]]);
        assert_eq!((view.density(-0.1, 0.3), view.density(0.1, 0.3), view.density(0.1, 0.6)), (9, 3, 5));
        assert_eq!((view.density(-0.6, 0.3), view.density(0.1, -0.1), view.density(9.0, 1e300)), (0, 0, 0));
        assert_eq!((view.extent(0.3), view.extent(0.6)), (Some((-0.25, 0.25)), Some((0.0, 0.25))));
        assert_eq!((view.extent(0.9), view.extent(-1.0), view.rise()), (None, None, Some((0.25, 0.75))));
    }

    #[test]
    fn a_place_is_in_the_hull_if_all_pictures_have_it() {
        let front = view(0.0, &[&[0, 9, 9, 0]]);
        let side = view(FRAC_PI_2, &[&[0, 0, 3, 9]]);
        let hull = Hull { views: vec![front, side], ..Hull::default() };
        let density = |x, y| hull.density(DVec3::new(x, y, 0.1));
        assert_eq!((density(0.1, 0.1), density(0.1, 0.3), density(0.1, -0.1)), (3.0 / 9.0, 1.0, 0.0));
        assert_eq!(density(0.3, 0.1), 0.0);
        assert_eq!(Hull::default().density(DVec3::ZERO), 0.0);
    }
}
