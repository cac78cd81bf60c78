//! Up to sixteen roots that fan out from the foot (Lorite 2021, §3.5.3 and Appendix B).

use super::{Chain, Skeleton, smooth};
use crate::draws::{ROOTS, signed3};
use crate::params::Numbers;
use glam::{DVec3, dvec3};
use pleach_tree::trig::sin_cos;
use pleach_tree::{Address, Growth, Key, StemKind};
use std::f64::consts::TAU;

/// Radius of a root of width 1.
const RADIUS: f64 = 0.05;
/// How far a root of length 1 reaches.
const REACH: f64 = 0.6;
/// Most of the way to its neighbor that a root's end is turned.
const JITTER: f64 = 0.35;

/// Roots are numbered from here on: branches on the first trunk have the numbers before.
const AFTER_BRANCHES: u32 = 64;

/// What draws of roots are for.
mod purpose {
    pub(super) const COUNT: u32 = 0;
    pub(super) const FIRST: u32 = 1;
    pub(super) const ANGLE: u32 = 2;
    pub(super) const OFFSET: u32 = 3;
    pub(super) const DROP: u32 = 4;
}

/// Fewest and most roots where the slider is above 0 and up to 10, above 10 and up to 20, and so on
/// (Appendix B).
const COUNTS: [(u32, u32); 10] =
    [(2, 3), (4, 5), (5, 6), (6, 7), (7, 8), (8, 9), (9, 10), (10, 12), (12, 14), (14, 16)];

/// Number of roots for the slider's `quantity` and a uniform `draw`.
fn count(quantity: f64, draw: f64) -> u32 {
    let Some(bin) = ((quantity / 10.0).ceil() as usize).checked_sub(1) else { return 0 };
    let (least, most) = COUNTS[bin.min(9)];
    least + (draw * f64::from(most - least + 1)) as u32
}

/// Angle of root number `index` of `count`, as a part of a turn from the first quarter's start: evenly
/// spread and turned by `jitter` in [−1, 1). Each quarter has its share of the roots.
fn angle(index: u32, count: u32, jitter: f64) -> f64 {
    (f64::from(index) + 0.5 + JITTER * jitter) / f64::from(count)
}

pub(super) fn grow(skeleton: &mut Skeleton, numbers: &Numbers, growth: &Growth<'_>, key: Key) {
    let tree = key.child(ROOTS, u32::MAX);
    let (randomness, length) = (numbers.root_randomness, numbers.root_length);
    let first = tree.unit(purpose::FIRST, 0);
    let count = count(numbers.root_quantity, tree.unit(purpose::COUNT, 0));
    // Roots leave the foot as high as the trunk there is wide, so that they fan out of its side.
    let radius = RADIUS * numbers.root_width;
    let foot = dvec3(0.0, 0.0, 0.5 * skeleton.knots[0].radius + 0.5 * radius);
    let is_upper = randomness >= 0.5;
    for root in 0..count {
        let number = AFTER_BRANCHES + root;
        let draw = growth.draw(Address::trunk(0).child(number), 0);
        let key = draw.key(key.child(ROOTS, root));
        let turn = TAU * (first + angle(root, count, key.signed(purpose::ANGLE, 0)));
        let (sin, cos) = sin_cos(turn + draw.azimuth);
        let end = dvec3(cos, sin, 0.0) * (REACH * length * draw.length) - DVec3::Z * 0.03;
        let inner = if is_upper { 2 } else { 1 };
        let mut points = vec![foot];
        for i in 1..=inner + 1 {
            let part = f64::from(i) / f64::from(inner + 1);
            // Down to the ground soon, then along it.
            let level = foot.lerp(end, part) * dvec3(1.0, 1.0, (1.0 - part) * (1.0 - part));
            let offset = if i <= inner || is_upper {
                signed3(key, purpose::OFFSET, i) * (0.1 * randomness * length)
            } else {
                DVec3::ZERO
            };
            points.push(level + offset * dvec3(1.0, 1.0, 0.3) + DVec3::Z * (end.z * part));
        }
        if is_upper {
            let drop = 0.4 * (2.0 * randomness - 1.0) * key.unit(purpose::DROP, 0) * length;
            points[2].z -= drop / 3.0;
            points[3].z -= drop;
        }
        smooth(&mut points, randomness);
        // An end above the ground would be a leg.
        let last = points.len() - 1;
        points[last].z = points[last].z.min(-0.03);
        let radii: Vec<f64> =
            (0..points.len()).map(|i| radius * (1.0 - 0.65 * i as f64 / last as f64)).collect();
        let chain =
            Chain { kind: StemKind::Root, level: 0, parent: Some(0), number, offset: 0.0, knots: 0..0 };
        skeleton.push(chain, &points, &radii);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slider_gives_as_many_roots_as_the_report_says() {
        let range = |quantity: f64| (count(quantity, 0.0), count(quantity, 0.999_999));
        let expected = [
            (0.0, (0, 0)),
            (0.5, (2, 3)),
            (10.0, (2, 3)),
            (20.0, (4, 5)),
            (50.0, (7, 8)),
            (50.1, (8, 9)),
            (75.0, (10, 12)),
            (90.0, (12, 14)),
            (100.0, (14, 16)),
        ];
        for (quantity, counts) in expected {
            assert_eq!(range(quantity), counts, "at {quantity}");
        }
    }

    #[test]
    fn every_quarter_has_its_share_and_neighbors_keep_apart() {
        for count in [4, 8, 12, 16] {
            for jitter in [-1.0, 0.0, 0.999] {
                let of_quarter = |q: u32| {
                    let angles = (0..count).map(|i| angle(i, count, jitter));
                    angles.filter(|a| (a * 4.0) as u32 == q).count() as u32
                };
                assert!((0..4).all(|q| of_quarter(q) == count / 4), "{count} roots, turned by {jitter}");
            }
            let gap = angle(1, count, -1.0) - angle(0, count, 1.0);
            assert!(gap * f64::from(count) >= 0.3 - 1e-12, "{gap}");
        }
    }
}
