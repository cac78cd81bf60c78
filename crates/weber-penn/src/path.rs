//! The path of a stem: one point per segment, with handles, turns, tropism and forks.
//!
//! Weber and Penn 1995, §4.1, §4.2 and §4.8; Hewitt 2017, §3.2.1. A fork walks the rest of its
//! origin's segments.

use crate::model::{Level, Model};
use crate::purpose;
use crate::stem::{ForkStart, ForkState, StemSpec};
use glam::DVec3;
use pleach_tree::math;
use pleach_tree::turtle::{Turtle, rotate};
use std::f64::consts::{FRAC_PI_2, TAU};

/// A point of a path and what later steps need to know there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PathPoint {
    pub(crate) point: DVec3,
    pub(crate) handle_in: DVec3,
    pub(crate) handle_out: DVec3,
    /// Direction by which the point was reached.
    pub(crate) direction: DVec3,
    /// The turtle's right-hand axis there.
    pub(crate) right: DVec3,
    /// Part of the children that the segment which ends here keeps, after forks.
    pub(crate) keep: f64,
}

impl PathPoint {
    /// Where `turtle` has arrived, with handles that reach as far as `reach`.
    fn new(turtle: &Turtle, reach: DVec3, keep: f64) -> Self {
        let Turtle { position, direction, right } = *turtle;
        let mut point =
            Self { point: position, handle_in: position, handle_out: position, direction, right, keep };
        point.stand_at(position, reach);
        point
    }

    fn stand_at(&mut self, point: DVec3, reach: DVec3) {
        (self.point, self.handle_in, self.handle_out) = (point, point - reach, point + reach);
    }
}

/// Receives the forks of a path.
pub(crate) trait Forks {
    fn fork_at(&mut self, turtle: Turtle, state: ForkStart, index: u32);
}

/// Walks the path of `stem` at `length` metres for the whole stem; appends its points to `path`.
///
/// `child_length` is handed on to forks. `carry` is the error that `seg_splits` diffuses from
/// segment to segment and on to forks.
pub(crate) fn walk(
    model: &Model,
    stem: &StemSpec,
    length: f64,
    child_length: f64,
    carry: &mut f64,
    path: &mut Vec<PathPoint>,
    forks: &mut impl Forks,
) {
    let level = &model.levels[stem.level];
    if level.is_helix() {
        helix(model, level, stem, length, path);
        return;
    }
    let segments = level.curve_res;
    let start = stem.start();
    let step = length / f64::from(segments);
    let handle = step / 3.0;
    let pull = tropism(model, stem.level);
    let mut fork = stem.fork();
    let mut keep = fork.branch_factor;
    let mut turtle = stem.turtle;

    let leave = first_direction(stem);
    path.push(PathPoint::new(&turtle, leave * handle, keep));
    for i in start + 1..=segments {
        turtle.walk(step);
        let parting = if i < segments {
            forks_at(model, stem, i, carry, &mut fork, &mut keep)
        } else {
            Parting::default()
        };
        path.push(PathPoint::new(&turtle, turtle.direction * handle, keep));
        if i == segments {
            break;
        }
        if parting.forked_stems > 0 {
            part(level, stem, i, parting, &mut turtle, &mut fork, child_length, forks);
        } else {
            turn(level, stem, i, &fork, &mut turtle);
        }
        lean(&mut turtle, pull);
    }
}

/// Direction in which the path of `stem` begins.
fn first_direction(stem: &StemSpec) -> DVec3 {
    stem.forked.and_then(|c| c.first_handle).unwrap_or(stem.turtle.direction)
}

/// Moves the points from number `first` on, which are the path of `stem` at another length, to where walking at
/// `length` would have put them, to the last bit; handles may stay behind. But for helices, which are walked again,
/// no turn depends on the length.
pub(crate) fn stretch(model: &Model, stem: &StemSpec, length: f64, path: &mut Vec<PathPoint>, first: usize) {
    let level = &model.levels[stem.level];
    if level.is_helix() {
        path.truncate(first);
        helix(model, level, stem, length, path);
        return;
    }
    let step = length / f64::from(level.curve_res);
    let mut at = stem.turtle.position;
    for point in &mut path[first + 1..] {
        at += point.direction * step;
        point.point = at;
    }
}

/// [`stretch`], handles included.
pub(crate) fn lay_out(model: &Model, stem: &StemSpec, length: f64, path: &mut Vec<PathPoint>, first: usize) {
    stretch(model, stem, length, path, first);
    let level = &model.levels[stem.level];
    if level.is_helix() {
        return;
    }
    let handle = length / f64::from(level.curve_res) / 3.0;
    path[first].stand_at(stem.turtle.position, first_direction(stem) * handle);
    for point in &mut path[first + 1..] {
        point.stand_at(point.point, point.direction * handle);
    }
}

