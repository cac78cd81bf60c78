//! Twigs on the outer branches, and smaller twigs on them.
//!
//! Weber and Penn 1995, §4.1–4.3 and 4.8: down angle, rotation by the golden angle or from side to side, length, bend
//! and the pull upwards. Ours: twigs stand on the last part of each stem of the scaffold, by its nodes.

use crate::budget::Budget;
use crate::leaves::Leaves;
use crate::params::{Id, Numbers};
use crate::purpose::{ANGLE, BEND, COUNT, LENGTH, STEM, TURN};
use crate::stems::{Limb, Source};
use glam::DVec3;
use pleach_tree::turtle::Turtle;
use pleach_tree::{Address, GrowError, Growth, Key, Knot, Stem, StemKind, Tree, piece};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The golden angle, radians.
const GOLDEN: f64 = 0.381_966_011_250_105 * TAU;
/// Deviation of that turn, radians.
const TURN_V: f64 = 0.6;
/// Part of `twig_angle` that a twig at the end of a branch has.
const END_ANGLE: f64 = 0.25;
/// Radius of a twig at its foot over its length, and at most over its branch's radius there.
const SLENDER: f64 = 0.009;
const THINNER: f64 = 0.7;
/// Radius at a tip over that at the foot.
const TIP: f64 = 0.35;
/// Side twigs over their twig: length of the lowest, part of it that the highest lacks, angle.
const SIDE: (f64, f64, f64) = (0.6, 0.45, 0.9);
/// Turn, in radians, that one piece of a twig bridges.
const TURN_A_PIECE: f64 = 0.7;
const MAX_PIECES: usize = 5;

/// What all twigs of a tree have in common.
#[derive(Debug)]
pub(crate) struct Twigs<'a> {
    n: &'a Numbers,
    growth: &'a Growth<'a>,
    leaves: Option<Leaves<'a>>,
    /// Pieces of a twig's curve.
    pieces: usize,
    /// Part of `twig_angle` that a twig at the end of a branch has: it continues the branch, unless it hangs.
    end_angle: f64,
}

/// Where a twig leaves and what it is.
#[derive(Clone, Copy, Debug)]
struct Shoot {
    turtle: Turtle,
    /// Metres.
    length: f64,
    /// Metres, at its foot.
    radius: f64,
    parent: u32,
    level: u16,
    number: u32,
    /// Metres along the parent.
    offset: f64,
    address: Address,
    key: Key,
    pieces: usize,
}

impl<'a> Twigs<'a> {
    pub(crate) fn new(n: &'a Numbers, growth: &'a Growth<'a>) -> Self {
        let turn = n.twig_lift.abs() + n.twig_bend;
        let pieces = ((turn / TURN_A_PIECE).ceil() as usize).clamp(1, MAX_PIECES);
        let hangs = (-n.twig_lift / FRAC_PI_2).clamp(0.0, 1.0);
        let end_angle = END_ANGLE + (1.0 - END_ANGLE) * hangs;
        Self { n, growth, leaves: Leaves::new(n, growth.foliage), pieces, end_angle }
    }

    /// Grows the twigs of `limb`.
    pub(crate) fn grow(
        &self,
        limb: &Limb,
        source: Source,
        tree: &mut Tree,
        budget: &mut Budget,
    ) -> Result<(), GrowError> {
        let n = self.n;
        let (every, part) = (n.twigs.floor(), n.twigs.fract());
        if n.twigs == 0.0 {
            return Ok(());
        }
        let first_knot = tree.stems[limb.stem as usize].first_knot as usize;
        let last = limb.sites.len() - 1;
        let (mut number, mut offset, mut walked) = (limb.first_number, 0.0, 0);
        let start = TAU * source.key.unit(TURN, u32::MAX);
        for node in 1..=last {
            let is_outer = limb.from_tip[node] <= n.twig_zone;
            let extra = u32::from(source.key.unit(COUNT, node as u32) < part);
            let count = every as u32 + extra;
            if !is_outer || count == 0 {
                continue;
            }
            budget.work(u64::from(count), Id::twigs)?;
            for twig in 0..count {
                // From the node before up to this one; the last twig of a stem continues it.
                let (knot, within) = limb.sites[node - 1];
                let (next, to) = limb.sites[node];
                let to = if next > knot { to + f64::from(next - knot) } else { to };
                let share = f64::from(twig + 1) / f64::from(count);
                let at = within + (to - within) * share;
                let knot = knot as usize + at as usize;
                let t = at - at.floor();
                // At the end of the last piece rather than the start of the one after it.
                let (knot, t) = if first_knot + knot + 1 < first_knot + self.knots(limb, tree) {
                    (knot, t)
                } else {
                    (knot - 1, 1.0)
                };
                let (from, to) = (tree.knots[first_knot + knot], tree.knots[first_knot + knot + 1]);
                let curve = piece(&from, &to);
                while walked < knot {
                    offset += piece(&tree.knots[first_knot + walked], &tree.knots[first_knot + walked + 1])
                        .length(3);
                    walked += 1;
                }
                let address = source.address.child(number);
                let draw = self.growth.draw(address, usize::from(limb.level) + 1);
                let own = draw.key(source.key.child(STEM, number));
                let along = curve.tangent(t, DVec3::Z);
                let right = along.cross(DVec3::Z).try_normalize().unwrap_or(DVec3::X);
                let mut turtle = Turtle { position: curve.at(t), direction: along, right };
                let turn = start + GOLDEN * f64::from(number) + TURN_V * own.signed(TURN, 0) + draw.azimuth;
                turtle.roll_right(turn);
                let is_end = node == last && twig + 1 == count;
                let angle = n.twig_angle * if is_end { self.end_angle } else { 1.0 };
                turtle.pitch_down(angle + n.twig_angle_v * own.signed(ANGLE, 0) + draw.pitch);
                let drawn = 1.0 + n.twig_length_v * own.signed(LENGTH, 0);
                let length = n.twig_length * n.height * drawn * draw.length;
                let thick = from.radius + (to.radius - from.radius) * t;
                self.shoot(
                    &Shoot {
                        turtle,
                        length,
                        radius: (SLENDER * length).min(THINNER * thick),
                        parent: limb.stem,
                        level: limb.level + 1,
                        number,
                        offset: offset + curve.length(3) * t,
                        address,
                        key: own,
                        pieces: self.pieces,
                    },
                    tree,
                    budget,
                )?;
                number += 1;
            }
        }
        Ok(())
    }

