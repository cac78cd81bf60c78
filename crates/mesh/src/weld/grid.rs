//! The grid, and the bricks of cells that the surface may cross.

use super::WeldError;
use super::nearby::{Nearby, Room, Stems};
use glam::{DVec3, IVec3, ivec3};
use pleach_plant::math;
use rayon::prelude::*;

/// Cells along a brick: two eights.
pub(super) const SIDE: i32 = 2 * EIGHT;
/// Cells along an eight, the cube of cells that share a list of what matters to them.
pub(super) const EIGHT: i32 = 2;
/// Most cells along the grid.
pub(super) const MAX_ALONG: i32 = 1 << 20;
/// Most cells near the surface, those of pieces that overlap counted twice.
const MAX_CELLS: f64 = 12_000_000.0;
/// Cells around the surface that count as near to it.
const BAND: f64 = 2.0;
/// A brick knows what matters this many cells around it: grid points give way by less.
const AROUND: f64 = 0.3;

/// Where the grid lies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    origin: DVec3,
    /// Side of a cell in metres.
    pub(super) cell: f64,
    /// Cells along its longest side.
    along: i32,
}

/// A cube of cells, and the stems that matter in it.
#[derive(Debug)]
pub(super) struct Brick {
    /// Its first grid point.
    pub(super) first: IVec3,
    pub(super) nearby: Nearby,
}

impl Brick {
    /// The order of bricks: by z, then y, then x.
    pub(super) const fn place(first: IVec3) -> [i32; 3] {
        [first.z, first.y, first.x]
    }
}

impl Grid {
    pub(super) fn new(stems: &Stems, cell: f64) -> Result<Self, WeldError> {
        let swell = stems.joints.iter().map(|joint| joint.swell()).fold(0.0, f64::max);
        let boxes = stems.cones.iter().map(|cone| cone.bounds(2.0 * cell + swell));
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = boxes.fold(start, |(l, h), (low, high)| (l.min(low), h.max(high)));
        // The grid stands still while trees grow: its lines are whole multiples of the cell.
        let origin = (low / cell).floor() * cell;
        let along = ((high - origin).max_element() / cell).ceil();
        if along.is_nan() || along >= f64::from(MAX_ALONG) {
            return Err(WeldError::TooFine { cell });
        }
        // Refused before the work, not after: a grid too fine would take minutes to overflow.
        let volume: f64 = stems.cones.iter().map(|cone| cone.volume_around(BAND * cell)).sum();
        if volume / math::powi(cell, 3) > MAX_CELLS {
            return Err(WeldError::TooFine { cell });
        }
        Ok(Self { origin, cell, along: along as i32 })
    }

    /// Where a grid point is.
    pub(super) fn at(&self, point: IVec3) -> DVec3 {
        self.origin + point.as_dvec3() * self.cell
    }

    /// The middle of a cube of `side` cells that begins at grid point `first`, and a radius in which to look
    /// for what matters to it.
    pub(super) fn ball(&self, first: IVec3, side: i32) -> (DVec3, f64) {
        let half = f64::from(side) / 2.0;
        (self.at(first) + DVec3::splat(half * self.cell), (half * 3.0_f64.sqrt() + AROUND) * self.cell)
    }

    /// The bricks that the surface may cross, in order of their places.
    pub(super) fn bricks(&self, stems: &Stems) -> Vec<Brick> {
        let mut side = (self.along.max(SIDE) as u32).next_power_of_two() as i32;
        let mut bricks = vec![Brick { first: IVec3::ZERO, nearby: Nearby::all(stems) }];
        // Cubes are cut into eight until they are bricks; each asks only the stems that matter to its whole.
        while side > SIDE {
            side /= 2;
            let parts = |brick: &Brick| {
                let (mut parts, mut room) = (Vec::new(), Room::default());
                for corner in 0..8 {
                    let first = brick.first + step(corner) * side;
                    let (center, radius) = self.ball(first, side);
                    if let Ok(nearby) = brick.nearby.within(stems, center, radius, &mut room) {
                        parts.push(Brick { first, nearby });
                    }
                }
                parts
            };
            bricks = bricks.par_iter().flat_map_iter(parts).collect();
        }
        bricks.par_sort_unstable_by_key(|brick| Brick::place(brick.first));
        bricks
    }
}

/// The corner of a cell by its bits x, y and z.
pub(super) const fn step(corner: usize) -> IVec3 {
    ivec3((corner & 1) as i32, (corner >> 1 & 1) as i32, (corner >> 2 & 1) as i32)
}
