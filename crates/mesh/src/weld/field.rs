//! Distances to the nearest stem on a grid, kept only near the surface.

use super::WeldError;
use super::cone::Cone;
use super::joint::Joint;
use glam::{DVec3, IVec3, ivec3};
use rayon::prelude::*;

/// Grid points farther from the surface than so many cells are not kept. A cell that the surface
/// crosses has all its corners within √3.
const BAND: f64 = 2.0;
/// The same where there are fillets, whose distances change by up to 1.4 metres per metre.
const FILLET_BAND: f64 = 3.0;
/// Most grid points along a side: a place is three such numbers in 64 bits.
pub(super) const MAX_ALONG: i32 = 1 << 20;
/// Most grid points near the surface, those of pieces that overlap counted twice.
const MAX_POINTS: usize = 12_000_000;

/// Grid points near the surface in order of their places, and how far each is from it.
#[derive(Debug)]
pub(super) struct Field {
    pub(super) origin: DVec3,
    pub(super) cell: f64,
    pub(super) places: Vec<u64>,
    pub(super) distances: Vec<f32>,
}

/// Rows of x are runs of neighbouring numbers.
pub(super) fn place(p: IVec3) -> u64 {
    (p.z as u64) << 42 | (p.y as u64) << 21 | p.x as u64
}

pub(super) fn unplace(place: u64) -> IVec3 {
    let part = |shift: u32| (place >> shift & ((1 << 21) - 1)) as i32;
    ivec3(part(0), part(21), part(42))
}

/// Cells around the surface of `cone` that are kept.
fn band(cone: &Cone) -> f64 {
    if cone.swell > 0.0 { FILLET_BAND } else { BAND }
}

impl Field {
    pub(super) fn new(cones: &[Cone], joints: &[Joint], cell: f64) -> Result<Self, WeldError> {
        let boxes = cones.iter().map(|c| c.bounds((band(c) + 1.0) * cell + c.swell));
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = boxes.fold(start, |(l, h), (low, high)| (l.min(low), h.max(high)));
        // The grid stands still while trees grow: its lines are whole multiples of the cell.
        let origin = (low / cell).floor() * cell;
        let along = (high - origin).max_element() / cell;
        if along.is_nan() || along >= f64::from(MAX_ALONG) {
            return Err(WeldError::TooFine { cell });
        }
        // Told before the work, not after: a grid too fine would take minutes to overflow.
        if cones.iter().map(|cone| cone.volume_around(BAND * cell + cone.swell)).sum::<f64>() / cell.powi(3)
            > MAX_POINTS as f64
        {
            return Err(WeldError::TooFine { cell });
        }
        let mut field = Self { origin, cell, places: Vec::new(), distances: Vec::new() };
        for cones in cones.chunks(16_384) {
            let mut near: Vec<Vec<u64>> = cones.par_iter().map(|cone| field.near(cone)).collect();
            near.iter_mut().for_each(|near| field.places.append(near));
            field.places.par_sort_unstable();
            field.places.dedup();
        }
        field.distances = vec![f32::INFINITY; field.places.len()];
        // Points deep inside one stem may be near the surface of another, so each stem is asked about
        // every point that was kept.
        for cone in cones {
            field.measure(cone);
        }
        for joint in joints {
            field.blend(cones, joint);
        }
        Ok(field)
    }

    pub(super) fn at(&self, p: IVec3) -> DVec3 {
        self.origin + p.as_dvec3() * self.cell
    }

    /// The rows of points around `cone` that may be kept.
    fn rows(&self, cone: &Cone) -> impl Iterator<Item = (IVec3, i32)> + use<> {
        self.rows_between(cone.bounds(band(cone) * self.cell + cone.swell))
    }

    /// The first point of each row of a box, and the number of points.
    fn rows_between(&self, (low, high): (DVec3, DVec3)) -> impl Iterator<Item = (IVec3, i32)> + use<> {
        // A row that went beyond a place's 21 bits would run into others.
        let last = IVec3::splat(MAX_ALONG);
        let low = ((low - self.origin) / self.cell).floor().as_ivec3().max(IVec3::ZERO);
        let high = ((high - self.origin) / self.cell).ceil().as_ivec3().min(last);
        (low.z..=high.z)
            .flat_map(move |z| (low.y..=high.y).map(move |y| (ivec3(low.x, y, z), high.x - low.x + 1)))
    }

    fn near(&self, cone: &Cone) -> Vec<u64> {
        let mut near = Vec::new();
        for (first, count) in self.rows(cone) {
            for x in 0..count {
                let p = first + ivec3(x, 0, 0);
                let distance = cone.distance(self.at(p));
                // A fillet moves the surface outwards, where points are near it too.
                let band = band(cone) * self.cell;
                if distance > -band && distance < band + cone.swell {
                    near.push(place(p));
                }
            }
        }
        near
    }

    fn measure(&mut self, cone: &Cone) {
        for (first, count) in self.rows(cone) {
            let start = place(first);
            let end = start + count as u64;
            let from = self.places.partition_point(|p| *p < start);
            for i in from..self.places.len() {
                if self.places[i] >= end {
                    break;
                }
                let distance = cone.distance(self.at(unplace(self.places[i]))) as f32;
                self.distances[i] = self.distances[i].min(distance);
            }
        }
    }

    /// Fills the corner between the two stems of `joint`.
    fn blend(&mut self, cones: &[Cone], joint: &Joint) {
        let sides = joint.sides(cones);
        for (first, count) in self.rows_between(joint.bounds()) {
            let start = place(first);
            let end = start + count as u64;
            let from = self.places.partition_point(|p| *p < start);
            for i in from..self.places.len() {
                if self.places[i] >= end {
                    break;
                }
                if let Some(distance) =
                    joint.distance(&sides, self.at(unplace(self.places[i])), FILLET_BAND * self.cell)
                {
                    self.distances[i] = self.distances[i].min(distance as f32);
                }
            }
        }
    }
}
