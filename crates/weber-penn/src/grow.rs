//! Growing a whole tree: trunks first, then everything that they carry.
//!
//! The stems of level 0 are walked in order. Each first-level branch is then independent of the
//! others, so they can be grown on many threads and put together in order.

use crate::blame;
use crate::budget::{Budget, Cause, Exceeded, POINT_STEPS, SOLIDS_A_STEP, TRIAL_STEPS};
use crate::census;
use crate::certain;
use crate::children;
use crate::context::{Buffers, GrowContext, Scratch};
use crate::course::Course;
use crate::leaves;
use crate::model::Model;
use crate::parts::{self, Waiting};
use crate::path::{Forks, PathPoint, lay_out, stretch, walk};
use crate::prune;
use crate::purpose;
use crate::solid::Surroundings;
use crate::stem::{ForkStart, StemSpec};
use crate::trunks;
use glam::{DVec2, DVec3};
use pleach_tree::piece;
use pleach_tree::turtle::Turtle;
use pleach_tree::{Address, Draw, Foliage, GrowError, Growth, Helpers, Key, Knot, Stem, StemKind, Tree};
use std::f64::consts::TAU;
use std::sync::Arc;

/// First-level branches below which threads are not worth their start.
const PARALLEL_BRANCHES: usize = 16;
/// The same of threads that help, which have been started.
const SHARED_BRANCHES: usize = 4;
/// Steps that have to be expected for helpers to be worth their start: half a millisecond.
const SHARED_STEPS: u64 = 10_000;

/// Memory reused from tree to tree.
#[derive(Debug, Default)]
pub(crate) struct Memory {
    stacks: Scratch,
    sites: Vec<DVec2>,
    /// Steps that the last tree took: trees of a search are much alike.
    last_work: u64,
}

pub(crate) fn grow(
    model: &Model,
    surroundings: &Surroundings,
    growth: &Growth<'_>,
    memory: &mut Memory,
    tree: &mut Tree,
) -> Result<(), GrowError> {
    tree.clear();
    if let Some(error) = certain::refusal(model, growth) {
        return Err(error);
    }
    tree.leaf_shapes.push(Arc::clone(model.leaf_shape.outline()));
    tree.blossom_shapes.push(model.blossom_shape);
    let course = Course::new(model);
    let context = GrowContext { model, surroundings, course, growth, prunes_trunks: true };
    let root = Key::root(growth.seed);

    let mut buffers = memory.stacks.buffers(tree, Budget::new(growth.limits, context.prunes()));
    let grown = context.tree(&mut buffers, root, &mut memory.sites, memory.last_work);
    memory.last_work = buffers.budget.spent_work();
    if let Err(exceeded) = grown {
        return Err(blame::error(exceeded, model, &buffers.budget, buffers.tree, buffers.children));
    }
    if buffers.tree.stems.is_empty() {
        return Err(blame::nothing_left(model).into());
    }
    if let Some(course) = course {
        course.bend(buffers.tree);
    }
    let finite = buffers.tree.knots.iter().all(|k| k.point.is_finite() && k.radius.is_finite());
    if finite { Ok(()) } else { Err(GrowError::NotFinite { what: "the position of a stem" }) }
}

