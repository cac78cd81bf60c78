//! The volume that a crown fills.
//!
//! Everything else asks a [`Volume`] for three things: the place of a point in it, where a place lies in it, and how
//! large it is. It is one of revolution, by its numbers, or the hull of an individual.
//!
//! Lengths are over the tree's height: the ground is z = 0 and the crown's top z = 1.

use crate::params::{Numbers, STATIONS};
use crate::purpose::RIPPLE;
use crate::sections::{PIECES, Sections};
use glam::{DVec2, DVec3};
use pleach_tree::trig::{atan2, sin_cos};
use pleach_tree::{Hull, Key, math};
use std::f64::consts::{PI, TAU};

/// Narrowest half-width of a crown over its greatest, so that no part of it is empty.
const MIN_PROFILE: f64 = 0.03;
/// Height of the crown's heart over the crown's height.
const HEART: f64 = 0.25;
/// Density of points in the densest cells of a hull over that of a species' own crown.
const DENSER: f64 = 1.5;
/// Largest number of places that are tried for the points of a hull.
const MAX_TRIES: f64 = 20_000.0;
/// Waves of the surface: about the axis, and along it.
const RIPPLES: [(f64, f64); 5] = [(1.0, 0.4), (2.0, 0.8), (3.0, 0.6), (1.0, 1.3), (4.0, 1.1)];

/// Where a place lies in a volume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Inside {
    /// Height above the crown's base over the crown's height.
    pub(crate) rise: f64,
    /// Distance from the crown's axis over the half-width there.
    pub(crate) out: f64,
}

/// A crown of revolution whose section, width and axis vary, or one that fills a hull.
#[derive(Clone, Debug)]
pub(crate) struct Volume<'a> {
    base: f64,
    /// From its base to its top.
    height: f64,
    half_width: f64,
    profile: [f64; STATIONS],
    depth: f64,
    /// Cosine and sine of the azimuth of the widest section.
    widest: DVec2,
    shift: DVec2,
    irregularity: f64,
    phases: [f64; RIPPLES.len()],
    axis: [DVec2; PIECES + 1],
    /// Part of the volume below each of the heights.
    below: [f64; PIECES + 1],
    size: f64,
    /// With the size of the crown that the numbers alone make.
    hull: Option<(&'a Hull, Sections, f64)>,
}

impl<'a> Volume<'a> {
    /// The volume of a tree of these numbers; `key` draws its irregularity. Of a tree with a `hull` width, base, top and
    /// one-sidedness are the hull's.
    pub(crate) fn new(n: &Numbers, hull: Option<&'a Hull>, key: Key) -> Self {
        let (sin, cos) = sin_cos(n.crown_azimuth);
        let (side_sin, side_cos) = sin_cos(n.side_azimuth);
        let half_width = n.crown_width / 2.0;
        let mut volume = Self {
            base: n.bare_height,
            height: 1.0 - n.bare_height,
            half_width,
            profile: n.profile.map(|part| part.max(MIN_PROFILE)),
            depth: n.crown_depth,
            widest: DVec2::new(cos, sin),
            shift: DVec2::new(side_cos, side_sin) * (n.side * half_width),
            irregularity: n.irregularity,
            phases: std::array::from_fn(|i| TAU * key.unit(RIPPLE, i as u32)),
            axis: axis(n),
            below: [0.0; PIECES + 1],
            size: 0.0,
            hull: hull.and_then(|hull| {
                Some((hull, Sections::new(hull, n.crown_depth)?, Self::new(n, None, key).size))
            }),
        };
        if let Some((hull, sections, _)) = &volume.hull {
            volume.base = sections.base;
            volume.height = sections.top - sections.base;
            volume.axis = course(hull, &volume.axis);
            volume.depth = 1.0;
            volume.half_width = sections.half_width();
        }
        let section = |i: usize| {
            let rise = (i as f64 + 0.5) / PIECES as f64;
            if let Some((_, sections, _)) = &volume.hull {
                return sections.width_and_area(rise).1;
            }
            let half = volume.half_width * volume.profile_at(rise);
            half * half
        };
        let mut sum = 0.0;
        let mut below = [0.0; PIECES + 1];
        for i in 0..PIECES {
            sum += section(i);
            below[i + 1] = sum;
        }
        volume.below = below.map(|part| part / sum);
        volume.size = PI * sum / PIECES as f64 * volume.depth * volume.height;
        volume
    }

    /// How many places are tried for the points of a tree that has `points` in its own crown: a hull is filled as densely
    /// as that.
    pub(crate) fn tries(&self, points: u32) -> u32 {
        let Some((.., own)) = &self.hull else { return points };
        let tries = f64::from(points) * DENSER * self.size / own;
        tries.min(MAX_TRIES) as u32
    }

    /// Whether the point of a tree that lies at `place` is there; `chance`, in 0..1, is its own. A hull has fewer points
    /// where its pictures have less ink.
    pub(crate) fn holds(&self, place: DVec3, chance: f64) -> bool {
        self.hull.as_ref().is_none_or(|(hull, ..)| chance < hull.density(place))
    }

