//! How many children a stem has, where they stand and how they leave.
//!
//! Weber and Penn 1995, §4.3; Hewitt 2017, §3.2.1 *Branch Distribution*. Leaves are spaced and
//! turned like children, so this module serves both.

use crate::budget::{Budget, CHILD_STEPS, Cause, Exceeded};
use crate::grow::{Buffers, GrowContext, MIN_LENGTH};
use crate::model::{Level, Model};
use crate::path::PathPoint;
use crate::purpose;
use crate::stem::StemSpec;
use glam::DVec3;
use pleach_tree::spline::Cubic;
use pleach_tree::turtle::Turtle;
use std::f64::consts::{PI, TAU};

/// A place for a child or a leaf.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ChildSite {
    /// Number along the stem, from 0 at its base, bare places included.
    pub(crate) number: u32,
    /// Index of the path's piece.
    pub(crate) piece: usize,
    /// Bézier parameter within the piece.
    pub(crate) t: f64,
    /// Metres from the base of the whole stem.
    pub(crate) offset: f64,
    /// Angle about the stem, radians; 0 leaves towards the stem's `down`.
    pub(crate) rotation: f64,
    /// For fans instead: turn to the right before pitching, radians.
    pub(crate) fan: Option<f64>,
}

/// What spacing needs to know of a stem and its children.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spacing<'a> {
    pub(crate) stem: &'a StemSpec,
    /// Parameters of the stem's own level.
    pub(crate) level: &'a Level,
    /// Parameters of the children.
    pub(crate) next: &'a Level,
    /// Children on a whole, unforked stem; negative for a fan at the tip.
    pub(crate) count: f64,
    /// Whether forks cost children; they cost no leaves.
    pub(crate) forks_cost: bool,
}