    fn knots(&self, limb: &Limb, tree: &Tree) -> usize {
        tree.stems[limb.stem as usize].knot_count as usize
    }

    /// Grows a twig with its side twigs and leaves.
    fn shoot(&self, shoot: &Shoot, tree: &mut Tree, budget: &mut Budget) -> Result<(), GrowError> {
        let sides = self.n.side_twigs;
        let stem = self.stem(shoot, tree, budget)?;
        let first = tree.stems[stem as usize].first_knot as usize;
        budget.work(u64::from(sides), Id::side_twigs)?;
        for number in 0..sides {
            let far = (f64::from(number) + 1.0) / (f64::from(sides) + 1.0);
            let at = far * shoot.pieces as f64;
            let knot = (at as usize).min(shoot.pieces - 1);
            let curve = piece(&tree.knots[first + knot], &tree.knots[first + knot + 1]);
            let t = at - knot as f64;
            let address = shoot.address.child(number);
            let draw = self.growth.draw(address, usize::from(shoot.level) + 1);
            let own = draw.key(shoot.key.child(STEM, number));
            let along = curve.tangent(t, shoot.turtle.direction);
            // From side to side, in the plane that is most level.
            let level = along.cross(DVec3::Z).try_normalize().unwrap_or(shoot.turtle.right);
            let down = along.cross(level);
            let mut turtle = Turtle { position: curve.at(t), direction: along, right: down };
            let side = if number % 2 == 0 { 0.0 } else { PI };
            turtle.roll_right(side + TURN_V * own.signed(TURN, 0) + draw.azimuth);
            let angle = SIDE.2 * self.n.twig_angle + 0.6 * self.n.twig_angle_v * own.signed(ANGLE, 0);
            turtle.pitch_down(angle + draw.pitch);
            let length = shoot.length * (SIDE.0 - SIDE.1 * far) * draw.length;
            let length = length * (1.0 + 0.5 * self.n.twig_length_v * own.signed(LENGTH, 0));
            self.stem(
                &Shoot {
                    turtle,
                    length,
                    radius: (SLENDER * length).min(0.6 * shoot.radius),
                    parent: stem,
                    level: shoot.level + 1,
                    number,
                    offset: shoot.length * far,
                    address,
                    key: own,
                    pieces: self.pieces.div_ceil(2),
                },
                tree,
                budget,
            )?;
        }
        Ok(())
    }

    /// Adds the stem of `shoot` to `tree`, and its leaves. Returns its index.
    fn stem(&self, shoot: &Shoot, tree: &mut Tree, budget: &mut Budget) -> Result<u32, GrowError> {
        let n = self.n;
        budget.stem(tree, shoot.pieces + 1, Id::twigs)?;
        let index = tree.stems.len() as u32;
        let first_knot = tree.knots.len() as u32;
        let part = 1.0 / shoot.pieces as f64;
        let (length, mut turtle) = (shoot.length * part, shoot.turtle);
        let bend = n.twig_bend * shoot.key.signed(BEND, 0) * part;
        for knot in 0..=shoot.pieces {
            let third = turtle.direction * (length / 3.0);
            let point = turtle.position;
            let radius = shoot.radius * (1.0 - (1.0 - TIP) * part * knot as f64);
            tree.knots.push(Knot { point, handle_in: point - third, handle_out: point + third, radius });
            // Half of a turn before the walk and half after it, so that handles are tangents.
            turtle.turn_right(bend / 2.0);
            turtle.lean(DVec3::Z, n.twig_lift * part / 2.0);
            turtle.walk(length);
            turtle.turn_right(bend / 2.0);
            turtle.lean(DVec3::Z, n.twig_lift * part / 2.0);
        }
        tree.stems.push(Stem {
            parent: Some(shoot.parent),
            level: shoot.level,
            kind: StemKind::Branch,
            number: shoot.number,
            offset: shoot.offset,
            first_knot,
            knot_count: shoot.pieces as u32 + 1,
        });
        if let Some(leaves) = &self.leaves {
            leaves.put(index, shoot.length, shoot.key, tree, budget)?;
        }
        Ok(index)
    }
}
