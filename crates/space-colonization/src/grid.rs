//! Attraction points in cells, so that a node finds those around it.

use glam::DVec3;

/// Most cells along an axis.
const MAX_CELLS: usize = 48;

/// A point and what is known of it, side by side in memory.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Entry {
    place: DVec3,
    pub(crate) number: u32,
    /// Square of the distance of the nearest that was found, or of the radius.
    pub(crate) least: f64,
}

/// Points sorted by cell. Points that were taken are moved behind the others of their cell.
#[derive(Debug, Default)]
pub(crate) struct Grid {
    low: DVec3,
    cell: f64,
    cells: [usize; 3],
    /// First point of each cell, and after the last.
    first: Vec<u32>,
    /// Number of points left in each cell.
    left: Vec<u32>,
    /// The points, cell after cell.
    points: Vec<Entry>,
}

impl Grid {
    /// Sorts `points` into cells for searches within `radius`.
    pub(crate) fn fill(&mut self, points: &[DVec3], radius: f64) {
        let (mut low, mut high) = (DVec3::splat(f64::INFINITY), DVec3::splat(f64::NEG_INFINITY));
        for point in points {
            low = low.min(*point);
            high = high.max(*point);
        }
        let extent = if points.is_empty() { DVec3::ZERO } else { high - low };
        self.low = if points.is_empty() { DVec3::ZERO } else { low };
        self.cell = (0.5 * radius).max(extent.max_element() / (MAX_CELLS as f64 - 1.0)).max(1e-9);
        self.cells = extent.to_array().map(|length| (length / self.cell) as usize + 1);
        let count = self.cells.iter().product::<usize>();
        self.left.clear();
        self.left.resize(count, 0);
        for point in points {
            let cell = self.cell_of(*point);
            self.left[cell] += 1;
        }
        self.first.clear();
        self.first.push(0);
        let mut sum = 0;
        for left in &self.left {
            sum += left;
            self.first.push(sum);
        }
        self.points.clear();
        let blank = Entry { place: DVec3::ZERO, number: 0, least: radius * radius };
        self.points.resize(points.len(), blank);
        self.left.fill(0);
        for (number, point) in points.iter().enumerate() {
            let cell = self.cell_of(*point);
            let slot = self.first[cell] + self.left[cell];
            self.points[slot as usize] = Entry { place: *point, number: number as u32, ..blank };
            self.left[cell] += 1;
        }
    }

    fn cell_of(&self, point: DVec3) -> usize {
        let at = ((point - self.low) / self.cell).to_array();
        let clamp = |axis: usize| (at[axis].max(0.0) as usize).min(self.cells[axis] - 1);
        (clamp(2) * self.cells[1] + clamp(1)) * self.cells[0] + clamp(0)
    }

    /// Looks at the points that are left in the cells within `radius` of `place`: `visit` is told a point, the way
    /// to it and the square of its length, and says whether the point stays. Returns how many were looked at.
    pub(crate) fn around(
        &mut self,
        place: DVec3,
        radius: f64,
        mut visit: impl FnMut(&mut Entry, DVec3, f64) -> bool,
    ) -> u64 {
        let from = ((place - self.low - radius) / self.cell).to_array();
        let to = ((place - self.low + radius) / self.cell).to_array();
        let mut looked = 0;
        if (0..3).any(|axis| to[axis] < 0.0 || from[axis] >= self.cells[axis] as f64) {
            return 1;
        }
        let range =
            |axis: usize| from[axis].max(0.0) as usize..=(to[axis] as usize).min(self.cells[axis] - 1);
        // How far a cell lies from `place` along an axis, at least.
        let off = |axis: usize, cell: usize| {
            let low = self.low[axis] + cell as f64 * self.cell - place[axis];
            low.max(-low - self.cell).max(0.0)
        };
        let squared = |length: f64| length * length;
        let reach = radius * radius;
        for z in range(2) {
            let left = reach - squared(off(2, z));
            for y in range(1) {
                let left = left - squared(off(1, y));
                for x in range(0) {
                    if squared(off(0, x)) > left {
                        continue;
                    }
                    let cell = (z * self.cells[1] + y) * self.cells[0] + x;
                    let first = self.first[cell] as usize;
                    let mut i = 0;
                    while i < self.left[cell] as usize {
                        looked += 1;
                        let entry = &mut self.points[first + i];
                        let to = entry.place - place;
                        if visit(entry, to, to.length_squared()) {
                            i += 1;
                        } else {
                            self.left[cell] -= 1;
                            self.points.swap(first + i, first + self.left[cell] as usize);
                        }
                    }
                }
            }
        }
        looked + 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pleach_tree::Key;

    #[test]
    fn every_point_around_is_found_once() {
        let key = Key::root(5);
        let points: Vec<DVec3> = (0..500)
            .map(|i| DVec3::new(key.unit(0, i), 2.0 * key.unit(1, i), 0.3 * key.unit(2, i)))
            .collect();
        let mut grid = Grid::default();
        grid.fill(&points, 0.2);
        for place in [points[7], DVec3::splat(-0.1), DVec3::new(0.5, 1.9, 0.4), DVec3::splat(9.0)] {
            let mut found = Vec::new();
            grid.around(place, 0.2, |entry, _, squared| {
                if squared < 0.04 {
                    found.push(entry.number);
                }
                true
            });
            found.sort_unstable();
            let expected: Vec<u32> =
                (0..500).filter(|&i| points[i as usize].distance_squared(place) < 0.04).collect();
            assert_eq!(found, expected);
        }
        // What is taken is not seen again.
        let mut taken = 0;
        grid.around(points[7], 0.2, |_, _, squared| {
            taken += u32::from(squared < 0.01);
            squared >= 0.01
        });
        assert!(taken > 0);
        grid.around(points[7], 0.2, |_, _, squared| {
            assert!(squared >= 0.01);
            true
        });
    }
}
