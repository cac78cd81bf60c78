//! One to four trunks that part low (Lorite 2021, §3.5.2 and Appendix B).

use super::{Chain, Dealt, Skeleton, relax, smooth};
use crate::draws::{TRUNKS, signed3, turned};
use crate::params::{MIN_PARTING_HEIGHT, Numbers};
use glam::{DVec3, dvec3};
use pleach_tree::math;
use pleach_tree::{Address, Growth, Key, StemKind};

/// Radius of a trunk of width 1.
const RADIUS: f64 = 0.08;
/// Heights of the inner vertices over the trunk's. The report prints none.
const HEIGHTS: [f64; 3] = [0.15, 0.35, 0.7];
/// Where branches may grow, as a height over the trunk's: one trunk, and several, whose parting stays
/// bare.
const ZONE: [f64; 2] = [0.35, 0.5];
/// The vertex that keeps branches away from the parting, between it and the end.
const BARE: f64 = 0.12;

/// What draws of a trunk are for.
mod purpose {
    pub(super) const COUNT: u32 = 0;
    pub(super) const AXES: u32 = 1;
    pub(super) const END: u32 = 2;
    pub(super) const INNER: u32 = 3;
}

/// The direction in which a trunk leans where there are several.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Axis {
    MinusX,
    X,
    Y,
    MinusY,
}

/// Where a trunk ends, from where it parts (Appendix B): `height` up, `reach` times that sideways, and
/// moved by `random`. Heights above 6 count less.
pub(super) fn end(height: f64, axis: Axis, reach: f64, random: DVec3) -> DVec3 {
    let h = if height > 6.0 { height / 1.2 } else { height };
    let (ahead, aside) = (reach * h, h / 4.0);
    let lean = match axis {
        Axis::MinusX => dvec3(-ahead, random.y * aside, h),
        Axis::X => dvec3(ahead, random.y * aside, h),
        Axis::Y => dvec3(random.x * aside, ahead, h),
        Axis::MinusY => dvec3(random.x * aside, -ahead, h),
    };
    lean + random
}

/// How many trunks there are: as many as the numbers say, or by chance.
fn count(numbers: &Numbers, key: Key) -> u32 {
    if numbers.trunk_height <= MIN_PARTING_HEIGHT {
        return 1;
    }
    match numbers.trunks {
        0 => 1 + ((4.0 * numbers.trunk_randomness * key.unit(purpose::COUNT, 0)) as u32).min(3),
        said => said,
    }
}

/// The four axes in a random order; each trunk takes the next one.
fn axes(key: Key) -> [Axis; 4] {
    let mut axes = [Axis::MinusX, Axis::X, Axis::Y, Axis::MinusY];
    for i in (1..4_u32).rev() {
        let other = (key.unit(purpose::AXES, i) * f64::from(i + 1)) as usize;
        axes.swap(i as usize, other);
    }
    axes
}