/// A fork about to happen.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Parting {
    /// Number of forks that leave.
    pub(crate) forked_stems: u32,
    /// Whether this is the fork where the trunk's bare base ends.
    base: bool,
}

/// How many forks leave at point `i`; updates the fork state.
pub(crate) fn forks_at(
    model: &Model,
    stem: &StemSpec,
    i: u32,
    carry: &mut f64,
    fork: &mut ForkState,
    keep: &mut f64,
) -> Parting {
    let level = &model.levels[stem.level];
    let base = (level.base_size * f64::from(level.curve_res)).ceil() as u32;
    if stem.level == 0 && i == base.max(1) && model.base_splits != 0 {
        return Parting { forked_stems: base_splits(model, stem), base: true };
    }
    if level.seg_splits <= 0.0 || (stem.level == 0 && i <= base) {
        return Parting::default();
    }
    if stem.fork_key.unit(purpose::SPLIT, i) > fork.probability {
        return Parting::default();
    }
    let forked_stems = (level.seg_splits + *carry).floor().max(0.0);
    *carry += level.seg_splits - forked_stems;
    fork.probability /= forked_stems + 1.0;
    fork.branch_factor = (fork.branch_factor / (forked_stems + 1.0)).max(0.8);
    *keep *= fork.branch_factor;
    Parting { forked_stems: forked_stems as u32, base: false }
}

/// The number of fork `j` of those that leave at point `i`: no other fork of the stem has it.
pub(crate) const fn fork_index(i: u32, j: u32) -> u32 {
    i * 32 + j
}

/// Clones where the bare base ends; a negative number is the most that may be drawn.
fn base_splits(model: &Model, stem: &StemSpec) -> u32 {
    let most = model.base_splits.unsigned_abs() as u32;
    if model.base_splits > 0 {
        most
    } else {
        (stem.fork_key.unit(purpose::BASE_SPLITS, 0) * f64::from(most + 1)) as u32
    }
}

/// Forks at point `i`, where `turtle` has just arrived: hands the new stems to `forks` and turns the stem itself.
#[expect(clippy::too_many_arguments, reason = "one step of the walk, split off to be read alone")]
fn part(
    level: &Level,
    stem: &StemSpec,
    i: u32,
    Parting { forked_stems: count, base }: Parting,
    turtle: &mut Turtle,
    fork: &mut ForkState,
    child_length: f64,
    forks: &mut impl Forks,
) {
    let arrival = *turtle;
    let declination = math::acos(arrival.direction.z.clamp(-1.0, 1.0));
    let varied = level.split_angle_v * stem.key.signed(purpose::SPLIT_ANGLE, i);
    let direct = level.split_angle < 0.0;
    let first_handle = (level.split_angle_v >= 0.0).then_some(arrival.direction);

    let (angle, spread) = if direct {
        (0.0, level.split_angle.abs() + varied)
    } else {
        // The add-on's bracket: R² weighs the declination only (PAPERS.md).
        let r = stem.key.unit(purpose::SPLIT_SPREAD, i);
        let from_level = (declination.to_degrees() - 90.0).abs();
        let spread = -(20.0 + 0.75 * (30.0 + from_level * r * r)).to_radians();
        ((level.split_angle + varied - declination).max(0.0), spread)
    };
    fork.correction = angle / f64::from(level.curve_res + 1 - i);

    for j in 0..count {
        let mut arm = arrival;
        if direct {
            let share = 0.5 * spread * f64::from(1 + j / 2);
            arm.turn_right(if j % 2 == 0 { -share } else { share });
        } else {
            arm.pitch_down(angle / 2.0);
            let about = if base {
                let jitter = level.split_angle_v * stem.key.signed(purpose::FORK_SPREAD, i * 32 + j);
                TAU * f64::from(j + 1) / f64::from(count + 1) + jitter
            } else if j == 0 {
                spread / 2.0
            } else {
                -spread / 2.0
            };
            arm.rotate_about(DVec3::Z, about);
        }
        let state = ForkStart { start: i, first_handle, child_length, fork: *fork };
        forks.fork_at(arm, state, fork_index(i, j));
    }

    if direct {
        if count == 1 {
            turtle.turn_right(spread / 2.0);
        }
    } else {
        turtle.pitch_down(angle / 2.0);
        if count == 1 && !base {
            turtle.rotate_about(DVec3::Z, -spread / 2.0);
        }
    }
}

