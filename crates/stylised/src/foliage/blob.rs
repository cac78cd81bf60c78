//! Blobs of one to five spheres (Lorite 2021, §3.5.5).

use super::RADIUS;
use crate::draws::{FOLIAGE, SPHERES, direction, rotation, signed3};
use crate::params::{Id, Numbers};
use crate::skeleton::Skeleton;
use crate::surface::{Ellipsoid, Grid, Mesh, Union};
use crate::write::{Budget, Writer};
use glam::{DMat3, DVec3};
use pleach_tree::math;
use pleach_tree::{GrowError, Key};

/// Cells of the grid at each level of detail, over the radius of a blob's first sphere.
const CELLS: [f64; 4] = [0.9, 0.45, 0.225, 0.1125];
/// Width of the fillet between spheres, over the radius of the first.
const FILLET: f64 = 0.15;
/// Blobs on trunks without branches, at the end of the slider.
const ON_TRUNKS: f64 = 6.0;
/// "A little under twice the radius" of the report.
const NEARLY_TWICE: f64 = 1.9;
/// By how much the last change of size makes a blob larger or smaller.
const LAST_SCALE: f64 = 0.15;

/// What draws of a blob are for; those at branch ends are addressed by their branches.
mod purpose {
    pub(super) const IS_THERE: u32 = 100;
    pub(super) const COUNT: u32 = 101;
    pub(super) const OFFSET: u32 = 102;
    pub(super) const ROTATION: u32 = 103;
    pub(super) const SCALE: u32 = 104;
    pub(super) const PLACE: u32 = 105;
}

/// What draws of a sphere are for.
mod of_sphere {
    pub(super) const DIRECTION: u32 = 0;
    pub(super) const DISTANCE: u32 = 1;
    pub(super) const RADIUS: u32 = 2;
    pub(super) const ROTATION: u32 = 3;
    pub(super) const SHAPE: u32 = 4;
}

/// Where a blob grows.
#[derive(Clone, Copy, Debug)]
struct Site {
    chain: u32,
    at: DVec3,
    key: Key,
}

/// Memory for blobs.
#[derive(Debug, Default)]
pub(crate) struct Blobs {
    sites: Vec<Site>,
    spheres: Vec<Ellipsoid>,
    grid: Grid,
    mesh: Mesh,
}

impl Blobs {
    pub(super) fn grow(
        &mut self,
        numbers: &Numbers,
        skeleton: &Skeleton,
        key: Key,
        budget: &mut Budget,
        writer: &mut Writer<'_>,
    ) -> Result<(), GrowError> {
        self.sites.clear();
        if skeleton.ends.is_empty() {
            self.sites.extend(on_trunks(numbers, skeleton, key));
        } else {
            let chance = numbers.leaves_quantity / 100.0;
            let there = skeleton.ends.iter().filter(|end| end.key.unit(purpose::IS_THERE, 0) < chance);
            self.sites.extend(there.map(|end| Site { chain: end.chain, at: end.at, key: end.key }));
        }
        for i in 0..self.sites.len() {
            self.blob(numbers, self.sites[i], budget, writer)?;
        }
        Ok(())
    }

    fn blob(
        &mut self,
        numbers: &Numbers,
        site: Site,
        budget: &mut Budget,
        writer: &mut Writer<'_>,
    ) -> Result<(), GrowError> {
        spheres(numbers.leaves_randomness, site.key, &mut self.spheres);
        let union = Union { parts: &self.spheres, fillet: FILLET };
        // Large blobs have somewhat larger cells: detail is seen against the whole.
        let (low, high) = union.bounds();
        let half = math::cbrt(((high - low) / 2.0).element_product());
        let cell = CELLS[numbers.subdivision.min(3) as usize] * half.max(1.0).sqrt();
        budget.spend(Grid::count(&union, cell), Id::subdivision)?;
        self.grid.sample(&union, cell);
        self.mesh.build(&self.grid, &union);
        let size = RADIUS * numbers.leaves_size * (1.0 + LAST_SCALE * site.key.signed(purpose::SCALE, 0));
        let turn = rotation(site.key, purpose::ROTATION);
        let offset = signed3(site.key, purpose::OFFSET, 0) * (0.3 * numbers.leaves_randomness * size);
        self.mesh.vertices.iter_mut().for_each(|v| *v = turn * *v * size);
        // A blob that would reach into the ground is moved up onto it.
        let lowest = self.mesh.vertices.iter().map(|v| v.z).fold(f64::INFINITY, f64::min);
        let at = site.at + offset;
        let at = at.with_z(at.z.max(-lowest));
        self.mesh.vertices.iter_mut().for_each(|v| *v += at);
        writer.blob(site.chain, &self.mesh.vertices, &self.mesh.triangles)
    }
}

