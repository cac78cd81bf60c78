//! A field sampled on a grid, with an inside that is one piece without pinches.

use super::ellipsoid::Union;
use glam::{DVec3, UVec3, uvec3};

/// Samples of a field, x running fastest. The outermost ones are outside.
#[derive(Debug, Default)]
pub(crate) struct Grid {
    pub(super) low: DVec3,
    pub(super) cell: f64,
    /// Samples along each side.
    pub(super) size: UVec3,
    pub(super) distances: Vec<f64>,
    pub(super) inside: Vec<bool>,
    /// Samples reached by the last flood, and those whose neighbors are still to be looked at.
    reached: Vec<bool>,
    waiting: Vec<u32>,
}

/// Samples along the sides of a grid with cells of `cell` over the bounds of `union`.
fn size_of(union: &Union<'_>, cell: f64) -> (DVec3, UVec3) {
    let (low, high) = union.bounds();
    let low = low - 1.5 * cell;
    (low, ((high + 1.5 * cell - low) / cell).ceil().as_uvec3() + 1)
}

impl Grid {
    /// How many samples [`Grid::sample`] takes.
    pub(crate) fn count(union: &Union<'_>, cell: f64) -> u64 {
        let (_, size) = size_of(union, cell);
        u64::from(size.x) * u64::from(size.y) * u64::from(size.z)
    }

    /// Samples `union` with cells of `cell`. The centers of all parts are inside, and so is a way from
    /// each to the first: ellipsoids that do not touch, or touch in less than a cell, are joined. What
    /// is so thin that samples of it lie apart from the others is left out.
    pub(crate) fn sample(&mut self, union: &Union<'_>, cell: f64) {
        (self.low, self.size) = size_of(union, cell);
        self.cell = cell;
        self.distances.clear();
        for z in 0..self.size.z {
            for y in 0..self.size.y {
                for x in 0..self.size.x {
                    self.distances.push(union.distance(self.at(uvec3(x, y, z).as_dvec3())));
                }
            }
        }
        self.inside.clear();
        self.inside.extend(self.distances.iter().map(|d| *d < 0.0));
        let nearest = |p: DVec3| ((p - self.low) / cell).round().as_uvec3();
        let centers: Vec<UVec3> = union.parts.iter().map(|part| nearest(part.center)).collect();
        for &center in &centers {
            self.join(center, centers[0]);
        }
        self.flood(self.index(centers[0]), true);
        self.inside.copy_from_slice(&self.reached);
        // Each of the two may undo what the other did; both only add to the inside.
        while self.fill_holes() | self.widen_pinches() {}
    }

    /// The point at sample `place`, or between samples.
    pub(super) fn at(&self, place: DVec3) -> DVec3 {
        self.low + place * self.cell
    }

    pub(super) fn index(&self, p: UVec3) -> usize {
        ((p.z * self.size.y + p.y) * self.size.x + p.x) as usize
    }

    /// Steps of an index along x, y and z.
    pub(super) fn strides(&self) -> [usize; 3] {
        [1, self.size.x as usize, (self.size.x * self.size.y) as usize]
    }

    /// Puts a way from `from` to `to` inside: neighbor by neighbor, near the straight line.
    fn join(&mut self, from: UVec3, to: UVec3) {
        let ahead = to.as_dvec3() - from.as_dvec3();
        let (mut at, mut steps) = (from, [0_u32; 3]);
        loop {
            let index = self.index(at);
            self.inside[index] = true;
            // The axis that is least far along.
            let share = |axis: usize| (f64::from(steps[axis]) + 0.5) / ahead[axis].abs();
            let open = (0..3).filter(|&axis| f64::from(steps[axis]) < ahead[axis].abs());
            let Some(axis) = open.min_by(|&a, &b| share(a).total_cmp(&share(b))) else { return };
            steps[axis] += 1;
            at[axis] = if ahead[axis] > 0.0 { at[axis] + 1 } else { at[axis] - 1 };
        }
    }

