//! What the blade of a leaf looks like: ribs and veins, blotches, relief.
//!
//! Ribs are drawn after the outline: one along the middle; one into each lobe, from the middle rib (as oaks have them) or
//! from the foot of a wide blade (as maples do). Veins leave a rib at an acute angle, on its two sides alternately. Narrow
//! blades have veins along their length.

use crate::preview::bark::{floor, noise, smooth};
use glam::{Vec2, Vec3, vec2, vec3};
use pleach_mesh::atlas::bounds;
use pleach_plant::leaf_shape::Outline;

/// What is seen at a point of a blade.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Look {
    /// Against the leaf's colour, channel by channel as intensities.
    pub(crate) light: Vec3,
    /// Height above the blade's plane, in lengths of the blade.
    pub(crate) height: f32,
}

/// Blades narrower than this, in their lengths, are needles or grass.
const NARROW: f32 = 0.15;
/// Blades wider than this, in their lengths, have lobes that begin at the foot.
const WIDE: f32 = 0.8;
/// Half of a rib's width at its foot, in lengths of the blade.
const RIB: f32 = 0.016;
/// Colour of ribs and veins against that of the blade.
const PALE: Vec3 = vec3(1.55, 1.4, 1.15);

/// A straight rib from the foot of a lobe to its tip.
#[derive(Clone, Copy, Debug)]
struct Rib {
    foot: Vec2,
    along: Vec2,
    length: f32,
    /// Half of its width at the foot.
    width: f32,
}

impl Rib {
    fn new(foot: Vec2, tip: Vec2, width: f32) -> Self {
        let length = foot.distance(tip).max(1e-3);
        Self { foot, along: (tip - foot) / length, length, width }
    }

    /// How far along the rib a point is, and how far beside it, to the left if positive.
    fn place(&self, point: Vec2) -> (f32, f32) {
        let from = point - self.foot;
        (from.dot(self.along), self.along.perp_dot(from))
    }
}

/// The ribs and veins of a shape.
#[derive(Clone, Debug)]
pub(crate) struct Blade {
    /// The middle rib first.
    ribs: Vec<Rib>,
    /// How many of them have veins of their own.
    veined: usize,
    /// Pairs of veins along a rib.
    pairs: f32,
    /// Half of the blade's width.
    half: f32,
}

impl Blade {
    pub(crate) fn new(shape: &Outline) -> Self {
        let [left, bottom, right, top] = bounds(shape.corners());
        let (width, height) = ((right - left).max(1e-3), (top - bottom).max(1e-3));
        let half = width / 2.0;
        let middle = if shape.half().is_some() { 0.0 } else { (left + right) / 2.0 };
        let rib = RIB.min(0.12 * width);
        let spine = Rib::new(vec2(middle, bottom), vec2(middle, top), rib);
        let plain = |pairs: f32| Self { ribs: vec![spine], veined: 1, pairs, half };
        if width < NARROW * height {
            return plain(0.0);
        }
        let Some((base, lobes)) = shape.half().map(lobes).filter(|(_, lobes)| lobes.len() > 1) else {
            return plain(7.0);
        };
        let is_wide = width > WIDE * height;
        let mut ribs = vec![spine];
        for tip in lobes {
            // At an acute angle from the middle.
            let foot = if is_wide { base } else { (tip[1] - 0.8 * tip[0]).max(base) };
            let side = |x: f32| Rib::new(vec2(0.0, foot), vec2(x, tip[1]), 0.7 * rib);
            ribs.extend([side(tip[0]), side(-tip[0])]);
        }
        let veined = if is_wide { ribs.len() } else { 1 };
        Self { ribs, veined, pairs: if is_wide { 6.0 } else { 9.0 }, half }
    }

