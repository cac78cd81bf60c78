//! Attraction points in cells, so that a node finds those around it.

use glam::{DVec3, Vec3};

/// Most cells along an axis.
const MAX_CELLS: usize = 48;
/// Width of a cell over the radius of searches.
const CELL: f64 = 0.4;

/// A point and what is known of it, side by side in memory. Single precision, so that most crowns stay in the
/// processor's nearest memory.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Entry {
    place: Vec3,
    pub(crate) number: u32,
    /// Square of the distance of the nearest that was found, or of the radius.
    pub(crate) least: f32,
}

/// Points sorted by cell.
#[derive(Debug, Default)]
pub(crate) struct Grid {
    low: DVec3,
    cell: f64,
    cells: [usize; 3],
    /// First point of each cell, and after the last.
    first: Vec<u32>,
    /// Number of points put into each cell so far.
    filled: Vec<u32>,
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
        self.cell = (CELL * radius).max(extent.max_element() / (MAX_CELLS as f64 - 1.0)).max(1e-9);
        self.cells = extent.to_array().map(|length| (length / self.cell) as usize + 1);
        let count = self.cells.iter().product::<usize>();
        self.filled.clear();
        self.filled.resize(count, 0);
        for point in points {
            let cell = self.cell_of(*point);
            self.filled[cell] += 1;
        }
        self.first.clear();
        self.first.push(0);
        let mut sum = 0;
        for filled in &self.filled {
            sum += filled;
            self.first.push(sum);
        }
        self.points.clear();
        let blank = Entry { place: Vec3::ZERO, number: 0, least: (radius * radius) as f32 };
        self.points.resize(points.len(), blank);
        self.filled.fill(0);
        for (number, point) in points.iter().enumerate() {
            let cell = self.cell_of(*point);
            let slot = self.first[cell] + self.filled[cell];
            self.points[slot as usize] = Entry { place: point.as_vec3(), number: number as u32, ..blank };
            self.filled[cell] += 1;
        }
    }

    fn cell_of(&self, point: DVec3) -> usize {
        let at = ((point - self.low) / self.cell).to_array();
        let clamp = |axis: usize| (at[axis].max(0.0) as usize).min(self.cells[axis] - 1);
        (clamp(2) * self.cells[1] + clamp(1)) * self.cells[0] + clamp(0)
    }

    /// Looks at the points in the cells within `radius` of `place`: `visit` is told a point, the way to it and the square
    /// of its length. Returns how many were looked at.
    pub(crate) fn around(
        &mut self,
        place: DVec3,
        radius: f64,
        mut visit: impl FnMut(&mut Entry, Vec3, f32),
    ) -> u64 {
        let (low, cell) = (self.low, self.cell);
        let middle = place.as_vec3();
        // The cells of `axis` within `reach`, if there are any.
        let range = |axis: usize, reach: f64| {
            let from = (place[axis] - reach - low[axis]) / cell;
            let to = (place[axis] + reach - low[axis]) / cell;
            let last = self.cells[axis] - 1;
            let is_beside = to < 0.0 || from > self.cells[axis] as f64;
            if is_beside { 1..1 } else { (from.max(0.0) as usize).min(last)..(to as usize).min(last) + 1 }
        };
        // Distance of a cell along an axis, at least, squared.
        let off = |axis: usize, at: usize| {
            let from = low[axis] + at as f64 * cell - place[axis];
            let off = from.max(-from - cell).max(0.0);
            off * off
        };
        let (squared, mut looked) = (radius * radius, 1);
        for z in range(2, radius) {
            for y in range(1, radius) {
                let left = squared - off(2, z) - off(1, y);
                if left < 0.0 {
                    continue;
                }
                // Cells of a row lie side by side in memory.
                let x = range(0, left.sqrt());
                if x.is_empty() {
                    continue;
                }
                let row = (z * self.cells[1] + y) * self.cells[0];
                let run = self.first[row + x.start] as usize..self.first[row + x.end] as usize;
                looked += run.len() as u64;
                for entry in &mut self.points[run] {
                    let to = entry.place - middle;
                    visit(entry, to, to.length_squared());
                }
            }
        }
        looked
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
            });
            found.sort_unstable();
            let expected: Vec<u32> =
                (0..500).filter(|&i| points[i as usize].distance_squared(place) < 0.04).collect();
            assert_eq!(found, expected);
        }
    }
}