pub(super) fn grow(skeleton: &mut Skeleton, numbers: &Numbers, growth: &Growth<'_>, key: Key) {
    let (height, randomness) = (numbers.trunk_height, numbers.trunk_randomness);
    let tree = key.child(TRUNKS, u32::MAX);
    let trunks = count(numbers, tree);
    let axes = axes(tree);
    skeleton.trunk_count = trunks;
    // Where several trunks part rises more slowly than their ends.
    let parting = HEIGHTS[0] * if trunks > 1 { math::pow(height, 0.7) } else { height };
    let lean = if trunks > 1 { 0.0 } else { 0.05 * randomness * height };
    let v1 = dvec3(lean * tree.signed(purpose::INNER, 0), lean * tree.signed(purpose::INNER, 1), parting);
    let firmness = 0.5 * height / (height + 2.0) * (2.0 + f64::from(trunks)) / 6.0 * (1.0 + randomness) / 2.0;
    for trunk in 0..trunks {
        let address = if trunk == 0 { Address::trunk(0) } else { Address::trunk(0).fork(trunk) };
        let draw = growth.draw(address, 0);
        skeleton.dealt.push(Dealt { address, draw });
        let key = skeleton.key_on(trunk, key.child(TRUNKS, trunk));
        let random = signed3(key, purpose::END, 0) * (0.25 * randomness * height);
        let tip = if trunks > 1 {
            v1 + end(height, axes[trunk as usize], 0.25 + 0.35 * randomness, random)
        } else {
            // A single trunk has no axis and leans half as far.
            dvec3(random.x / 2.0, random.y / 2.0, height + random.z / 2.0)
        };
        let part = |share: f64| v1.lerp(tip, (share - HEIGHTS[0]) / (1.0 - HEIGHTS[0]));
        let offset =
            |i: u32| signed3(key, purpose::INNER, i) * dvec3(1.0, 1.0, 0.3) * (0.12 * randomness * height);
        // From the parting on; the first and the last stay.
        let mut points = vec![v1];
        if trunks > 1 {
            points.push(v1.lerp(tip, BARE));
        }
        points.extend([part(HEIGHTS[1]) + offset(1), part(HEIGHTS[2]) + offset(2), tip]);
        let last = points.len() as f64 - 1.0;
        relax(&mut points, |i| firmness * i as f64 / last);
        smooth(&mut points, randomness);
        // The first trunk turns with the whole tree.
        if trunk > 0 && (draw.azimuth, draw.pitch) != (0.0, 0.0) {
            let turn = turned(&draw);
            points.iter_mut().for_each(|point| *point = v1 + turn * (*point - v1));
        }
        // Arms share what the trunk below carries, as Leonardo has it, though not quite: thin arms look
        // lost in this style.
        let share = math::pow(f64::from(trunks), -0.35);
        let body = RADIUS * numbers.trunk_width;
        let mut radii: Vec<f64> = (0..points.len())
            .map(|i| {
                let up = i as f64 / last;
                let narrowed = 1.0 + (numbers.trunk_width_end - 1.0) * up * up;
                body * narrowed * if i > 0 { share } else { 1.0 }
            })
            .collect();
        let own_length = |points: &[DVec3]| points.windows(2).map(|w| w[0].distance(w[1])).sum::<f64>();
        let zone = ZONE[usize::from(trunks > 1)];
        let bare = own_length(&points) * (zone - HEIGHTS[0]) / (1.0 - HEIGHTS[0]);
        if trunk == 0 {
            points.insert(0, DVec3::ZERO);
            radii.insert(0, RADIUS * numbers.trunk_width_base);
        }
        let (kind, parent) = if trunk == 0 { (StemKind::Trunk, None) } else { (StemKind::Fork, Some(0)) };
        let offset = if trunk == 0 { 0.0 } else { skeleton.trunk(0).length_to(1) };
        let chain = Chain { kind, level: 0, parent, number: trunk, offset, knots: 0..0 };
        skeleton.push(chain, &points, &radii);
        let below = if trunk == 0 { skeleton.trunk(0).length_to(1) } else { 0.0 };
        skeleton.zone_starts.push(below + bare);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trunks_end_where_the_worked_examples_say() {
        let random = dvec3(0.1, -0.2, 0.05);
        let expected = [
            (2.0, Axis::MinusX, [-0.5, -0.3, 2.05]),
            (2.0, Axis::X, [0.7, -0.3, 2.05]),
            (2.0, Axis::Y, [0.15, 0.4, 2.05]),
            (2.0, Axis::MinusY, [0.15, -0.8, 2.05]),
            (7.2, Axis::MinusX, [-1.7, -0.5, 6.05]),
            (7.2, Axis::X, [1.9, -0.5, 6.05]),
            (7.2, Axis::Y, [0.25, 1.6, 6.05]),
            (7.2, Axis::MinusY, [0.25, -2.0, 6.05]),
        ];
        for (height, axis, at) in expected {
            let found = end(height, axis, 0.3, random);
            assert!(found.distance(DVec3::from(at)) < 1e-12, "{height} {axis:?}: {found}");
        }
    }

    #[test]
    fn no_two_trunks_lean_the_same_way() {
        for seed in 0..50 {
            let drawn = axes(Key::root(seed));
            assert!((0..4).all(|i| (0..i).all(|j| drawn[i] != drawn[j])), "{drawn:?}");
        }
    }
}