impl GrowContext<'_> {
    /// Grows the trunks, then what they carry, which is expected to take `work` steps.
    fn tree(
        &self,
        buffers: &mut Buffers<'_>,
        root: Key,
        sites: &mut Vec<DVec2>,
        work: u64,
    ) -> Result<(), Exceeded> {
        self.trunks(buffers, root, sites)?;
        if self.growth.parallel && buffers.children.len() >= PARALLEL_BRANCHES {
            let Buffers { tree, children, budget, .. } = buffers;
            if parts::in_parallel(children, budget, tree, &|buffers, branch| self.branch(buffers, branch))
                .is_ok()
            {
                return Ok(());
            }
        }
        self.branches(buffers, work)
    }

    /// Grows the trunks; their branches wait.
    ///
    /// A trunk may lean so far, by the draws of some seeds, that no length fits into the envelope. It is then pruned
    /// away if others are left, and stays as it is if nothing would be left: the envelope gives a crown its form and
    /// does not decide which seeds have a tree. Solids do, since where they stand is where the tree may not.
    fn trunks(&self, buffers: &mut Buffers<'_>, root: Key, sites: &mut Vec<DVec2>) -> Result<(), Exceeded> {
        trunks::sites(self.model, root, sites, &mut buffers.budget)?;
        self.trunks_at(buffers, root, sites)?;
        let is_pruned = self.model.prune_ratio > 0.0 && self.surroundings.are_the_envelope();
        if is_pruned && buffers.tree.stems.is_empty() {
            Self { prunes_trunks: false, ..*self }.trunks_at(buffers, root, sites)?;
        }
        Ok(())
    }

    fn trunks_at(&self, buffers: &mut Buffers<'_>, root: Key, sites: &[DVec2]) -> Result<(), Exceeded> {
        for (i, site) in sites.iter().enumerate() {
            let trunk = self.trunk(root, i as u32, *site, sites.len() == 1);
            // The first trunk carries no error of `seg_splits`; others start in mid-pattern.
            let mut carry = if i == 0 { 0.0 } else { trunk.key.unit(purpose::SPLIT_PHASE, 0) };
            self.stem(buffers, trunk, &mut carry)?;
        }
        Ok(())
    }

    /// Grows the first-level branches, which wait, and what they carry: `work` steps, by the last tree.
    fn branches(&self, buffers: &mut Buffers<'_>, work: u64) -> Result<(), Exceeded> {
        let (all, before) = (buffers.children.len(), buffers.budget.spent_work());
        buffers.children.reverse();
        let mut counts_ahead = self.growth.counts_ahead && !self.prunes();
        let mut helpers = self.growth.helpers;
        self.shared(buffers, (0, all), work, counts_ahead, &mut helpers)?;
        while let Some(branch) = buffers.children.pop() {
            self.branch(buffers, branch)?;
            let left = buffers.children.len();
            if counts_ahead && buffers.budget.looks_short(all - left, all) {
                counts_ahead = false;
                census::count(self, buffers)?;
            }
            let work = (buffers.budget.spent_work() - before) * left as u64 / (all - left) as u64;
            self.shared(buffers, (0, all), work, counts_ahead, &mut helpers)?;
        }
        Ok(())
    }

    /// Grows the stems that wait, down to number `first`. Stems of level `level` are those that carry them.
    fn waiting(&self, buffers: &mut Buffers<'_>, first: usize, level: usize) -> Result<(), Exceeded> {
        let (all, before) = (buffers.children.len() - first, buffers.budget.spent_work());
        buffers.children[first..].reverse();
        // A first-level branch may have most of a tree, what it carries hardly.
        let mut helpers = self.growth.helpers.filter(|_| level == 1);
        while buffers.children.len() > first
            && let Some(child) = buffers.children.pop()
        {
            self.branch(buffers, child)?;
            if helpers.is_some() {
                let left = buffers.children.len() - first;
                let work = (buffers.budget.spent_work() - before) * left as u64 / (all - left) as u64;
                self.shared(buffers, (first, all), work, false, &mut helpers)?;
            }
        }
        Ok(())
    }

    /// Grows the stems that wait, from number `first` on, with `helpers` if these are idle and there is enough `work`
    /// to expect. There were `all` at first. With `counts_ahead` they may be counted, too.
    fn shared(
        &self,
        buffers: &mut Buffers<'_>,
        (first, all): (usize, usize),
        work: u64,
        counts_ahead: bool,
        helpers: &mut Option<&dyn Helpers>,
    ) -> Result<(), Exceeded> {
        let left = buffers.children.len() - first;
        let is_large = left >= SHARED_BRANCHES && work >= SHARED_STEPS;
        let Some(some) = helpers.filter(|helpers| is_large && helpers.are_idle()) else { return Ok(()) };
        // Whatever comes of it, one thread does the rest.
        *helpers = None;
        let Buffers { tree, children, budget, .. } = buffers;
        children[first..].reverse();
        let grow = |buffers: &mut Buffers<'_>, branch| self.branch(buffers, branch);
        let count = |buffers: &mut Buffers<'_>| census::count(self, buffers).map(|_| ());
        let count = counts_ahead.then_some(parts::Count { done: all - left, all, count: &count });
        if parts::shared(&Waiting { all: children, first }, budget, tree, some, &grow, count)? {
            children.truncate(first);
        } else {
            children[first..].reverse();
        }
        Ok(())
    }

    /// Trunk `number` at `site`; several turn their downward side away from the middle.
    fn trunk(&self, root: Key, number: u32, site: DVec2, alone: bool) -> StemSpec {
        let model = self.model;
        let address = Address::trunk(number);
        let draw = self.growth.draw(address, 0);
        let key = draw.key(root.child(purpose::TRUNK, number));
        let level = &model.levels[0];
        let least = model.g_scale * 1e-3;
        let scale = (model.g_scale + key.signed(purpose::SCALE, 0) * model.g_scale_v).max(least);
        let length = scale * (level.length + key.signed(purpose::LENGTH, 0) * level.length_v).max(0.0);
        let length = length * draw.length;
        let mut turtle = Turtle { position: site.extend(0.0), ..Turtle::UP };
        if alone {
            turtle.roll_right(TAU * key.unit(purpose::ROLL, 0));
        } else {
            // `down` = direction × right; with direction up it is a quarter turn ahead of right.
            let outwards = site.try_normalize().unwrap_or(DVec2::Y);
            turtle.right = DVec3::new(outwards.y, -outwards.x, 0.0);
        }
        if draw != Draw::OWN {
            turtle.roll_right(draw.azimuth);
            turtle.pitch_down(draw.pitch);
        }
        StemSpec {
            key,
            fork_key: key,
            address,
            number,
            level: 0,
            turtle,
            parent: None,
            offset: 0.0,
            length,
            radius: length * model.ratio * level.radius_mod,
            radius_limit: f64::INFINITY,
            parent_length: length,
            parent_radius: 0.0,
            parent_child_length: 1.0,
            scale,
            forked: None,
        }
    }

    /// A child stem and everything on it.
    fn branch(&self, buffers: &mut Buffers<'_>, branch: StemSpec) -> Result<(), Exceeded> {
        let mut carry = branch.first_carry(self.model);
        self.stem(buffers, branch, &mut carry)
    }

    /// Grows one stem, what it carries, and its forks.
    fn stem(&self, buffers: &mut Buffers<'_>, mut stem: StemSpec, carry: &mut f64) -> Result<(), Exceeded> {
        let model = self.model;
        let level = &model.levels[stem.level];
        let child_length = stem.child_length(model);
        let first_point = buffers.path.len();
        let first_fork = buffers.forked_stems.len();
        let first_child = buffers.children.len();
        let hull = self.growth.hull().filter(|_| stem.level > 0);
        // The hull says how long it is.
        if hull.is_some() && stem.level == 1 && stem.forked.is_none() {
            stem.length *= prune::STRETCH;
        }
        let is_pruned = model.prune_ratio > 0.0
            && stem.forked.is_none_or(|_| level.split_angle_v < 0.0)
            && (stem.level > 0 || self.prunes_trunks);
        let is_pruned = is_pruned || hull.is_some();
        if is_pruned {
            let carry_before = *carry;
            self.walk(buffers, &stem, child_length, carry);
            let length = self.prune(buffers, &stem, first_point)?;
            stem.length = length.unwrap_or(0.0);
            if !stem.is_made() {
                buffers.path.truncate(first_point);
                buffers.forked_stems.truncate(first_fork);
                *carry = carry_before;
                return Ok(());
            }
            if stem.level == 0 {
                stem.radius = stem.length * model.ratio * level.radius_mod;
            } else if stem.forked.is_none() {
                stem.radius = stem.branch_radius(model);
            }
        }
        if !stem.is_made() {
            return Ok(());
        }
        buffers.budget.work(Cause::Walk, stem.level, POINT_STEPS * u64::from(stem.points(model)))?;
        if is_pruned {
            self.lay_out(buffers, &stem, first_point, first_fork);
        } else {
            self.walk(buffers, &stem, child_length, carry);
        }
        let index = buffers.tree.stems.len() as u32;
        self.emit(buffers, &stem, first_point)?;
        if stem.level + 1 < model.level_count {
            children::collect(self, buffers, &stem, index, child_length, first_point)?;
        } else if stem.level > 0 && self.growth.foliage != Foliage::None {
            leaves::grow(self, buffers, &stem, index, first_point)?;
        }
        buffers.path.truncate(first_point);

        // The children of trunks wait: they are the branches that may grow in parallel.
        if stem.level > 0 {
            self.waiting(buffers, first_child, stem.level)?;
        }

        let last_fork = buffers.forked_stems.len();
        for i in first_fork..last_fork {
            let mut fork = buffers.forked_stems[i];
            fork.parent = Some(index);
            fork.adopt(model, &stem);
            self.stem(buffers, fork, carry)?;
        }
        buffers.forked_stems.truncate(first_fork);
        Ok(())
    }

    /// Walks the path of `stem` and collects its forks.
    fn walk(&self, buffers: &mut Buffers<'_>, stem: &StemSpec, child_length: f64, carry: &mut f64) {
        let mut forks = Collect { growth: self.growth, origin: *stem, forked_stems: buffers.forked_stems };
        walk(self.model, stem, stem.length, child_length, carry, buffers.path, &mut forks);
    }

    /// The length that pruning leaves of `stem`, whose path has been walked, or `None` if it is dropped. Leaves the
    /// path as it was tried last.
    ///
    /// The trunk is judged by its tip alone, as the add-on does: it would not fit at its foot.
    fn prune(
        &self,
        buffers: &mut Buffers<'_>,
        stem: &StemSpec,
        first: usize,
    ) -> Result<Option<f64>, Exceeded> {
        let Self { model, surroundings, course, .. } = *self;
        // The trunk stands as ever: a hull is that of a crown.
        if let Some(hull) = self.growth.hull().filter(|_| stem.level > 0) {
            let steps = TRIAL_STEPS * u64::from(stem.points(model));
            return prune::pruned_length(1.0, stem.length, |length| {
                buffers.budget.work(Cause::Pruning, stem.level, steps)?;
                stretch(model, stem, length, buffers.path, first);
                let points = &buffers.path[first + 1..];
                let outer = (points.len() as f64 * prune::OUTER).ceil() as usize;
                let outer = &points[points.len() - outer..];
                let is_in =
                    |p: &PathPoint| prune::is_in(hull, surroundings, (course, model.g_scale), p.point);
                Ok(outer.iter().rev().all(is_in))
            });
        }
        let solids = surroundings.inside.as_ref().map_or(0, Vec::len) + surroundings.obstacles.len();
        let points = u64::from(stem.points(model));
        let judged = if stem.level == 0 { 1 } else { points };
        let steps = TRIAL_STEPS * points + judged * (solids as u64 / SOLIDS_A_STEP);
        prune::pruned_length(model.prune_ratio, stem.length, |length| {
            buffers.budget.work(Cause::Pruning, stem.level, steps)?;
            stretch(model, stem, length, buffers.path, first);
            let points = &buffers.path[first + 1..];
            let judged = if stem.level == 0 { &points[points.len() - 1..] } else { points };
            // From the tip, which is the most likely to stick out.
            Ok(judged.iter().rev().all(|p| prune::fits(model, surroundings, (course, stem.scale), p.point)))
        })
    }

    /// Moves the path of `stem` to where it is at its new length, and its forks with it.
    fn lay_out(&self, buffers: &mut Buffers<'_>, stem: &StemSpec, first_point: usize, first_fork: usize) {
        lay_out(self.model, stem, stem.length, buffers.path, first_point);
        for fork in &mut buffers.forked_stems[first_fork..] {
            let point = first_point + (fork.start() - stem.start()) as usize;
            fork.turtle.position = buffers.path[point].point;
        }
    }

    /// Writes the path of `stem` to the tree as a stem with knots.
    fn emit(&self, buffers: &mut Buffers<'_>, stem: &StemSpec, first_point: usize) -> Result<(), Exceeded> {
        let model = self.model;
        let level = &model.levels[stem.level];
        let profile = stem.profile(model);
        let path = &buffers.path[first_point..];
        let (per_piece, made) = (stem.knots_a_piece(model), stem.knots(model));
        buffers.budget.work(Cause::Walk, stem.level, made as u64)?;
        buffers.budget.stem(made)?;
        let knots = &mut buffers.tree.knots;
        let first_knot = knots.len() as u32;
        let site = |i: f64| (f64::from(stem.start()) + i) / f64::from(level.curve_res);
        if stem.is_fine(model) {
            resample(path, per_piece, knots, |i| profile.at(site(i)));
        } else {
            knots.extend(path.iter().enumerate().map(|(i, p)| Knot {
                point: p.point,
                handle_in: p.handle_in,
                handle_out: p.handle_out,
                radius: profile.at(site(i as f64)),
            }));
        }
        let knot_count = knots.len() as u32 - first_knot;
        debug_assert_eq!(knot_count as usize, made, "knots are counted before they are made");
        let kind = match (stem.level, stem.forked) {
            (_, Some(_)) => StemKind::Fork,
            (0, None) => StemKind::Trunk,
            _ => StemKind::Branch,
        };
        buffers.tree.stems.push(Stem {
            parent: stem.parent,
            level: stem.level as u16,
            kind,
            number: stem.number,
            offset: stem.offset,
            first_knot,
            knot_count,
        });
        Ok(())
    }
}

