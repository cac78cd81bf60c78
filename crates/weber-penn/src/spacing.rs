//! Where children and leaves stand along a stem, and how they leave it.
//!
//! Weber and Penn 1995, §4.3; Hewitt 2017, §3.2.1 *Branch Distribution*. Leaves are spaced and
//! turned like children, so this module serves both.

use crate::budget::{Budget, Cause, Exceeded};
use crate::model::Level;
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
        let bare = self.bare();
        let mut shares = self.shares();
        let mut number = 0;
        let mut turning = Turning::new(self.stem, self.next);
        for (piece, arrival) in path[1..].iter().enumerate() {
            let here = shares.take(arrival.keep);
            if here == 0.0 {
                continue;
            }
            budget.work(cause, self.stem.level, here as u64)?;
            places(self.next.branch_dist, here as u32, |place| {
                let rotation = match place.member {
                    None => turning.next(number),
                    Some(member) => turning.member(number, member),
                };
                let offset = self.offset(piece, place.t);
                let site = ChildSite { number, piece, t: place.t, offset, rotation, fan: None };
                number += 1;
                if offset > bare { each(budget, site) } else { Ok(()) }
            })?;
        }
        Ok(())
    }

    /// Metres from the base of the whole stem that bear nothing.
    pub(crate) fn bare(&self) -> f64 {
        self.level.base_size * self.stem.length
    }

    /// Metres from the base of the whole stem to parameter `t` of piece `piece` of the stem.
    pub(crate) fn offset(&self, piece: usize, t: f64) -> f64 {
        let start = f64::from(self.stem.start());
        self.stem.length * (start + piece as f64 + t) / f64::from(self.level.curve_res)
    }

    /// How many places each segment has.
    pub(crate) fn shares(&self) -> Shares {
        let segments = f64::from(self.level.curve_res);
        let start = f64::from(self.stem.start());
        // A fork carries (1 − start/c)²: once by number, once by having fewer segments.
        let per_segment = self.count * (1.0 - start / segments) / segments;
        Shares { per_segment, forks_cost: self.forks_cost, carry: 0.0 }
    }

    /// Members of a fan.
    pub(crate) fn members(&self) -> u32 {
        (-self.count).floor() as u32
    }

    fn fan<E>(&self, path: &[PathPoint], mut each: impl FnMut(ChildSite) -> Result<(), E>) -> Result<(), E> {
        let offset = self.stem.length;
        for number in 0..self.members() {
            let fan = Some(self.fan_turn(number));
            each(ChildSite { number, piece: path.len() - 2, t: 1.0, offset, rotation: 0.0, fan })?;
        }
        Ok(())
    }

    /// How far member `number` of a fan is turned to the right, radians.
    pub(crate) fn fan_turn(&self, number: u32) -> f64 {
        let Self { stem, next, .. } = *self;
        let members = self.members();
        let part = if members > 1 { f64::from(number) / f64::from(members - 1) - 0.5 } else { 0.0 };
        let varied = next.rotate_v * stem.key.signed(purpose::ROTATE, number);
        next.rotate * part + varied
    }

    /// Angle between child `number` at `offset` metres and the stem, radians.
    pub(crate) fn down_angle(&self, number: u32, offset: f64) -> f64 {
        let Self { stem, level, next, .. } = *self;
        let draw = || stem.key.signed(purpose::DOWN_ANGLE, number);
        if next.down_angle_v == 0.0 {
            next.down_angle
        } else if next.down_angle_v > 0.0 {
            next.down_angle + draw() * next.down_angle_v
        } else {
            let free = stem.length * (1.0 - level.base_size);
            let q = ((stem.length - offset) / free).clamp(0.0, 1.0);
            let angle = next.down_angle + next.down_angle_v * (1.0 - 2.0 * (0.2 + 0.8 * q));
            angle + 0.1 * draw() * angle.abs()
        }
    }

    /// The end of the stem.
    pub(crate) fn tip(&self, path: &[PathPoint]) -> Turtle {
        self.axis(path, path.len() - 2, 1.0)
    }

    /// Where a piece of the stem is at `t`, along the stem, with the axis that a rotation of 0 has on its right.
    fn axis(&self, path: &[PathPoint], piece: usize, t: f64) -> Turtle {
        let (from, to) = (&path[piece], &path[piece + 1]);
        let cubic = Cubic::new(from.point, from.handle_out, to.handle_in, to.point);
        let position = cubic.at(t);
        let tangent = cubic.tangent(t, to.direction);
        let right = if self.level.is_helix() {
            // t × t′ for a tangent t′ a little further on, in the limit: the same side of the coil
            // all along it.
            tangent.cross(cubic.second_derivative(t)).try_normalize()
        } else {
            to.direction.cross(to.right).cross(tangent).try_normalize()
        };
        let right = right.unwrap_or_else(|| tangent.any_orthonormal_vector());
        Turtle { position, direction: tangent, right }
    }

    /// A child or leaf at `site`: still on the axis of the stem, turned the way that it will grow.
    pub(crate) fn child_frame(&self, path: &[PathPoint], site: &ChildSite) -> ChildFrame {
        let mut turtle = self.axis(path, site.piece, site.t);
        match site.fan {
            None => turtle.roll_right(site.rotation),
            Some(angle) => turtle.turn_right(angle),
        }
        let outward = turtle.down();
        turtle.pitch_down(self.down_angle(site.number, site.offset));
        ChildFrame { turtle, outward }
    }
}