    /// What is seen at a point of the shape, and, by the same rule, beyond its outline.
    pub(crate) fn look(&self, point: Vec2) -> Look {
        let mut rib = 0.0_f32;
        let mut nearest = (f32::INFINITY, 0.0, 0.0, 1.0);
        for (i, one) in self.ribs.iter().enumerate() {
            let (along, beside) = one.place(point);
            let part = along / one.length;
            let width = one.width * (1.05 - 0.8 * part).clamp(0.25, 1.0);
            let is_there = smooth(-0.02, 0.0, part) * (1.0 - smooth(0.97, 1.0, part));
            rib = rib.max((1.0 - beside.abs() / width).max(0.0) * is_there);
            // How far off, as an angle: the lobe between two ribs is split in the middle.
            let off = beside.abs() + (-along).max(0.0);
            if i < self.veined && off < nearest.0 {
                nearest = (off, along, beside, one.length);
            }
        }
        let (_, along, beside, length) = nearest;
        let (vein, bulge) = if self.pairs > 0.0 {
            // Veins bend towards the tip as they go out.
            let out = beside.abs();
            let alternate = if beside > 0.0 { 0.5 } else { 0.0 };
            let place = (along - 0.75 * out - 0.5 * out * out / self.half) / length * self.pairs + alternate;
            let off = to_whole(place);
            let width = (0.007 * self.pairs / length).min(0.2);
            ((1.0 - off / width).max(0.0) * (1.0 - 0.6 * (out / self.half).min(1.0)), 1.0 - 4.0 * off * off)
        } else {
            let place = beside / self.half * 3.0;
            (0.5 * (1.0 - 3.0 * to_whole(place)).max(0.0), 0.0)
        };
        let bumps = |often: f32| noise(point.x * often + 64.0, point.y * often + 64.0, [1 << 16; 2]);
        let mottled = 1.0 + 0.16 * (bumps(9.0) - 0.5) + 0.14 * (bumps(46.0) - 0.5);
        let pale = 0.75 * rib + 0.4 * vein * (1.0 - rib);
        // Ribs lie in grooves; between veins the blade rises, and its halves are folded up along the middle.
        let grooves = -0.35 * RIB.min(0.2 * self.half) * (rib + 0.4 * vein);
        let relief = 0.004 * bulge * (self.half * 4.0).min(1.0) + 0.0015 * bumps(46.0);
        let folded = 0.25 * (point.x * point.x + 1e-4).sqrt() - 0.1 * point.y * point.y;
        Look { light: (Vec3::ONE + (PALE - Vec3::ONE) * pale) * mottled, height: grooves + relief + folded }
    }
}

/// How far it is to the nearest whole number.
fn to_whole(x: f32) -> f32 {
    (x - floor(x + 0.5) as f32).abs()
}

/// Where the blade begins above its stalk, and the tips of the lobes of its right half, if that is `half`.
fn lobes(half: &[[f32; 2]]) -> (f32, Vec<[f32; 2]>) {
    let widest = half.iter().map(|p| p[0]).fold(0.0, f32::max);
    let base = half.windows(2).find(|pair| pair[1][0] > 0.25 * widest).map_or(0.0, |pair| pair[0][1]);
    let is_tip = |p: &&[[f32; 2]]| p[1][0] > p[0][0] && p[1][0] >= p[2][0];
    (base, half.windows(3).filter(is_tip).map(|p| p[1]).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use pleach_plant::leaf_shape::LeafShape;

    #[test]
    fn ribs_go_into_the_lobes() {
        let ribs = |shape: LeafShape| Blade::new(shape.outline()).ribs.len();
        assert_eq!((ribs(LeafShape::Ovate), ribs(LeafShape::Linear)), (1, 1));
        assert_eq!((ribs(LeafShape::Palmate), ribs(LeafShape::Maple), ribs(LeafShape::SpikyOak)), (5, 7, 11));
        for shape in LeafShape::ALL {
            let blade = Blade::new(shape.outline());
            for rib in &blade.ribs {
                let tip = rib.foot + rib.along * rib.length;
                assert!(
                    shape.outline().corners().iter().any(|p| Vec2::from(*p).distance(tip) < 0.51),
                    "{shape:?} {tip}"
                );
                let on_rib = blade.look(rib.foot + rib.along * (0.5 * rib.length)).light;
                let beside =
                    blade.look(rib.foot + rib.along * (0.5 * rib.length) + vec2(2.5 * RIB, 0.0)).light;
                assert!(on_rib.y > beside.y, "{shape:?}: {on_rib} {beside}");
            }
        }
    }
}
