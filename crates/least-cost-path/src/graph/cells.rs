//! A grid of cells over a box, for finding what is near.

use glam::DVec3;

/// A grid of cubic cells.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cells {
    low: DVec3,
    per_meter: f64,
    pub(crate) dims: [usize; 3],
    /// Whether they are larger than asked for, so that there are not more than allowed.
    pub(crate) is_coarse: bool,
}

impl Cells {
    /// Cells of at least `side` over the box, at most `max` of them: larger ones where there would be
    /// more.
    pub(crate) fn new(low: DVec3, high: DVec3, side: f64, max: usize) -> Self {
        let size = (high - low).max(DVec3::splat(1e-9));
        let wanted = side;
        let mut side = side.max(size.max_element() * 1e-6);
        loop {
            let dims = (size / side).floor() + DVec3::ONE;
            if dims.x * dims.y * dims.z <= max as f64 {
                return Self {
                    low,
                    per_meter: 1.0 / side,
                    dims: [dims.x as usize, dims.y as usize, dims.z as usize],
                    is_coarse: side > wanted,
                };
            }
            side *= 1.25;
        }
    }

    /// Number of cells.
    pub(crate) const fn len(&self) -> usize {
        self.dims[0] * self.dims[1] * self.dims[2]
    }

    /// The cell of `p`, the nearest one if it is outside.
    pub(crate) fn at(&self, p: DVec3) -> [usize; 3] {
        let cell = (p - self.low) * self.per_meter;
        let clamped = |value: f64, len: usize| (value.max(0.0) as usize).min(len - 1);
        [clamped(cell.x, self.dims[0]), clamped(cell.y, self.dims[1]), clamped(cell.z, self.dims[2])]
    }

    /// The number of a cell; along x they are consecutive.
    pub(crate) const fn number(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.dims[1] + y) * self.dims[0] + x
    }

    /// The cell of a number.
    pub(crate) const fn place(&self, number: usize) -> [usize; 3] {
        let [x, y, _] = self.dims;
        [number % x, number / x % y, number / (x * y)]
    }

    /// The rows of cells at most `reach` cells away from `cell`: first and last cell of each.
    pub(crate) fn rows(&self, cell: [usize; 3], reach: usize) -> impl Iterator<Item = (usize, usize)> + '_ {
        let range = move |axis: usize| {
            cell[axis].saturating_sub(reach)..=(cell[axis] + reach).min(self.dims[axis] - 1)
        };
        let (first, last) = (*range(0).start(), *range(0).end());
        range(2)
            .flat_map(move |z| range(1).map(move |y| (self.number([first, y, z]), self.number([last, y, z]))))
    }
}
