//! Branches of four vertices (Lorite 2021, §3.5.4).

use super::nodes::{MAX_OF_SEGMENT, MAX_OF_TRUNK, SEGMENTS as SEGMENT_COUNT, deal};
use super::path::Place;
use super::{BranchEnd, Chain, Skeleton, smooth};
use crate::draws::{BRANCHES, SEGMENTS, signed3};
use crate::params::Numbers;
use glam::{DVec3, dvec3};
use pleach_tree::trig::sin_cos;
use pleach_tree::{Draw, Growth, Key, StemKind};
use std::f64::consts::TAU;

/// Radius of a branch of width 1.
const RADIUS: f64 = 0.05;
/// Radii from node to end, over the first.
const TAPER: [f64; 4] = [1.0, 0.85, 0.65, 0.4];
/// How long a branch of length 1 at the bottom of the zone is.
const LENGTH: f64 = 0.45;
/// Degrees above level between which branches leave their trunk.
const ELEVATIONS: (f64, f64) = (10.0, 50.0);

/// What draws of a segment are for.
mod of_segment {
    pub(super) const COUNT: u32 = 0;
    pub(super) const DEAL: u32 = 1;
    pub(super) const PATTERN: u32 = 2;
    pub(super) const TURN: u32 = 3;
}

/// What draws of a branch are for.
mod of_branch {
    pub(super) const PLACE: u32 = 0;
    pub(super) const AZIMUTH: u32 = 1;
    pub(super) const ELEVATION: u32 = 2;
    pub(super) const IS_DEAD: u32 = 3;
    pub(super) const OFFSET: u32 = 4;
}

/// Where a branch grows.
struct Node {
    place: Place,
    /// How far along the trunk.
    offset: f64,
    /// From 0 at the bottom of the zone to 1 at the trunk's end.
    height: f64,
    /// Part of a turn.
    azimuth: f64,
    /// Of the branch, on its trunk.
    number: u32,
    draw: Draw,
}

/// Number of branches on a trunk for the slider's `quantity` and a uniform `draw`.
fn count(quantity: f64, draw: f64) -> u32 {
    let least = u32::from(quantity > 0.0);
    let wanted = (f64::from(MAX_OF_TRUNK) * quantity / 100.0 + draw - 0.5).round();
    (wanted.max(0.0) as u32).clamp(least, MAX_OF_TRUNK)
}

/// How branch number `index` of `count` is turned around the trunk, as a part of a turn: alternate,
/// opposite in pairs at right angles, or whorled.
fn turned(pattern: u32, index: u32, count: u32) -> f64 {
    let index = f64::from(index);
    match pattern {
        0 => index * (137.5 / 360.0),
        1 => 0.5 * (index % 2.0) + 0.25 * (index / 2.0).floor(),
        _ => index / f64::from(count),
    }
}

pub(super) fn grow(skeleton: &mut Skeleton, numbers: &Numbers, growth: &Growth<'_>, key: Key) {
    if numbers.branch_quantity <= 0.0 {
        return;
    }
    for trunk in 0..skeleton.trunk_count {
        let of_trunk = skeleton.key_on(trunk, key.child(SEGMENTS, trunk));
        let count = count(numbers.branch_quantity, of_trunk.unit(of_segment::COUNT, 0));
        let dealt = deal(count, of_trunk, of_segment::DEAL);
        for (segment, &count) in (0..).zip(&dealt) {
            let pattern = (3.0 * of_trunk.unit(of_segment::PATTERN, segment)) as u32;
            let first = of_trunk.unit(of_segment::TURN, segment);
            for index in 0..count {
                let number = segment * MAX_OF_SEGMENT + index;
                let own = skeleton.key_on(trunk, key.child(BRANCHES, trunk * MAX_OF_TRUNK + number));
                let draw = growth.draw(skeleton.dealt[trunk as usize].address.child(number), 1);
                let key = draw.key(own);
                // From the segment's bottom to its top, with a gap of 0.4 of even spacing at least.
                let up = (f64::from(index) + 0.5 + 0.3 * key.signed(of_branch::PLACE, 0)) / f64::from(count);
                let height = (f64::from(SEGMENT_COUNT - 1 - segment) + up) / f64::from(SEGMENT_COUNT);
                let azimuth =
                    first + turned(pattern, index, count) + key.signed(of_branch::AZIMUTH, 0) / 18.0;
                let path = skeleton.trunk(trunk);
                let start = skeleton.zone_starts[trunk as usize];
                let offset = start + (path.length() - start) * height;
                let place = path.at(offset);
                let node = Node { place, offset, height, azimuth, number, draw };
                // Whether it lives is its own in any case: foliage elsewhere may depend on it.
                let is_dead = own.unit(of_branch::IS_DEAD, 0) < numbers.dead_branches;
                branch(skeleton, numbers, trunk, &node, key, is_dead);
            }
        }
    }
}

fn branch(skeleton: &mut Skeleton, numbers: &Numbers, trunk: u32, node: &Node, key: Key, is_dead: bool) {
    let draw = node.draw;
    let whole = LENGTH * numbers.branch_length * draw.length * (1.0 - 0.4 * node.height);
    let length = if is_dead { whole / 3.0 } else { whole };
    let (low, high) = ELEVATIONS;
    let elevation = (low + (high - low) * key.unit(of_branch::ELEVATION, 0)).to_radians();
    // Away from the tip is down.
    let elevation = elevation - draw.pitch;
    let ((sin_e, cos_e), (sin_a, cos_a)) = (sin_cos(elevation), sin_cos(TAU * node.azimuth + draw.azimuth));
    let along = dvec3(cos_e * cos_a, cos_e * sin_a, sin_e);
    let randomness = numbers.branch_randomness;
    let radius = (RADIUS * numbers.branch_width).min(0.9 * node.place.radius);
    let radii = TAPER.map(|taper| taper * radius);
    let mut points = [node.place.point; 4];
    for (i, point) in (0_u32..).zip(&mut points).skip(1) {
        let part = f64::from(i) / 3.0;
        let offset = signed3(key, of_branch::OFFSET, i) * (0.15 * length * randomness);
        let risen = 0.6 * numbers.tropism * length * part * part;
        *point += along * (length * part) + offset + DVec3::Z * risen;
    }
    smooth(&mut points, randomness);
    for (point, radius) in points.iter_mut().zip(radii).skip(1) {
        // What hangs to the ground lies on it.
        point.z = point.z.max(radius.min(node.place.point.z));
    }
    let Node { number, offset, .. } = *node;
    let chain = Chain { kind: StemKind::Branch, level: 1, parent: Some(trunk), number, offset, knots: 0..0 };
    let chain = skeleton.push(chain, &points, &radii);
    if !is_dead {
        skeleton.ends.push(BranchEnd { chain, at: points[3], key });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slider_is_in_per_cent_of_twelve() {
        assert_eq!(count(0.0, 0.99), 0);
        assert_eq!(count(0.1, 0.0), 1, "above 0 there is one");
        assert_eq!((count(50.0, 0.01), count(50.0, 0.99)), (6, 6));
        assert_eq!((count(54.0, 0.0), count(54.0, 0.99)), (6, 7));
        assert_eq!((count(100.0, 0.0), count(100.0, 0.99)), (12, 12));
    }

    #[test]
    fn opposite_branches_are_half_a_turn_apart() {
        assert_eq!([0, 1, 2, 3].map(|i| turned(1, i, 4)), [0.0, 0.5, 0.25, 0.75]);
        assert_eq!([0, 1, 2].map(|i| turned(2, i, 3)), [0.0, 1.0 / 3.0, 2.0 / 3.0]);
    }
}