    /// Marks what can be reached from sample `start` by way of neighbors that are inside, or outside.
    fn flood(&mut self, start: usize, is_inside: bool) {
        self.reached.clear();
        self.reached.resize(self.inside.len(), false);
        self.waiting.clear();
        self.waiting.push(start as u32);
        self.reached[start] = true;
        let (size, strides) = (self.size, self.strides());
        while let Some(index) = self.waiting.pop() {
            let index = index as usize;
            let place = [index % size.x as usize, index / strides[1] % size.y as usize, index / strides[2]];
            for axis in 0..3 {
                let before = (place[axis] > 0).then(|| index - strides[axis]);
                let after = (place[axis] + 1 < size[axis] as usize).then(|| index + strides[axis]);
                for next in [before, after].into_iter().flatten() {
                    if self.inside[next] == is_inside && !self.reached[next] {
                        self.reached[next] = true;
                        self.waiting.push(next as u32);
                    }
                }
            }
        }
    }

    /// Puts inside what cannot be reached from outside. Returns whether there was any.
    fn fill_holes(&mut self) -> bool {
        self.flood(0, false);
        let mut found = false;
        for (inside, reached) in self.inside.iter_mut().zip(&self.reached) {
            found |= !(*inside || *reached);
            *inside |= !*reached;
        }
        found
    }

    /// Puts samples inside until no two cubes of the inside, or of the outside, meet in an edge or a
    /// corner alone (well-composed sets: Latecki 1997). Returns whether there was any. What is added
    /// lies between samples of the inside, so the outermost samples stay outside.
    fn widen_pinches(&mut self) -> bool {
        let strides = self.strides();
        let mut found = false;
        loop {
            let mut changed = false;
            for z in 0..self.size.z - 1 {
                for y in 0..self.size.y - 1 {
                    for x in 0..self.size.x - 1 {
                        changed |= self.widen_pinch(self.index(uvec3(x, y, z)), strides);
                    }
                }
            }
            found |= changed;
            if !changed {
                return found;
            }
        }
    }

    /// Looks at the cell whose lowest sample is `first`.
    fn widen_pinch(&mut self, first: usize, strides: [usize; 3]) -> bool {
        let corner =
            |c: usize| first + (c & 1) * strides[0] + (c >> 1 & 1) * strides[1] + (c >> 2 & 1) * strides[2];
        let corners: [usize; 8] = std::array::from_fn(corner);
        let count = corners.iter().filter(|&&c| self.inside[c]).count();
        if count == 0 || count == 8 {
            return false;
        }
        let mut changed = false;
        for [a, b, c, d] in FACES {
            let [a, b, c, d] = [corners[a], corners[b], corners[c], corners[d]];
            let pair = |i: usize, j: usize| (self.inside[i], self.inside[j]);
            if pair(a, d) == (true, true) && pair(b, c) == (false, false) {
                self.inside[b] = true;
                changed = true;
            } else if pair(a, d) == (false, false) && pair(b, c) == (true, true) {
                self.inside[a] = true;
                changed = true;
            }
        }
        for low in 0..4 {
            let (a, b) = (corners[low], corners[7 - low]);
            let alike = |value: bool| self.inside[a] == value && self.inside[b] == value;
            let others = corners.iter().filter(|&&c| c != a && c != b && self.inside[c]).count();
            if alike(true) && others == 0 {
                // The neighbor of the one that the other one's faces reach.
                self.inside[corners[low ^ 1]] = true;
                changed = true;
            } else if alike(false) && others == 6 {
                self.inside[a] = true;
                changed = true;
            }
        }
        changed
    }
}

/// The faces of a cell by the bits x, y and z of their corners; the first and the last are opposite.
const FACES: [[usize; 4]; 6] =
    [[0, 1, 2, 3], [4, 5, 6, 7], [0, 1, 4, 5], [2, 3, 6, 7], [0, 2, 4, 6], [1, 3, 5, 7]];
