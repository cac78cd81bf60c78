//! Eight leaves at a time: where they sit on their stem and how they are turned.
//!
//! Most parts of a tree are leaves, and placing one is a long chain of dependent arithmetic. Done
//! for eight in step, without branches, the compiler keeps the processor's vector units busy: this
//! is three times as fast as one leaf after another. Single precision, which a leaf is stored in.

use crate::path::PathPoint;
use glam::{DVec3, Vec3};
use std::f32::consts::{FRAC_2_PI, FRAC_PI_2, FRAC_PI_4, PI};

/// Leaves in a batch.
pub(crate) const LANES: usize = 8;

type Lane = [f32; LANES];
type Lane3 = [Lane; 3];

/// A leaf before it is placed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LeafSite {
    /// Index of the path's piece.
    pub(crate) piece: usize,
    /// Bézier parameter within the piece.
    pub(crate) t: f64,
    /// Angle about the stem, radians.
    pub(crate) rotation: f64,
    /// Angle away from the stem, radians.
    pub(crate) down_angle: f64,
    /// Radius of the stem there, metres.
    pub(crate) radius: f64,
}

/// Up to eight leaves on one stem.
#[derive(Clone, Debug, Default)]
pub(crate) struct LeafBatch {
    points: [Lane3; 4],
    /// Where a rotation of 0 leads, before it is made square to the tangent; zero on helices.
    down: Lane3,
    /// Direction of growth, for pieces that stand still.
    ahead: Lane3,
    t: Lane,
    rotation: Lane,
    down_angle: Lane,
    radius: Lane,
    len: usize,
    position: Lane3,
    along: Lane3,
    across: Lane3,
}

impl LeafBatch {
    pub(crate) const fn len(&self) -> usize {
        self.len
    }

    pub(crate) const fn clear(&mut self) {
        self.len = 0;
    }

    /// Adds a leaf of the stem with this `path`.
    pub(crate) fn push(&mut self, path: &[PathPoint], helix: bool, site: &LeafSite) {
        let lane = self.len;
        let (from, to) = (&path[site.piece], &path[site.piece + 1]);
        let set = |lanes: &mut Lane3, v: DVec3| {
            for (axis, value) in lanes.iter_mut().zip(v.to_array()) {
                axis[lane] = value as f32;
            }
        };
        for (lanes, point) in
            self.points.iter_mut().zip([from.point, from.handle_out, to.handle_in, to.point])
        {
            set(lanes, point);
        }
        set(&mut self.down, if helix { DVec3::ZERO } else { to.direction.cross(to.right) });
        set(&mut self.ahead, to.direction);
        self.t[lane] = site.t as f32;
        self.rotation[lane] = site.rotation as f32;
        self.down_angle[lane] = site.down_angle as f32;
        self.radius[lane] = site.radius as f32;
        self.len += 1;
    }

    /// Places every leaf; `bend` is `leaf_bend`.
    pub(crate) fn site(&mut self, helix: bool, bend: f32) {
        self.evaluate(if helix { 1.0 } else { 0.0 });
        self.turn();
        if bend > 0.0 {
            self.face_the_light(bend);
        }
    }

    /// Position, direction and right-hand axis (both of unit length) of leaf `lane`.
    pub(crate) fn leaf(&self, lane: usize) -> (Vec3, Vec3, Vec3) {
        let get = |lanes: &Lane3| Vec3::new(lanes[0][lane], lanes[1][lane], lanes[2][lane]);
        (get(&self.position), get(&self.along), get(&self.across))
    }

