//! How much sky reaches a place in the crown: a coarse grid of leaf and bark area, marched through in
//! a few directions.

use glam::{IVec3, UVec3, Vec3, ivec3, uvec3, vec3};
use rayon::prelude::*;

/// Cells along the longest side of a whole crown.
pub(crate) const CELLS: u32 = 44;
/// Light that passes a cell: e to the minus this, per square metre of leaf and cubic metre of cell,
/// and metre of way. Leaves at all angles hide half of their area (Monsi and Saeki 1953).
const EXTINCTION: f32 = 0.5;
/// Leaves scatter and pass light on, so a crown is brighter inside than black discs would make it.
const SOFTNESS: f32 = 0.55;

/// Light from the sky, cell by cell: 0 in the dark to 1 in the open.
#[derive(Clone, Debug)]
pub(crate) struct Crown {
    origin: Vec3,
    cell: f32,
    size: UVec3,
    sky: Vec<f32>,
}

impl Crown {
    /// From points with the area in square metres that each stands for, with so many cells along the longest side.
    pub(crate) fn new(low: Vec3, high: Vec3, cells: u32, areas: impl Iterator<Item = (Vec3, f32)>) -> Self {
        let extent = (high - low).max(Vec3::splat(1e-3));
        let cell = extent.max_element() / cells as f32;
        let size = (extent / cell).ceil().as_uvec3() + uvec3(2, 2, 2);
        let mut crown = Self { origin: low - cell, cell, size, sky: Vec::new() };
        let mut density = vec![0.0_f32; (size.x * size.y * size.z) as usize];
        for (at, area) in areas {
            if let Some(index) = crown.index(crown.cell_of(at)) {
                density[index] += area;
            }
        }
        let per_cell = EXTINCTION * SOFTNESS / (cell * cell);
        density.iter_mut().for_each(|d| *d *= per_cell);
        crown.sky = crown.light(&density);
        crown
    }

    fn cell_of(&self, at: Vec3) -> IVec3 {
        floor((at - self.origin) / self.cell)
    }

    fn index(&self, cell: IVec3) -> Option<usize> {
        let UVec3 { x, y, z } = self.size;
        let inside = cell.cmpge(IVec3::ZERO).all() && cell.cmplt(self.size.as_ivec3()).all();
        let _ = z;
        inside.then(|| ((cell.z as u32 * y + cell.y as u32) * x + cell.x as u32) as usize)
    }

    /// Marches from every cell towards the sky and a little below the horizon.
    fn light(&self, density: &[f32]) -> Vec<f32> {
        // Directions that share the upper half sphere evenly, with their weights: overhead counts
        // most, and the ground sends some light back.
        let golden = 2.399_963;
        let directions: Vec<(Vec3, f32)> = (0..18)
            .map(|i| {
                let z = -0.3 + 1.3 * (i as f32 + 0.5) / 18.0;
                let (sin, cos) = (golden * i as f32).sin_cos();
                let level = (1.0 - z * z).sqrt();
                (vec3(cos * level, sin * level, z), if z > 0.0 { 0.4 + 0.6 * z } else { 0.25 })
            })
            .collect();
        let total: f32 = directions.iter().map(|d| d.1).sum();
        let size = self.size.as_ivec3();
        let ways: Vec<(Way, f32)> =
            directions.into_iter().map(|(direction, weight)| (Way::new(direction, size), weight)).collect();
        let (nx, ny) = (size.x as usize, size.y as usize);
        (0..density.len())
            .into_par_iter()
            .map(|i| {
                let cell = [i % nx, i / nx % ny, i / (nx * ny)];
                let through = |(way, weight): &(Way, f32)| {
                    // Half of the cell itself, then one step per cell.
                    let mut depth = density[i] * 0.5;
                    for offset in way.from(cell) {
                        depth += density[i.wrapping_add_signed(*offset)];
                        if depth >= 4.0 {
                            break;
                        }
                    }
                    weight * (-depth).exp()
                };
                ways.iter().map(through).sum::<f32>() / total
            })
            .collect()
    }