    /// Content of the crown that the numbers alone make, over the cube of the tree's height.
    pub(crate) fn own_size(&self) -> f64 {
        self.hull.as_ref().map_or(self.size, |(.., own)| *own)
    }

    /// Half of the greatest width, over the tree's height.
    pub(crate) fn half_width(&self) -> f64 {
        self.half_width
    }

    /// Height of the crown's base.
    pub(crate) fn base(&self) -> f64 {
        self.base
    }

    /// Height above which no trunk grows.
    pub(crate) fn top(&self) -> f64 {
        self.hull.as_ref().map_or(1.0, |(_, sections, _)| sections.top)
    }

    /// The height, as [`Inside::rise`], below which the part `part` of the volume lies.
    pub(crate) fn rise_of(&self, part: f64) -> f64 {
        let above = self.below.partition_point(|&below| below <= part).clamp(1, PIECES);
        let (low, high) = (self.below[above - 1], self.below[above]);
        let within = if high > low { (part - low) / (high - low) } else { 0.5 };
        (above as f64 - 1.0 + within.clamp(0.0, 1.0)) / PIECES as f64
    }

    /// The place at `inside`, towards `azimuth`.
    pub(crate) fn place(&self, inside: Inside, azimuth: f64) -> DVec3 {
        let (sin, cos) = sin_cos(azimuth);
        if let Some((_, sections, _)) = &self.hull {
            let flat = sections.place(inside.rise, DVec2::new(cos, sin) * inside.out);
            return flat.extend(self.base + self.height * inside.rise);
        }
        let half = self.half_width_at(inside.rise, azimuth) * inside.out;
        let flat = self.squeezed(DVec2::new(cos, sin) * half, self.depth);
        let z = self.base + self.height * inside.rise;
        (self.center(z) + flat).extend(z)
    }

    /// Where `place` lies; above and below the crown the section of its ends counts.
    pub(crate) fn inside(&self, place: DVec3) -> Inside {
        let rise = (place.z - self.base) / self.height;
        if let Some((_, sections, _)) = &self.hull {
            return Inside { rise, out: sections.unit(rise, place.truncate()).length() };
        }
        let flat = place.truncate() - self.center(place.z);
        let round = self.squeezed(flat, 1.0 / self.depth);
        let azimuth = atan2(round.y, round.x);
        Inside { rise, out: round.length() / self.half_width_at(rise.clamp(0.0, 1.0), azimuth) }
    }

    /// `flat` with what lies across the widest section multiplied by `by`.
    fn squeezed(&self, flat: DVec2, by: f64) -> DVec2 {
        // The same bits whatever the azimuth of a round crown.
        if by == 1.0 {
            return flat;
        }
        let turned = DVec2::new(self.widest.x, -self.widest.y).rotate(flat);
        self.widest.rotate(DVec2::new(turned.x, turned.y * by))
    }

    /// The middle of the crown's section at height `z`.
    fn center(&self, z: f64) -> DVec2 {
        if let Some((_, sections, _)) = &self.hull {
            return sections.place((z - self.base) / self.height, DVec2::ZERO);
        }
        // The crown stands off its trunk gradually, from its base to the middle of its height.
        let rise = ((z - self.base) / (0.5 * self.height)).clamp(0.0, 1.0);
        self.axis_at(z) + self.shift * rise
    }

    /// The slope of a trunk whose course a picture shows, at height `z`.
    pub(crate) fn shown_slope(&self, z: f64) -> Option<DVec2> {
        let (hull, ..) = self.hull.as_ref()?;
        let last = hull.trunk.last()?;
        if z >= last[1] {
            return None;
        }
        let piece = ((z.max(0.0) * PIECES as f64) as usize).min(PIECES - 1);
        Some((self.axis[piece + 1] - self.axis[piece]) * PIECES as f64)
    }

    /// The trunk's nominal place at height `z`.
    pub(crate) fn axis_at(&self, z: f64) -> DVec2 {
        let at = z.clamp(0.0, 1.0) * PIECES as f64;
        let piece = (at as usize).min(PIECES - 1);
        self.axis[piece].lerp(self.axis[piece + 1], at - piece as f64)
    }

    /// The pull away from the heart of the crown: level, or upwards above the heart; 1 in the inner half of the crown,
    /// nothing at its surface.
    pub(crate) fn outward(&self, place: DVec3) -> DVec3 {
        let rise = (place.z - self.base) / self.height;
        let heart = self.base + rise.min(HEART) * self.height;
        let away = place - self.center(heart).extend(heart);
        let half = match &self.hull {
            Some((_, sections, _)) => sections.width_and_area(rise).0,
            None => self.half_width * self.profile_at(rise),
        };
        let out = away.truncate().length() / half;
        let fade = (2.0 * (1.0 - out).min(1.0 - rise)).clamp(0.0, 1.0);
        away.normalize_or_zero() * fade
    }

    fn half_width_at(&self, rise: f64, azimuth: f64) -> f64 {
        let mut sum = 0.0;
        if self.irregularity > 0.0 {
            for ((about, along), phase) in RIPPLES.into_iter().zip(self.phases) {
                sum += sin_cos(about * azimuth + along * TAU * rise + phase).0;
            }
        }
        // Five waves add up to about 1.6 in the root mean square.
        let factor = (1.0 + self.irregularity * sum / 2.5).max(0.15);
        self.half_width * self.profile_at(rise) * factor
    }