impl Spacing<'_> {
    /// Calls `each` for every place that is not on the bare base, from base to tip. Bare places
    /// are work as well, so all of a segment's are counted before the first is tried.
    pub(crate) fn sites(
        &self,
        path: &[PathPoint],
        (budget, cause): (&mut Budget<'_>, Cause),
        mut each: impl FnMut(&mut Budget<'_>, ChildSite) -> Result<(), Exceeded>,
    ) -> Result<(), Exceeded> {
        if self.count < 0.0 {
            budget.work(cause, self.stem.level, -self.count as u64)?;
            return self.fan(path, |site| each(budget, site));
        }
        let Self { stem, level, next, .. } = *self;
        let segments = f64::from(level.curve_res);
        let start = f64::from(stem.start());
        let bare = level.base_size * stem.length;
        // A fork carries (1 − start/c)²: once by number, once by having fewer segments.
        let per_segment = self.count * (1.0 - start / segments) / segments;
        let mut carry = 0.0;
        let mut number = 0;
        let mut turning = Turning::new(stem, next);
        for (piece, arrival) in path[1..].iter().enumerate() {
            let keep = if self.forks_cost { arrival.keep } else { 1.0 };
            let wanted = per_segment * keep + carry;
            let here = wanted.floor().max(0.0);
            carry = wanted - here;
            if here == 0.0 {
                continue;
            }
            budget.work(cause, stem.level, here as u64)?;
            let here = here as u32;
            let mut site = |number: u32, t: f64, rotation: f64| {
                let offset = stem.length * (start + piece as f64 + t) / segments;
                if offset > bare {
                    each(budget, ChildSite { number, piece, t, offset, rotation, fan: None })
                } else {
                    Ok(())
                }
            };
            if next.branch_dist > 1.0 {
                // Whorls; the error of their sizes is carried within the segment.
                let size = next.branch_dist + 1.0;
                let whorls = (f64::from(here) / size).floor() as u32;
                let mut error = 0.0;
                for whorl in 0..whorls {
                    let members = (size + error).floor();
                    error += size - members;
                    let members = members as u32;
                    for member in 0..members {
                        let about = TAU * f64::from(member) / f64::from(members);
                        let rotation = turning.member(number, about);
                        site(number, f64::from(whorl) / f64::from(whorls), rotation)?;
                        number += 1;
                    }
                    turning.next_whorl();
                }
            } else {
                for j in 0..here {
                    let j_f = f64::from(j);
                    let shift = if j % 2 == 0 { 0.0 } else { next.branch_dist };
                    let rotation = turning.next(number);
                    site(number, (j_f - shift) / f64::from(here), rotation)?;
                    number += 1;
                }
            }
        }
        Ok(())
    }

    fn fan<E>(&self, path: &[PathPoint], mut each: impl FnMut(ChildSite) -> Result<(), E>) -> Result<(), E> {
        let Self { stem, next, .. } = *self;
        let members = (-self.count).floor() as u32;
        let offset = stem.length;
        for number in 0..members {
            let part = if members > 1 { f64::from(number) / f64::from(members - 1) - 0.5 } else { 0.0 };
            let varied = next.rotate_v * stem.key.signed(purpose::ROTATE, number);
            let fan = next.rotate * part + varied;
            each(ChildSite { number, piece: path.len() - 2, t: 1.0, offset, rotation: 0.0, fan: Some(fan) })?;
        }
        Ok(())
    }

    /// Angle between a child at `offset` metres and the stem, radians.
    pub(crate) fn down_angle(&self, site: &ChildSite) -> f64 {
        let Self { stem, level, next, .. } = *self;
        let draw = || stem.key.signed(purpose::DOWN_ANGLE, site.number);
        if next.down_angle_v == 0.0 {
            next.down_angle
        } else if next.down_angle_v > 0.0 {
            next.down_angle + draw() * next.down_angle_v
        } else {
            let free = stem.length * (1.0 - level.base_size);
            let q = ((stem.length - site.offset) / free).clamp(0.0, 1.0);
            let angle = next.down_angle + next.down_angle_v * (1.0 - 2.0 * (0.2 + 0.8 * q));
            angle + 0.1 * draw() * angle.abs()
        }
    }

    /// A child or leaf at `site`: still on the axis of the stem, turned the way that it will grow.
    pub(crate) fn child_frame(&self, path: &[PathPoint], site: &ChildSite) -> ChildFrame {
        let (from, to) = (&path[site.piece], &path[site.piece + 1]);
        let cubic = Cubic::new(from.point, from.handle_out, to.handle_in, to.point);
        let position = cubic.at(site.t);
        let tangent = cubic.tangent(site.t, to.direction);
        let right = if self.level.is_helix() {
            // t × t′ for a tangent t′ a little further on, in the limit: the same side of the coil
            // all along it.
            tangent.cross(cubic.second_derivative(site.t)).try_normalize()
        } else {
            to.direction.cross(to.right).cross(tangent).try_normalize()
        };
        let right = right.unwrap_or_else(|| tangent.any_orthonormal_vector());
        let mut turtle = Turtle { position, direction: tangent, right };
        match site.fan {
            None => turtle.roll_right(site.rotation),
            Some(angle) => turtle.turn_right(angle),
        }
        let outward = turtle.down();
        turtle.pitch_down(self.down_angle(site));
        ChildFrame { turtle, outward }
    }
}

/// A child's turtle, still on the axis of its parent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ChildFrame {
    pub(crate) turtle: Turtle,
    /// Outward normal of the parent's surface on the child's side.
    pub(crate) outward: DVec3,
}

/// The running angle of children about their parent.
struct Turning<'a> {
    stem: &'a StemSpec,
    next: &'a Level,
    angle: f64,
    side: f64,
}

impl<'a> Turning<'a> {
    fn new(stem: &'a StemSpec, next: &'a Level) -> Self {
        let angle = if next.rotate >= 0.0 { TAU * stem.key.unit(purpose::START_ROTATION, 0) } else { 0.0 };
        Self { stem, next, angle, side: 1.0 }
    }

    fn varied(&self, number: u32) -> f64 {
        if self.next.rotate_v == 0.0 {
            0.0
        } else {
            self.next.rotate_v * self.stem.key.signed(purpose::ROTATE, number)
        }
    }

    /// The angle of the next single child.
    fn next(&mut self, number: u32) -> f64 {
        let varied = self.varied(number);
        if self.next.rotate >= 0.0 {
            self.angle = wrap(self.angle + self.next.rotate + varied);
            self.angle
        } else {
            let angle = self.side * (PI + self.next.rotate + varied);
            self.side = -self.side;
            angle
        }
    }

    /// The angle of a member of the present whorl, `about` radians from its first.
    fn member(&self, number: u32, about: f64) -> f64 {
        self.angle + about + self.varied(number)
    }

    fn next_whorl(&mut self) {
        self.angle = wrap(self.angle + self.next.rotate);
    }
}