    /// Evaluates the curve: position, tangent (in `along`) and the right-hand axis of a leaf that
    /// leaves towards `down` (in `across`). `helix` is 1 on helices, where the second derivative
    /// leads, and 0 elsewhere.
    #[inline(never)]
    fn evaluate(&mut self, helix: f32) {
        let Self { points: [a, b, c, d], down, ahead, t, position, along, across, .. } = self;
        for i in 0..LANES {
            let (t, s) = (t[i], 1.0 - t[i]);
            let blend = |w: [f32; 4]| {
                [
                    a[0][i] * w[0] + b[0][i] * w[1] + c[0][i] * w[2] + d[0][i] * w[3],
                    a[1][i] * w[0] + b[1][i] * w[1] + c[1][i] * w[2] + d[1][i] * w[3],
                    a[2][i] * w[0] + b[2][i] * w[1] + c[2][i] * w[2] + d[2][i] * w[3],
                ]
            };
            let point = blend([s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]);
            let velocity = blend([-s * s, s * s - 2.0 * s * t, 2.0 * s * t - t * t, t * t]);
            let turn = blend([s, t - 2.0 * s, s - 2.0 * t, t]);
            let tangent = unit(velocity, [ahead[0][i], ahead[1][i], ahead[2][i]]);
            // right = down × tangent, with the curve's own turning for `down` on helices.
            let down =
                [down[0][i] - helix * turn[0], down[1][i] - helix * turn[1], down[2][i] - helix * turn[2]];
            let right = unit(cross(down, tangent), level(tangent));
            (position[0][i], position[1][i], position[2][i]) = (point[0], point[1], point[2]);
            (along[0][i], along[1][i], along[2][i]) = (tangent[0], tangent[1], tangent[2]);
            (across[0][i], across[1][i], across[2][i]) = (right[0], right[1], right[2]);
        }
    }

    /// Rolls each leaf about the stem, moves it to the surface and leans it away.
    #[inline(never)]
    fn turn(&mut self) {
        let Self { rotation, down_angle, radius, position, along, across, .. } = self;
        for i in 0..LANES {
            let tangent = [along[0][i], along[1][i], along[2][i]];
            let right = [across[0][i], across[1][i], across[2][i]];
            let (sin, cos) = sin_cos(rotation[i]);
            let right = combine(right, cos, cross(tangent, right), sin);
            let outward = cross(tangent, right);
            let (sin, cos) = sin_cos(down_angle[i]);
            let leaf = combine(tangent, cos, outward, sin);
            position[0][i] += outward[0] * radius[i];
            position[1][i] += outward[1] * radius[i];
            position[2][i] += outward[2] * radius[i];
            (along[0][i], along[1][i], along[2][i]) = (leaf[0], leaf[1], leaf[2]);
            (across[0][i], across[1][i], across[2][i]) = (right[0], right[1], right[2]);
        }
    }

    /// Turns each leaf outwards and then up, by the part `bend` of what is missing (Weber and Penn
    /// 1995, §4.9). Outwards goes the shorter way round.
    #[inline(never)]
    fn face_the_light(&mut self, bend: f32) {
        for i in 0..LANES {
            let at = |lanes: &Lane3| [lanes[0][i], lanes[1][i], lanes[2][i]];
            let (p, along, across) = (at(&self.position), at(&self.along), at(&self.across));
            let n = cross(along, across);
            let outwards = atan2(n[0] * p[1] - n[1] * p[0], n[0] * p[0] + n[1] * p[1]);
            let (sin, cos) = sin_cos(bend * outwards);
            let about_z = |v: [f32; 3]| [v[0] * cos - v[1] * sin, v[0] * sin + v[1] * cos, v[2]];
            let (along, across, n) = (about_z(along), about_z(across), about_z(n));

            // Up is a turn of the normal towards +z about the level axis n × z.
            let flat = (n[0] * n[0] + n[1] * n[1]).sqrt();
            let (sin, cos) = sin_cos(bend * atan2(flat, n[2]));
            let scale = 1.0 / flat.max(1e-12);
            let axis = [n[1] * scale, -n[0] * scale, 0.0];
            let lift = |v: [f32; 3]| {
                let side = cross(axis, v);
                let kept = (axis[0] * v[0] + axis[1] * v[1]) * (1.0 - cos);
                [
                    v[0] * cos + side[0] * sin + axis[0] * kept,
                    v[1] * cos + side[1] * sin + axis[1] * kept,
                    v[2] * cos + side[2] * sin,
                ]
            };
            let (along, across) = (lift(along), lift(across));
            for k in 0..3 {
                self.along[k][i] = along[k];
                self.across[k][i] = across[k];
            }
        }
    }
}