    /// The profile as a Catmull–Rom spline through the stations.
    fn profile_at(&self, rise: f64) -> f64 {
        let last = STATIONS - 1;
        let at = rise.clamp(0.0, 1.0) * last as f64;
        let i = (at as usize).min(last - 1);
        let t = at - i as f64;
        let p = |j: usize| self.profile[j.min(last)];
        let (before, from, to, after) = (p(i.saturating_sub(1)), p(i), p(i + 1), p(i + 2));
        let (out, into) = ((to - before) / 2.0, (after - from) / 2.0);
        let value = from
            + t * (out + t * (3.0 * (to - from) - 2.0 * out - into + t * (2.0 * (from - to) + out + into)));
        value.clamp(MIN_PROFILE, 1.1)
    }
}

/// Steepest lean of the axis, radians.
const MAX_LEAN: f64 = 1.3;

/// Angle of the trunk to the vertical at height `z`.
pub(crate) fn lean_at(n: &Numbers, z: f64) -> f64 {
    (n.lean + n.bow * (z - 0.5)).clamp(-MAX_LEAN, MAX_LEAN)
}

/// The trunk's nominal course.
fn axis(n: &Numbers) -> [DVec2; PIECES + 1] {
    let (sin, cos) = sin_cos(n.lean_azimuth);
    let mut axis = [DVec2::ZERO; PIECES + 1];
    let mut off = 0.0;
    for i in 0..PIECES {
        off += math::tan(lean_at(n, (i as f64 + 0.5) / PIECES as f64)) / PIECES as f64;
        axis[i + 1] = DVec2::new(cos, sin) * off;
    }
    axis
}

/// The course of a trunk as a picture of `hull` shows it; above that it goes on as `nominal` does.
fn course(hull: &Hull, nominal: &[DVec2; PIECES + 1]) -> [DVec2; PIECES + 1] {
    let (Some(view), Some(last)) = (hull.views.first(), hull.trunk.last()) else { return *nominal };
    let mut course = *nominal;
    for i in 1..=PIECES {
        let z = i as f64 / PIECES as f64;
        let above = hull.trunk.partition_point(|point| point[1] <= z);
        course[i] = match (hull.trunk.get(above.wrapping_sub(1)), hull.trunk.get(above)) {
            (Some(from), Some(to)) => {
                let part = (z - from[1]) / (to[1] - from[1]).max(1e-9);
                view.right() * (from[0] + (to[0] - from[0]) * part)
            }
            (None, Some(first)) => view.right() * (first[0] * z / first[1].max(1e-9)),
            _ if z - 1.0 / PIECES as f64 <= last[1] => view.right() * last[0],
            _ => course[i - 1] + nominal[i] - nominal[i - 1],
        };
    }
    course
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Id;
    use pleach_tree::param::table::Parameters;

    fn volume(set: &[(Id, f64)]) -> Volume<'static> {
        let mut values = Numbers::space().defaults();
        set.iter().for_each(|&(id, value)| values[id.slot(0).index()] = value);
        Volume::new(&Numbers::read(&values), None, Key::root(1))
    }

    const ODD: [(Id, f64); 6] = [
        (Id::crown_depth, 0.5),
        (Id::crown_azimuth, 40.0),
        (Id::side, 0.4),
        (Id::irregularity, 0.3),
        (Id::lean, 15.0),
        (Id::bow, 20.0),
    ];

    #[test]
    fn a_place_is_where_it_was_put() {
        let volume = volume(&ODD);
        for i in 0..200 {
            let key = Key::root(i);
            let put = Inside { rise: key.unit(0, 0), out: 0.1 + key.unit(0, 1) };
            let found = volume.inside(volume.place(put, TAU * key.unit(0, 2)));
            assert!((found.rise - put.rise).abs() < 1e-9 && (found.out - put.out).abs() < 1e-9, "{found:?}");
        }
    }

    #[test]
    fn even_parts_of_the_volume_lie_below_heights() {
        let volume = volume(&[]);
        assert_eq!((volume.rise_of(0.0), volume.rise_of(1.0)), (0.0, 1.0));
        let heights: Vec<f64> = (0..=20).map(|i| volume.rise_of(f64::from(i) / 20.0)).collect();
        assert!(heights.windows(2).all(|pair| pair[0] < pair[1]), "{heights:?}");
        // Half of the crown is wide: the default is widest below its middle.
        assert!((0.35..0.5).contains(&volume.rise_of(0.5)));
    }

    #[test]
    fn a_cylinder_has_its_content() {
        let mut values = Numbers::space().defaults();
        (0..STATIONS).for_each(|i| values[Id::profile.slot(i).index()] = 1.0);
        let volume = Volume::new(&Numbers::read(&values), None, Key::root(1));
        assert!((volume.own_size() - PI * 0.4 * 0.4 * 0.75).abs() < 1e-9, "{}", volume.own_size());
    }
}