/// Collects the forks of a stem.
struct Collect<'a> {
    growth: &'a Growth<'a>,
    origin: StemSpec,
    forked_stems: &'a mut Vec<StemSpec>,
}

impl Forks for Collect<'_> {
    fn fork_at(&mut self, mut turtle: Turtle, state: ForkStart, index: u32) {
        let (fork, draw) = self.origin.fork_at(self.growth, state, index);
        if draw != Draw::OWN {
            turtle.rotate_about(DVec3::Z, draw.azimuth);
            turtle.pitch_down(draw.pitch);
        }
        self.forked_stems.push(StemSpec { turtle, ..fork });
    }
}

/// Cuts each piece of `path` at `per_piece` parameters, ends included, without changing its course.
fn resample(path: &[PathPoint], per_piece: u32, knots: &mut Vec<Knot>, radius: impl Fn(f64) -> f64) {
    let steps = per_piece - 1;
    for (i, w) in path.windows(2).enumerate() {
        let knot = |p: &PathPoint| Knot {
            point: p.point,
            handle_in: p.handle_in,
            handle_out: p.handle_out,
            radius: 0.0,
        };
        let cubic = piece(&knot(&w[0]), &knot(&w[1]));
        for k in u32::from(i > 0)..=steps {
            let t = f64::from(k) / f64::from(steps);
            let point = cubic.at(t);
            let reach = cubic.derivative(t) / (3.0 * f64::from(steps));
            knots.push(Knot {
                point,
                handle_in: point - reach,
                handle_out: point + reach,
                radius: radius(i as f64 + t),
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::space;
    use crate::params::table::Id;
    use pleach_tree::Limits;
    use pleach_tree::param::table::Parameters;

    /// What growing the branches costs, and what the census says that it will.
    fn costs(values: &[f64], seed: u64) -> (Budget<'static>, Budget<'static>) {
        let model = Model::read(values);
        let growth = Growth::seed(seed);
        let surroundings = Surroundings::default();
        let course = Course::new(&model);
        let context = GrowContext {
            model: &model,
            surroundings: &surroundings,
            course,
            growth: &growth,
            prunes_trunks: true,
        };
        let (mut tree, mut scratch) = (Tree::default(), Scratch::default());
        let mut buffers = scratch.buffers(&mut tree, Budget::new(Limits::DEFAULT, false));
        context.trunks(&mut buffers, Key::root(seed), &mut Vec::new()).unwrap();
        buffers.children.reverse();
        let counted = census::count(&context, &mut buffers).unwrap();
        assert!(buffers.forked_stems.is_empty(), "the census leaves nothing behind");
        buffers.children.reverse();
        context.branches(&mut buffers, 0).unwrap();
        (buffers.budget.trial(), counted.trial())
    }

    #[test]
    fn the_census_counts_what_grows() {
        for name in crate::HEWITT_2017 {
            let mut values = crate::preset(name).unwrap().params.values().to_vec();
            values[Id::prune_ratio.slot(0).index()] = 0.0;
            for (seed, splits, whorls) in [(1, None, 0.0), (2, Some(0.4), 0.0), (3, Some(1.3), 2.5)] {
                for level in 1..3 {
                    if let Some(splits) = splits {
                        values[Id::seg_splits.slot(level).index()] = splits;
                    }
                    if whorls > 0.0 {
                        values[Id::branch_dist.slot(level).index()] = whorls;
                    }
                }
                space().check(values.clone()).unwrap();
                let (grown, counted) = costs(&values, seed);
                assert_eq!(format!("{grown:?}"), format!("{counted:?}"), "{name}, seed {seed}");
            }
        }
    }
}