#[inline(always)]
fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn combine(a: [f32; 3], by_a: f32, b: [f32; 3], by_b: f32) -> [f32; 3] {
    [a[0] * by_a + b[0] * by_b, a[1] * by_a + b[1] * by_b, a[2] * by_a + b[2] * by_b]
}

/// `v` at length 1, or `otherwise` where it has none.
#[inline(always)]
fn unit(v: [f32; 3], otherwise: [f32; 3]) -> [f32; 3] {
    let squared = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    // Blended, not selected: a choice between loads would keep the loop from being vectorised.
    let none = if squared > 1e-24 { 0.0 } else { 1.0 };
    let scale = (1.0 - none) / (squared + none).sqrt();
    [
        v[0] * scale + otherwise[0] * none,
        v[1] * scale + otherwise[1] * none,
        v[2] * scale + otherwise[2] * none,
    ]
}

/// Some unit vector at right angles to the unit vector `t`.
#[inline(always)]
fn level(t: [f32; 3]) -> [f32; 3] {
    let flat = t[0] * t[0] + t[1] * t[1];
    let steep = if flat < 1e-6 { 1.0 } else { 0.0 };
    let scale = (1.0 - steep) / (flat + steep).sqrt();
    [steep - t[1] * scale, t[0] * scale, 0.0]
}

/// Sine and cosine of `x` radians, |x| up to 10³, within 2·10⁻⁷ of a turn's rounding.
#[inline(always)]
fn sin_cos(x: f32) -> (f32, f32) {
    const ROUNDER: f32 = 12_582_912.0;
    const HALF_PI_HIGH: f32 = 1.570_312_5;
    const HALF_PI_LOW: f32 = 4.838_268e-4;
    let shifted = x * FRAC_2_PI + ROUNDER;
    let quarter = shifted.to_bits();
    let turns = shifted - ROUNDER;
    let r = (x - turns * HALF_PI_HIGH) - turns * HALF_PI_LOW;
    let u = r * r;
    let sin = r * (1.0 + u * (-1.0 / 6.0 + u * (1.0 / 120.0 + u * (-1.0 / 5040.0 + u / 362_880.0))));
    let cos = 1.0 + u * (-0.5 + u * (1.0 / 24.0 + u * (-1.0 / 720.0 + u / 40_320.0)));
    let swap = 0_u32.wrapping_sub(quarter & 1);
    let (sin, cos) = (sin.to_bits(), cos.to_bits());
    let difference = (sin ^ cos) & swap;
    let sin_sign = (quarter & 2) << 30;
    let cos_sign = (quarter.wrapping_add(1) & 2) << 30;
    (f32::from_bits(sin ^ difference ^ sin_sign), f32::from_bits(cos ^ difference ^ cos_sign))
}

/// The angle of (`x`, `y`) from the x axis within 3·10⁻⁷; some number for (0, 0).
#[inline(always)]
fn atan2(y: f32, x: f32) -> f32 {
    let (ax, ay) = (x.abs(), y.abs());
    let steep = ax < ay;
    let low = if steep { ax } else { ay };
    let high = if steep { ay } else { ax }.max(f32::MIN_POSITIVE);
    let far = low > 0.414_213_57 * high;
    let q = (low - if far { high } else { 0.0 }) / (high + if far { low } else { 0.0 });
    let u = q * q;
    let p = ATAN[0] + u * (ATAN[1] + u * (ATAN[2] + u * (ATAN[3] + u * ATAN[4])));
    let angle = (if far { FRAC_PI_4 } else { 0.0 }) + q * p;
    let angle = if steep { FRAC_PI_2 - angle } else { angle };
    let angle = if x < 0.0 { PI - angle } else { angle };
    if y < 0.0 { -angle } else { angle }
}

