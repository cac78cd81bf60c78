//! Attraction points, by address.
//!
//! A point is drawn in the unit cube and carried into the volume, so a small change of a number moves points a little.
//! Points come one after the other from a sequence that fills the cube evenly: fewer points are the first of them.

use crate::params::Numbers;
use crate::purpose::{CLUMP, CLUMP_PLACE, HELD, JITTER, OFFSET, SHADED};
use crate::volume::{Inside, Volume};
use glam::{DVec3, dvec3};
use pleach_tree::trig::sin_cos;
use pleach_tree::{Key, math};
use std::f64::consts::TAU;

/// Steps of the additive sequence in three dimensions: powers of the inverse of the root of x⁴ = x + 1.
const STEPS: [f64; 3] = [0.819_172_513_396_164_4, 0.671_043_606_703_789_2, 0.549_700_477_901_970_3];
/// Deviation of points from the sequence in spacings, which hides its lattice.
const DEVIATION: f64 = 0.6;
/// The golden angle, in turns: azimuths of clumps.
const GOLDEN: f64 = 0.381_966_011_250_105;

/// Draws the attraction points of a tree into `points`.
pub(crate) fn scatter(n: &Numbers, volume: &Volume<'_>, key: Key, points: &mut Vec<DVec3>) {
    points.clear();
    let spacing = DEVIATION / math::cbrt(f64::from(n.points));
    let offset: [f64; 3] = std::array::from_fn(|axis| key.unit(OFFSET, axis as u32));
    for i in 0..volume.tries(n.points) {
        let own = key.child(JITTER, i);
        if own.unit(CLUMP, 0) < n.clumping {
            let place = in_clump(n, volume, key, i, own);
            if volume.holds(place, own.unit(HELD, 0)) {
                points.push(place);
            }
            continue;
        }
        let unit = |axis: usize| {
            let along =
                offset[axis] + STEPS[axis] * f64::from(i + 1) + spacing * own.signed(JITTER, axis as u32);
            along - along.floor()
        };
        let inside = Inside { rise: volume.rise_of(unit(0)), out: unit(1).sqrt() };
        // 1 at the crown's surface, 0 at the foot of its axis.
        let light = 1.0 - (1.0 - inside.out) * (1.0 - inside.rise);
        let place = volume.place(inside, TAU * unit(2));
        let is_lit = own.unit(SHADED, 0) >= n.shade * (1.0 - light * light);
        if is_lit && volume.holds(place, own.unit(HELD, 0)) {
            points.push(place);
        }
    }
}

/// A point of a clump.
fn in_clump(n: &Numbers, volume: &Volume<'_>, key: Key, i: u32, own: Key) -> DVec3 {
    let clump = i % n.clumps;
    let place = key.child(CLUMP_PLACE, clump);
    // Heights one after the other, azimuths by the golden angle: no two clumps in the same place.
    let part = (f64::from(clump) + place.unit(0, 0)) / f64::from(n.clumps);
    let out = (0.1 + 0.9 * place.unit(0, 1)).sqrt() * (1.0 - 0.5 * n.clump_size);
    let azimuth = TAU * (key.unit(OFFSET, 3) + GOLDEN * f64::from(clump) + 0.1 * place.signed(0, 2));
    let center = volume.place(Inside { rise: volume.rise_of(part), out }, azimuth);
    let radius = n.clump_size * volume.half_width();
    let far = math::cbrt(own.unit(CLUMP, 1)) * radius;
    let (sin, cos) = sin_cos(TAU * own.unit(CLUMP, 2));
    let up = own.signed(CLUMP, 3);
    let level = (1.0 - up * up).sqrt();
    let place = center + dvec3(level * cos, level * sin, up * (1.0 - 0.9 * n.clump_flatness)) * far;
    // Clumps at the top would make the tree higher than its height.
    dvec3(place.x, place.y, place.z.clamp(volume.base() * 0.5, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Id;
    use pleach_tree::param::table::Parameters;

    fn scattered(set: &[(Id, f64)]) -> (Vec<DVec3>, Volume<'static>) {
        let mut values = Numbers::space().defaults();
        set.iter().for_each(|&(id, value)| values[id.slot(0).index()] = value);
        let n = Numbers::read(&values);
        let volume = Volume::new(&n, None, Key::root(3));
        let mut points = Vec::new();
        scatter(&n, &volume, Key::root(4), &mut points);
        (points, volume)
    }

    #[test]
    fn points_lie_in_the_crown_and_fill_it_evenly() {
        let (points, volume) = scattered(&[(Id::shade, 0.0), (Id::points, 2000.0)]);
        assert_eq!(points.len(), 2000);
        let inside: Vec<Inside> = points.iter().map(|&point| volume.inside(point)).collect();
        assert!(inside.iter().all(|i| i.out <= 1.0 + 1e-9 && (0.0..=1.0).contains(&i.rise)));
        let core = inside.iter().filter(|i| i.out < 0.5).count();
        assert!((440..560).contains(&core), "a quarter of the section: {core}");
    }

    #[test]
    fn shade_empties_the_inside() {
        let core = |shade| {
            let (points, volume) = scattered(&[(Id::shade, shade), (Id::points, 2000.0)]);
            let is_core = |point: &&DVec3| volume.inside(**point).out < 0.3;
            points.iter().filter(is_core).count() as f64 / points.len() as f64
        };
        assert!(core(1.0) < 0.6 * core(0.0), "{} {}", core(1.0), core(0.0));
    }

    #[test]
    fn a_small_change_moves_points_a_little() {
        let (one, _) = scattered(&[(Id::crown_width, 0.8)]);
        let (other, _) = scattered(&[(Id::crown_width, 0.804)]);
        assert_eq!(one.len(), other.len());
        assert!(one.iter().zip(&other).all(|(a, b)| a.distance(*b) < 0.003));
        let (more, _) = scattered(&[(Id::points, 701.0), (Id::shade, 0.0)]);
        let (fewer, _) = scattered(&[(Id::points, 700.0), (Id::shade, 0.0)]);
        assert!(fewer.iter().zip(&more).filter(|(a, b)| a.distance(**b) < 0.003).count() > 690);
    }

    #[test]
    fn clumps_are_denser_than_the_crown() {
        let nearest = |clumping| {
            let (points, _) = scattered(&[(Id::clumping, clumping), (Id::clump_size, 0.15)]);
            let least = |a: &DVec3| {
                points.iter().filter(|b| *b != a).map(|b| a.distance(*b)).fold(f64::INFINITY, f64::min)
            };
            points.iter().map(least).sum::<f64>() / points.len() as f64
        };
        assert!(nearest(1.0) < 0.7 * nearest(0.0));
    }
}