/// Sites on trunks without branches: the first on the end of each, then down to where the zone starts.
fn on_trunks(numbers: &Numbers, skeleton: &Skeleton, key: Key) -> impl Iterator<Item = Site> {
    let count = ((ON_TRUNKS * numbers.leaves_quantity / 100.0).round() as u32).max(1);
    let trunks = skeleton.trunk_count;
    (0..count).map(move |i| {
        let (trunk, row) = (i % trunks, i / trunks);
        let key = skeleton.key_on(trunk, key.child(FOLIAGE, i));
        let rows = f64::from(count.div_ceil(trunks));
        let down = if row == 0 { 0.0 } else { (f64::from(row) + 0.3 * key.signed(purpose::PLACE, 0)) / rows };
        let path = skeleton.trunk(trunk);
        let (start, length) = (skeleton.zone_starts[trunk as usize], path.length());
        let beside = direction(key, purpose::PLACE + 1) * (0.8 * RADIUS * numbers.leaves_size);
        let at = path.at(length - (length - start) * down).point;
        let at = if row == 0 { at } else { at + beside };
        Site { chain: trunk, at, key }
    })
}

/// The spheres of a blob whose first has radius 1, around the origin.
fn spheres(randomness: f64, key: Key, spheres: &mut Vec<Ellipsoid>) {
    spheres.clear();
    let (least, most) = (1 + (2.0 * randomness) as u32, 1 + (4.0 * randomness) as u32);
    let count = least + (key.unit(purpose::COUNT, 0) * f64::from(most - least + 1)) as u32;
    for i in 0..count {
        let key = key.child(SPHERES, i);
        let axes = DMat3::from_quat(rotation(key, of_sphere::ROTATION));
        // An icosphere shows that it is turned; a sphere has to be a little out of round.
        let shape = DVec3::ONE + signed3(key, of_sphere::SHAPE, 0) * (0.2 * randomness);
        if i == 0 {
            spheres.push(Ellipsoid::new(DVec3::ZERO, shape, axes));
            continue;
        }
        let radius = 0.5 + (NEARLY_TWICE - 0.5) * key.unit(of_sphere::RADIUS, 0);
        // Those that would not touch the first are drawn nearer until they do.
        let distance = (NEARLY_TWICE * key.unit(of_sphere::DISTANCE, 0)).min(0.8 * (1.0 + radius));
        let center = direction(key, of_sphere::DIRECTION) * distance;
        spheres.push(Ellipsoid::new(center, shape * radius, axes));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spheres_are_one_to_five_and_more_with_randomness() {
        let range = |randomness: f64| {
            let mut found = Vec::new();
            let counts = (0..300).map(|seed| {
                spheres(randomness, Key::root(seed), &mut found);
                found.len()
            });
            counts.fold((usize::MAX, 0), |(low, high), n| (low.min(n), high.max(n)))
        };
        assert_eq!([0.0, 0.25, 0.5, 1.0].map(range), [(1, 1), (1, 2), (2, 3), (3, 5)]);
    }

    #[test]
    fn every_sphere_touches_the_first() {
        let mut found = Vec::new();
        for seed in 0..300 {
            spheres(1.0, Key::root(seed), &mut found);
            let union = Union { parts: &found, fillet: FILLET };
            for part in &found {
                // Along the line between the centers there is no gap.
                assert!((0..=20).all(|i| union.distance(part.center * f64::from(i) / 20.0) < 0.0), "{seed}");
            }
        }
    }
}