/// Interpolates atan(√u)/√u at the Chebyshev nodes of [0, tan²(π/8)]; error 7·10⁻⁹.
const ATAN: [f32; 5] = [0.999_999_98, -0.333_327_86, 0.199_740_82, -0.138_484_9, 0.079_762_92];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Level;
    use crate::spacing::{ChildSite, Spacing};
    use crate::stem::StemSpec;
    use pleach_tree::Key;
    use pleach_tree::turtle::Turtle;
    use std::f64::consts::TAU;

    /// Random pieces of random stems; the draws of `key` are numbered by what they are for.
    fn path(key: Key) -> Vec<PathPoint> {
        let vector = |i: u32| DVec3::new(key.signed(i, 0), key.signed(i, 1), key.signed(i, 2));
        let direction = vector(0).normalize();
        let right = direction.cross(vector(1)).normalize();
        let point = |i: u32| PathPoint {
            point: vector(i) * 5.0,
            handle_in: vector(i) * 5.0 - vector(i + 1),
            handle_out: vector(i) * 5.0 + vector(i + 1),
            direction,
            right,
            keep: 1.0,
        };
        vec![point(10), point(20)]
    }

    #[test]
    fn eight_at_a_time_agrees_with_one_by_one() {
        for (helix, bend) in [(false, 0.0), (false, 0.7), (true, 0.0), (true, 0.3)] {
            for case in 0..200 {
                let key = Key::root(case);
                let path = path(key);
                let level = Level { curve_v: if helix { -0.5 } else { 0.0 }, ..Level::default() };
                let stem = StemSpec::test_stem();
                let mut batch = LeafBatch::default();
                let mut expected = Vec::new();
                for i in 0..LANES as u32 {
                    let (t, rotation) = (key.unit(40, i), TAU * key.unit(41, i));
                    let next = Level { down_angle: 3.0 * key.signed(42, i), ..Level::default() };
                    let site = ChildSite { number: i, piece: 0, t, offset: 0.0, rotation, fan: None };
                    let spacing =
                        Spacing { stem: &stem, level: &level, next: &next, count: 8.0, forks_cost: false };
                    let child_frame = spacing.child_frame(&path, &site);
                    let mut turtle: Turtle = child_frame.turtle;
                    turtle.position += child_frame.outward * 0.25;
                    if bend > 0.0 {
                        turtle.face_the_light(bend);
                    }
                    expected.push(turtle);
                    let site = LeafSite { piece: 0, t, rotation, down_angle: next.down_angle, radius: 0.25 };
                    batch.push(&path, helix, &site);
                }
                batch.site(helix, bend as f32);
                for (i, turtle) in expected.iter().enumerate() {
                    let (position, along, across) = batch.leaf(i);
                    let off = (position - turtle.position.as_vec3()).length();
                    assert!(off < 2e-5, "case {case}, leaf {i}: position off by {off}");
                    // Near the vertical, outwards has no direction, and single precision picks another.
                    let turned = (along - turtle.direction.as_vec3()).length()
                        + (across - turtle.right.as_vec3()).length();
                    let flat = turtle.down().truncate().length();
                    assert!(
                        turned < 1e-3 || (bend > 0.0 && flat < 0.05),
                        "case {case}, leaf {i}: off by {turned}"
                    );
                }
            }
        }
    }

    #[test]
    fn single_precision_angles_are_good_enough_for_a_leaf() {
        for i in -20_000..20_000_i32 {
            let x = i as f32 * 1e-3;
            let (sin, cos) = sin_cos(x);
            assert!((sin - x.sin()).abs() < 4e-7 && (cos - x.cos()).abs() < 4e-7, "{x}");
            let (y, x) = (x.sin() * (1.0 + x * x), x.cos() * (1.0 + x * x));
            assert!((atan2(y, x) - y.atan2(x)).abs() < 6e-7, "{y} {x}");
        }
    }
}