    /// Light from the sky at `at`, smooth between cells.
    pub(crate) fn sky_at(&self, at: Vec3) -> f32 {
        let place = (at - self.origin) / self.cell - 0.5;
        let base = floor(place);
        let part = place - base.as_vec3();
        let mut sum = 0.0;
        for corner in 0..8 {
            let step = ivec3(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
            let weight = |axis: usize| if step[axis] == 1 { part[axis] } else { 1.0 - part[axis] };
            let sky = self.index(base + step).map_or(1.0, |i| self.sky[i]);
            sum += sky * weight(0) * weight(1) * weight(2);
        }
        sum
    }
}

/// The cells that lie in one direction from the middle of a cell, one step of a cell's side after the other. They are the
/// same from every cell, but for how soon the grid ends.
struct Way {
    /// From the number of the first cell to those of the others.
    offsets: Vec<isize>,
    /// By axis, and by where the first cell is on it: how many of the others are inside.
    inside: [Vec<usize>; 3],
}

impl Way {
    fn new(direction: Vec3, size: IVec3) -> Self {
        let longest = size.max_element();
        let cells: Vec<IVec3> =
            (1..=2 * longest).map(|step| floor(Vec3::splat(0.5) + direction * step as f32)).collect();
        let inside = [0, 1, 2].map(|axis| {
            let is_inside =
                |first: i32| cells.partition_point(|cell| (0..size[axis]).contains(&(first + cell[axis])));
            (0..size[axis]).map(is_inside).collect()
        });
        let number = |cell: IVec3| ((cell.z * size.y + cell.y) * size.x + cell.x) as isize;
        Self { offsets: cells.into_iter().map(number).collect(), inside }
    }

    /// Those that are inside of the grid, seen from a cell.
    fn from(&self, cell: [usize; 3]) -> &[isize] {
        let inside = self.inside.iter().zip(cell).map(|(inside, at)| inside[at]);
        &self.offsets[..inside.min().unwrap_or(0)]
    }
}

/// The whole numbers at or below; without the calls that [`Vec3::floor`] makes on processors that have no instruction
/// for it.
fn floor(v: Vec3) -> IVec3 {
    let cut = v.as_ivec3();
    cut.saturating_sub(IVec3::select(cut.as_vec3().cmpgt(v), IVec3::ONE, IVec3::ZERO))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers_are_those_of_the_standard_library() {
        for i in -4000..4000 {
            let v = vec3(i as f32 * 0.125, i as f32 * 0.3, i as f32 * 1e3 - 0.25);
            assert_eq!(floor(v), v.floor().as_ivec3(), "{v}");
        }
        for v in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 3e9, -3e9, f32::MIN] {
            assert_eq!(floor(Vec3::splat(v)), Vec3::splat(v).floor().as_ivec3(), "{v}");
        }
    }

    #[test]
    fn a_way_ends_where_the_grid_does() {
        let size = ivec3(5, 4, 3);
        let east = Way::new(Vec3::X, size);
        assert_eq!([0, 2, 4].map(|x| east.from([x, 1, 1])), [&[1, 2, 3, 4][..], &[1, 2], &[]]);
        let down = Way::new(Vec3::NEG_Z, size);
        assert_eq!([0, 2].map(|z| down.from([4, 3, z])), [&[][..], &[-20, -40]]);
        // From corner to corner, at a slant: every cell that a march would pass.
        for direction in [vec3(1.0, 0.8, 0.5), vec3(-0.2, 0.9, -0.6)].map(Vec3::normalize) {
            let way = Way::new(direction, size);
            for cell in [[0, 0, 0], [4, 0, 2], [2, 1, 1]] {
                let start = Vec3::from(cell.map(|at| at as f32 + 0.5));
                let number = |at: Vec3| {
                    let at = floor(at);
                    (at.cmpge(IVec3::ZERO).all() && at.cmplt(size).all())
                        .then(|| ((at.z * size.y + at.y) * size.x + at.x) as isize)
                };
                let first = number(start).unwrap();
                let passed: Vec<isize> = (1..20)
                    .map_while(|step| number(start + direction * step as f32))
                    .map(|n| n - first)
                    .collect();
                assert_eq!(way.from(cell), passed, "{cell:?} {direction}");
            }
        }
    }

    #[test]
    fn the_heart_of_a_crown_is_darker_than_its_rim() {
        let mut areas = Vec::new();
        for i in 0..20_000 {
            let f = |k: u32| ((i as f32 * 0.618_034 * k as f32).fract() - 0.5) * 4.0;
            let at = vec3(f(1), f(7), f(31));
            if at.length() < 2.0 {
                areas.push((at, 0.01));
            }
        }
        let crown = Crown::new(Vec3::splat(-2.0), Vec3::splat(2.0), CELLS, areas.into_iter());
        let [heart, side, top] = [Vec3::ZERO, Vec3::X * 1.9, Vec3::Z * 1.9].map(|p| crown.sky_at(p));
        assert!(heart < 0.7 * side && side < top && top <= 1.0, "{heart} {side} {top}");
        assert!(crown.sky_at(Vec3::splat(9.0)) > 0.99);
    }
}