/// Deals the places of a stem out to its segments; what rounding leaves over goes to the next one.
pub(crate) struct Shares {
    per_segment: f64,
    forks_cost: bool,
    carry: f64,
}

impl Shares {
    /// Places of the next segment, of which forks have left the part `keep`; bare places included.
    pub(crate) fn take(&mut self, keep: f64) -> f64 {
        let keep = if self.forks_cost { keep } else { 1.0 };
        let wanted = self.per_segment * keep + self.carry;
        let here = wanted.floor().max(0.0);
        self.carry = wanted - here;
        here
    }
}

/// A place on a segment.
pub(crate) struct Place {
    /// Parameter of the segment's piece of the path.
    pub(crate) t: f64,
    /// Which member of a whorl stands there, if any does.
    pub(crate) member: Option<Member>,
}

/// A member of a whorl.
#[derive(Clone, Copy)]
pub(crate) struct Member {
    /// Radians about the stem from the whorl's first member.
    about: f64,
    is_first: bool,
}

/// Calls `each` for the places of a segment that has `here` of them, or as many as are in whole whorls.
pub(crate) fn places<E>(
    branch_dist: f64,
    here: u32,
    mut each: impl FnMut(Place) -> Result<(), E>,
) -> Result<(), E> {
    if branch_dist > 1.0 {
        // The error of the sizes of whorls is carried within the segment.
        let size = branch_dist + 1.0;
        let whorls = (f64::from(here) / size).floor() as u32;
        let mut error = 0.0;
        for whorl in 0..whorls {
            let members = (size + error).floor();
            error += size - members;
            let members = members as u32;
            let t = f64::from(whorl) / f64::from(whorls);
            for member in 0..members {
                let about = TAU * f64::from(member) / f64::from(members);
                each(Place { t, member: Some(Member { about, is_first: member == 0 }) })?;
            }
        }
    } else {
        for j in 0..here {
            let shift = if j % 2 == 0 { 0.0 } else { branch_dist };
            each(Place { t: (f64::from(j) - shift) / f64::from(here), member: None })?;
        }
    }
    Ok(())
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
    /// Whether a whorl has been turned already.
    has_whorls: bool,
}

impl<'a> Turning<'a> {
    fn new(stem: &'a StemSpec, next: &'a Level) -> Self {
        let angle = if next.rotate >= 0.0 { TAU * stem.key.unit(purpose::START_ROTATION, 0) } else { 0.0 };
        Self { stem, next, angle, side: 1.0, has_whorls: false }
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

    /// The angle of the next member of a whorl.
    fn member(&mut self, number: u32, member: Member) -> f64 {
        if member.is_first && self.has_whorls {
            self.angle = wrap(self.angle + self.next.rotate);
        }
        self.has_whorls = true;
        self.angle + member.about + self.varied(number)
    }
}

/// `angle` less one turn where it is more; steps are at most two turns, so it stays small.
fn wrap(angle: f64) -> f64 {
    if angle >= TAU { angle - TAU } else { angle }
}