/// `angle` less one turn where it is more; steps are at most two turns, so it stays small.
fn wrap(angle: f64) -> f64 {
    if angle >= TAU { angle - TAU } else { angle }
}

/// Number of children of a whole, unforked stem (Weber and Penn 1995, §4.3, and what the species
/// were tuned for: ±10 % on the trunk, and the count of a stem with a bare base packed on the rest).
fn count(model: &Model, stem: &StemSpec) -> f64 {
    let next = model.child_level(stem.level);
    if next.branches < 0.0 {
        return next.branches;
    }
    let count = match stem.level {
        0 => next.branches * (0.9 + 0.2 * stem.key.unit(purpose::BRANCH_COUNT, 0)),
        1 => next.branches * (0.2 + 0.8 * relative_length(stem)),
        _ => next.branches * (1.0 - 0.5 * stem.offset / stem.parent_length),
    };
    count / (1.0 - model.levels[stem.level].base_size)
}

/// Length of `stem` over the greatest that a child of its parent may have.
pub(crate) fn relative_length(stem: &StemSpec) -> f64 {
    let greatest = stem.parent_length * stem.parent_child_length;
    if greatest > 0.0 { stem.length / greatest } else { 0.0 }
}

/// Adds the children of `stem`, whose index in the tree is `index`, to the end of `buffers.children`.
pub(crate) fn collect(
    context: &GrowContext<'_>,
    buffers: &mut Buffers<'_>,
    stem: &StemSpec,
    index: u32,
    child_length: f64,
    first_point: usize,
) -> Result<(), Exceeded> {
    let model = context.model;
    let level = &model.levels[stem.level];
    let spacing = Spacing {
        stem,
        level,
        next: model.child_level(stem.level),
        count: count(model, stem),
        forks_cost: true,
    };
    let profile = context.profile(stem);
    let Buffers { path, children, budget, .. } = buffers;
    let prunes = model.prune_ratio > 0.0;
    let path = &path[first_point..];
    spacing.sites(path, (budget, Cause::Children), |budget, mut site| {
        let radius_here = profile.at(site.offset / stem.length);
        // The tip of a cone has no radius to bear a fan; its base has.
        let radius_limit = if site.fan.is_some() { stem.radius } else { radius_here };
        if radius_limit < MIN_PARENT_RADIUS {
            return Ok(());
        }
        let address = stem.address.child(site.number);
        let draw = context.growth.draw(address, stem.level + 1);
        let length = length(model, stem, child_length, site.offset) * draw.length;
        // What waits is counted as a stem, so it has to become one; pruning has the last word on it.
        let is_a_stem = length.is_finite() && length >= MIN_LENGTH;
        if !prunes && !is_a_stem {
            return Ok(());
        }
        budget.work(Cause::Children, stem.level, CHILD_STEPS)?;
        let key = draw.key(stem.key.child(purpose::CHILD, site.number));
        let mut child = StemSpec {
            key,
            fork_key: key,
            address,
            number: site.number,
            level: stem.level + 1,
            turtle: Turtle::UP,
            parent: Some(index),
            offset: site.offset,
            length,
            radius: 0.0,
            radius_limit,
            parent_length: stem.length,
            parent_radius: stem.radius,
            parent_child_length: child_length,
            scale: stem.scale,
            forked: None,
        };
        child.radius = child.branch_radius(model);
        // The child's base sits inside the rim of its parent (Hewitt 2017, §3.2.1).
        site.rotation += draw.azimuth;
        let ChildFrame { turtle, outward } = spacing.child_frame(path, &site);
        child.turtle = turtle;
        if draw.pitch != 0.0 {
            child.turtle.pitch_down(draw.pitch);
        }
        child.turtle.position += outward * (radius_here - child.radius.min(radius_here));
        children.push(child);
        budget.wait(children.len())
    })
}

/// A parent thinner than this, in metres, bears nothing.
const MIN_PARENT_RADIUS: f64 = 1e-4;

/// Nominal length of a child at `offset` metres along `stem`.
fn length(model: &Model, stem: &StemSpec, child_length: f64, offset: f64) -> f64 {
    let length = if stem.level == 0 {
        // The bare base keeps its length when the trunk is pruned.
        let base = model.levels[0].base_size * stem.parent_length;
        let q = (stem.length - offset) / (stem.length - base);
        stem.length * child_length * model.shape_ratio(q)
    } else {
        child_length * (stem.length - 0.7 * offset)
    };
    length.max(0.0)
}