/// Bends the turtle after point `i` of a segment that does not fork.
fn turn(level: &Level, stem: &StemSpec, i: u32, fork: &ForkState, turtle: &mut Turtle) {
    let segments = f64::from(level.curve_res);
    if level.bend_v != 0.0 {
        turtle.turn_right(-stem.key.signed(purpose::BEND, i) * level.bend_v / segments);
    }
    let curve = if level.curve_back == 0.0 {
        level.curve / segments
    } else if f64::from(i) < segments / 2.0 {
        2.0 * level.curve / segments
    } else {
        2.0 * level.curve_back / segments
    };
    let varied = stem.key.signed(purpose::CURVE, i) * level.curve_v / segments;
    turtle.pitch_down(curve + varied - fork.correction);
}

/// The pull on stems of this level: only sideways on trunks and their branches.
fn tropism(model: &Model, level: usize) -> DVec3 {
    if level < 2 { model.tropism.with_z(0.0) } else { model.tropism }
}

/// Turns the turtle towards `pull`, by 10° a unit at right angles.
fn lean(turtle: &mut Turtle, pull: DVec3) {
    turtle.lean(pull, 10.0_f64.to_radians());
}

/// A helix of half a turn per segment (Hewitt 2017, §3.2.1 *Helical Branches*).
///
/// The declination |`curve_v`| is kept within 1° and 89°, where the construction has a meaning.
fn helix(model: &Model, level: &Level, stem: &StemSpec, length: f64, path: &mut Vec<PathPoint>) {
    let segments = level.curve_res;
    let mut turtle = stem.turtle;
    lean(&mut turtle, tropism(model, stem.level));
    let axis = turtle.direction;

    let vary = |purpose| 0.8 + 0.4 * stem.key.unit(purpose, 0);
    let declination = (-level.curve_v).clamp(1.0_f64.to_radians(), 89.0_f64.to_radians());
    let pitch = 2.0 * length / f64::from(segments) * vary(purpose::HELIX_PITCH);
    let radius = 3.0 * pitch / (16.0 * math::tan(FRAC_PI_2 - declination)) * vary(purpose::HELIX_RADIUS);

    let b0 = DVec3::new(0.0, -radius, -pitch / 4.0);
    let b1 = DVec3::new(4.0 * radius / 3.0, -radius, 0.0);
    let b2 = DVec3::new(4.0 * radius / 3.0, radius, 0.0);
    let b3 = DVec3::new(0.0, radius, pitch / 4.0);
    // The local frame of the helix, spun by a random angle about its axis.
    let spin = TAU * stem.key.unit(purpose::HELIX_SPIN, 0);
    let x = rotate(turtle.right, axis, spin);
    let y = axis.cross(x);
    let site = |v: DVec3| x * v.x + y * v.y + axis * v.z;
    let (to_b1, to_b2, to_b3) = (site(b1 - b0), site(b2 - b0), site(b3 - b0));

    let mut at = turtle.position;
    path.push(PathPoint {
        point: at,
        handle_in: at,
        handle_out: at + to_b1,
        direction: to_b1.try_normalize().unwrap_or(axis),
        right: turtle.right,
        keep: 1.0,
    });
    // Half a turn about the axis for every segment: there are only two ways that they go.
    let half_turn = |v: DVec3| axis * (2.0 * axis.dot(v)) - v;
    let way = |to_b2: DVec3, to_b3: DVec3| (to_b2, to_b3, (to_b3 - to_b2).try_normalize().unwrap_or(axis));
    let ways = [way(to_b2, to_b3), way(half_turn(to_b2), half_turn(to_b3))];
    for &(to_b2, to_b3, direction) in ways.iter().cycle().take(segments as usize) {
        let handle_in = at + to_b2;
        at += to_b3;
        let handle_out = at * 2.0 - handle_in;
        path.push(PathPoint { point: at, handle_in, handle_out, direction, right: turtle.right, keep: 1.0 });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::space;
    use pleach_tree::param::table::Parameters;

    fn straight(values: &[(&str, f64)]) -> (Model, StemSpec) {
        let mut all = space().defaults();
        for (name, value) in values {
            for slot in space().select(name).unwrap() {
                all[slot.index()] = *value;
            }
        }
        (Model::read(&all), StemSpec::test_stem())
    }

    fn path(model: &Model, stem: &StemSpec) -> Vec<PathPoint> {
        let mut path = Vec::new();
        walk(model, stem, stem.length, 1.0, &mut 0.0, &mut path, &mut NoForks);
        path
    }

    /// Drops all forks.
    struct NoForks;

    impl Forks for NoForks {
        fn fork_at(&mut self, _: Turtle, _: ForkStart, _: u32) {}
    }

    const PLAIN: [(&str, f64); 6] = [
        ("curve", 0.0),
        ("curve_v", 0.0),
        ("bend_v", 0.0),
        ("tropism", 0.0),
        ("curve_res", 10.0),
        ("curve_back", 0.0),
    ];

    #[test]
    fn without_turns_a_stem_is_straight() {
        let (model, stem) = straight(&PLAIN);
        let path = path(&model, &stem);
        assert_eq!(path.len(), 11);
        assert!((path[10].point - DVec3::new(0.0, 0.0, 10.0)).length() < 1e-9);
    }

    #[test]
    fn curve_bends_all_but_the_last_segment() {
        let (model, stem) = straight(&[&PLAIN[..], &[("curve", 90.0)]].concat());
        let path = path(&model, &stem);
        let turned = path[10].direction.angle_between(DVec3::Z).to_degrees();
        assert!((turned - 81.0).abs() < 1e-9, "{turned}");
        assert!(path[10].point.y > 0.0, "a positive curve bends towards `down`");
    }

    #[test]
    fn curve_back_makes_an_s() {
        let (model, stem) = straight(&[&PLAIN[..], &[("curve", 60.0), ("curve_back", -60.0)]].concat());
        let path = path(&model, &stem);
        let lean = |i: usize| path[i].direction.angle_between(DVec3::Z).to_degrees();
        assert!(lean(5) > 45.0 && lean(10) < 15.0, "{} then {}", lean(5), lean(10));
    }

    #[test]
    fn a_helix_turns_half_round_a_segment_and_rises_steadily() {
        let (model, stem) = straight(&[&PLAIN[..], &[("curve_v", -30.0)]].concat());
        let path = path(&model, &stem);
        let rise = path[1].point.z - path[0].point.z;
        for (i, w) in path.windows(2).enumerate() {
            assert!((w[1].point.z - w[0].point.z - rise).abs() < 1e-9);
            let sideways = |a: &PathPoint, b: &PathPoint| (b.point - a.point).truncate();
            if i > 0 {
                let before = sideways(&path[i - 1], &path[i]);
                assert!((before + sideways(&w[0], &w[1])).length() < 1e-9, "half a turn each");
            }
        }
        // Declination of the tangent: |curve_v| from the axis, up to the draws of pitch and radius.
        let tangent = (path[0].handle_out - path[0].point).angle_between(DVec3::Z).to_degrees();
        assert!((20.0..45.0).contains(&tangent), "{tangent}");
    }

    #[test]
    fn tropism_pulls_and_does_not_overturn() {
        let (model, mut stem) = straight(&[&PLAIN[..], &[("tropism.z", -3.0)]].concat());
        stem.turtle = Turtle { position: DVec3::ZERO, direction: DVec3::X, right: DVec3::Y };
        let level_one = path(&model, &stem)[10].direction;
        assert_eq!(level_one, DVec3::X, "the vertical part spares level 1");
        stem.level = 2;
        let drooping = path(&model, &stem)[10].direction;
        assert!(drooping.z < -0.99, "{drooping}");
    }

    #[test]
    fn a_stretched_path_is_the_path_walked_at_that_length() {
        let same = |a: &PathPoint, b: &PathPoint| {
            let all = |p: &PathPoint| [p.point, p.handle_in, p.handle_out, p.direction, p.right];
            all(a) == all(b) && a.keep == b.keep
        };
        for name in crate::HEWITT_2017 {
            let species = crate::preset(name).unwrap();
            let mut values = species.params.values().to_vec();
            for helix in [false, true] {
                if helix {
                    let slot = space().select("curve_v[1]").unwrap()[0];
                    values[slot.index()] = -40.0;
                }
                let model = Model::read(&values);
                let stem = StemSpec::test_stem();
                let mut path = vec![PathPoint::new(&Turtle::UP, DVec3::X, 1.0)];
                let mut forks = NoForks;
                walk(&model, &stem, 10.0, 1.0, &mut 0.3, &mut path, &mut forks);
                for length in [9.0, 3.7, 10.0, 1e-3] {
                    let mut walked = Vec::new();
                    walk(&model, &stem, length, 1.0, &mut 0.3, &mut walked, &mut forks);
                    lay_out(&model, &stem, length, &mut path, 1);
                    assert_eq!(path.len(), walked.len() + 1, "{name}");
                    assert!(path[1..].iter().zip(&walked).all(|(a, b)| same(a, b)), "{name} at {length}");
                }
            }
        }
    }
}
