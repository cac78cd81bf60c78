//! Growing a whole tree: trunks first, then everything that they carry.
//!
//! The stems of level 0 are walked in order. Each first-level branch is then independent of the
//! others, so they can be grown on many threads and put together in order.

use crate::blame;
use crate::budget::{Budget, Cause, Exceeded, POINT_STEPS, SOLIDS_A_STEP, TRIAL_STEPS};
use crate::certain;
use crate::children;
use crate::leaves;
use crate::model::Model;
use crate::path::{Forks, PathPoint, walk};
use crate::prune;
use crate::purpose;
use crate::radius::Profile;
use crate::solid::Surroundings;
use crate::stem::{CloneState, Seedling};
use crate::trunks;
use glam::{DVec2, DVec3};
use pleach_tree::plant::piece;
use pleach_tree::turtle::Turtle;
use pleach_tree::{Foliage, GrowError, Growth, Key, Knot, Stem, StemKind, Tree};
use rayon::prelude::*;
use std::f64::consts::TAU;
use std::sync::Arc;

/// First-level branches below which threads are not worth their start.
const PARALLEL_BRANCHES: usize = 16;
/// Parts into which first-level branches are cut for the threads.
const PARTS: usize = 32;

/// Memory reused from tree to tree.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    pub(crate) path: Vec<PathPoint>,
    clones: Vec<Seedling>,
    children: Vec<Seedling>,
    places: Vec<DVec2>,
}

/// One growth of one tree: what does not change while it grows.
#[derive(Clone, Copy)]
pub(crate) struct Job<'a> {
    pub(crate) model: &'a Model,
    surroundings: &'a Surroundings,
    pub(crate) growth: &'a Growth,
}

/// The tree being grown and the stacks that growing it needs.
pub(crate) struct Bench<'a> {
    pub(crate) tree: &'a mut Tree,
    pub(crate) path: &'a mut Vec<PathPoint>,
    clones: &'a mut Vec<Seedling>,
    /// Stems that wait to be grown. Within a stem's own, the next to grow is the last.
    pub(crate) children: &'a mut Vec<Seedling>,
    pub(crate) budget: Budget<'a>,
}

pub(crate) fn grow(
    model: &Model,
    surroundings: &Surroundings,
    growth: &Growth,
    scratch: &mut Scratch,
    tree: &mut Tree,
) -> Result<(), GrowError> {
    tree.clear();
    if let Some(error) = certain::refusal(model, growth) {
        return Err(error);
    }
    tree.leaf_shapes.push(Arc::clone(model.leaf_shape.outline()));
    tree.blossom_shapes.push(model.blossom_shape);
    let Scratch { path, clones, children, places } = scratch;
    path.clear();
    clones.clear();
    children.clear();
    let job = Job { model, surroundings, growth };
    let root = Key::root(growth.seed);

    let budget = Budget::new(growth.limits, model.prune_ratio > 0.0);
    let mut bench = Bench { tree, path, clones, children, budget };
    if let Err(exceeded) = job.tree(&mut bench, root, places) {
        return Err(blame::error(exceeded, model, &bench.budget, bench.tree, bench.children));
    }
    if bench.tree.stems.is_empty() {
        return Err(blame::nothing_left(model).into());
    }
    let finite = bench.tree.knots.iter().all(|k| k.point.is_finite() && k.radius.is_finite());
    if finite { Ok(()) } else { Err(GrowError::NotFinite { what: "the position of a stem" }) }
}

impl Job<'_> {
    /// Grows the trunks, then what they carry.
    fn tree(&self, bench: &mut Bench<'_>, root: Key, places: &mut Vec<DVec2>) -> Result<(), Exceeded> {
        trunks::places(self.model, root, places, &mut bench.budget)?;
        for (i, place) in places.iter().enumerate() {
            let trunk = self.trunk(root.child(purpose::TRUNK, i as u32), *place, places.len() == 1);
            // The first trunk carries no error of `seg_splits`; others start in mid-pattern.
            let mut carry = if i == 0 { 0.0 } else { trunk.key.unit(purpose::SPLIT_PHASE, 0) };
            self.stem(bench, trunk, &mut carry)?;
        }
        let parallel = self.growth.parallel && bench.children.len() >= PARALLEL_BRANCHES;
        if parallel && self.branches_in_parallel(bench.children, &bench.budget, bench.tree).is_ok() {
            return Ok(());
        }
        self.waiting(bench, 0)
    }

    /// Grows the stems that wait, down to number `first`.
    fn waiting(&self, bench: &mut Bench<'_>, first: usize) -> Result<(), Exceeded> {
        bench.children[first..].reverse();
        while bench.children.len() > first
            && let Some(child) = bench.children.pop()
        {
            self.branch(bench, child)?;
        }
        Ok(())
    }

    /// The trunk at `place`; several turn their downward side away from the middle.
    fn trunk(&self, key: Key, place: DVec2, alone: bool) -> Seedling {
        let model = self.model;
        let level = &model.levels[0];
        let least = model.g_scale * 1e-3;
        let scale = (model.g_scale + key.signed(purpose::SCALE, 0) * model.g_scale_v).max(least);
        let length = scale * (level.length + key.signed(purpose::LENGTH, 0) * level.length_v).max(0.0);
        let mut turtle = Turtle { position: place.extend(0.0), ..Turtle::UP };
        if alone {
            turtle.roll_right(TAU * key.unit(purpose::ROLL, 0));
        } else {
            // `down` = direction × right; with direction up it is a quarter turn ahead of right.
            let outwards = place.try_normalize().unwrap_or(DVec2::Y);
            turtle.right = DVec3::new(outwards.y, -outwards.x, 0.0);
        }
        Seedling {
            key,
            depth: 0,
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
            clone: None,
        }
    }

    /// A child stem and everything on it.
    fn branch(&self, bench: &mut Bench<'_>, branch: Seedling) -> Result<(), Exceeded> {
        let seg_splits = self.model.levels[branch.depth].seg_splits;
        let mut carry = if seg_splits > 0.0 { branch.key.unit(purpose::SPLIT_PHASE, 0) } else { 0.0 };
        self.stem(bench, branch, &mut carry)
    }

    /// Grows `branches` on many threads and adds them to `tree`, or leaves it alone and fails.
    fn branches_in_parallel(
        &self,
        branches: &[Seedling],
        budget: &Budget<'_>,
        tree: &mut Tree,
    ) -> Result<(), Exceeded> {
        let pool = budget.pool();
        let part = branches.len().div_ceil(PARTS);
        let grow = |chunk: &[Seedling]| {
            let (mut tree, mut scratch) = (Tree::default(), Scratch::default());
            let Scratch { path, clones, children, .. } = &mut scratch;
            let mut bench = Bench { tree: &mut tree, path, clones, children, budget: budget.part(&pool) };
            let grown = chunk.iter().try_for_each(|branch| self.branch(&mut bench, *branch));
            let grown = grown.and_then(|()| bench.budget.tell());
            if grown.is_err() {
                bench.budget.stop_all();
            }
            // Room for more would be as much again, all parts together.
            grown.map(|()| tree.shrink_to_fit()).map(|()| tree)
        };
        let parts = branches.par_chunks(part).map(grow).collect::<Result<Vec<Tree>, Exceeded>>()?;
        tree.reserve_for(&parts);
        for part in parts {
            tree.append(&part, |stem| stem.level == 1 && stem.kind == StemKind::Branch);
        }
        Ok(())
    }

    /// Grows one stem, what it carries, and its clones.
    fn stem(&self, bench: &mut Bench<'_>, mut stem: Seedling, carry: &mut f64) -> Result<(), Exceeded> {
        let model = self.model;
        let level = &model.levels[stem.depth];
        let next = model.child_level(stem.depth);
        let child_length = stem.clone.map_or_else(
            || (next.length + stem.key.signed(purpose::CHILD_LENGTH, 0) * next.length_v).max(0.0),
            |clone| clone.child_length,
        );
        if model.prune_ratio > 0.0 && stem.clone.is_none_or(|_| level.split_angle_v < 0.0) {
            let Some(length) = self.prune(bench, &stem, *carry)? else { return Ok(()) };
            stem.length = length;
            if stem.depth == 0 {
                stem.radius = length * model.ratio * level.radius_mod;
            } else if stem.clone.is_none() {
                stem.radius = stem.branch_radius(model);
            }
        }
        if !stem.length.is_finite() || stem.length < MIN_LENGTH {
            return Ok(());
        }

        let first_point = bench.path.len();
        let first_clone = bench.clones.len();
        let first_child = bench.children.len();
        let mut forks = Collect { origin: stem, clones: bench.clones };
        bench.budget.work(Cause::Walk, stem.depth, POINT_STEPS * self.points(&stem))?;
        walk(model, &stem, stem.length, child_length, carry, bench.path, &mut forks);
        let index = bench.tree.stems.len() as u32;
        self.emit(bench, &stem, first_point)?;
        if stem.depth + 1 < model.level_count {
            children::collect(self, bench, &stem, index, child_length, first_point)?;
        } else if stem.depth > 0 && self.growth.foliage != Foliage::None {
            leaves::grow(self, bench, &stem, index, first_point)?;
        }
        bench.path.truncate(first_point);

        // The children of trunks wait: they are the branches that may grow in parallel.
        if stem.depth > 0 {
            self.waiting(bench, first_child)?;
        }

        let last_clone = bench.clones.len();
        for i in first_clone..last_clone {
            let mut clone = bench.clones[i];
            clone.parent = Some(index);
            // Where the fork is on the stem that it leaves, in metres from that stem's own first point.
            clone.offset = stem.length * f64::from(clone.start() - stem.start()) / f64::from(level.curve_res);
            clone.length = stem.length;
            clone.radius = stem.radius;
            self.stem(bench, clone, carry)?;
        }
        bench.clones.truncate(first_clone);
        Ok(())
    }

    /// The length that pruning leaves of `stem`, or `None` if it is dropped.
    ///
    /// The trunk is judged by its tip alone, as the add-on does: it would not fit at its foot.
    fn prune(&self, bench: &mut Bench<'_>, stem: &Seedling, carry: f64) -> Result<Option<f64>, Exceeded> {
        let Self { model, surroundings, .. } = *self;
        let first = bench.path.len();
        let solids = surroundings.inside.as_ref().map_or(0, Vec::len) + surroundings.obstacles.len();
        let points = self.points(stem);
        let judged = if stem.depth == 0 { 1 } else { points };
        let steps = TRIAL_STEPS * points + judged * (solids as u64 / SOLIDS_A_STEP);
        prune::pruned_length(model.prune_ratio, stem.length, |length| {
            bench.budget.work(Cause::Pruning, stem.depth, steps)?;
            walk(model, stem, length, 1.0, &mut carry.clone(), bench.path, &mut crate::path::NoForks);
            let points = &bench.path[first + 1..];
            let judged = if stem.depth == 0 { &points[points.len() - 1..] } else { points };
            let fits = judged.iter().all(|p| prune::fits(model, surroundings, stem.scale, p.point));
            bench.path.truncate(first);
            Ok(fits)
        })
    }

    /// Points of the path of `stem`.
    fn points(&self, stem: &Seedling) -> u64 {
        u64::from(self.model.levels[stem.depth].curve_res - stem.start() + 1)
    }

    /// Writes the path of `stem` to the tree as a stem with knots.
    fn emit(&self, bench: &mut Bench<'_>, stem: &Seedling, first_point: usize) -> Result<(), Exceeded> {
        let model = self.model;
        let level = &model.levels[stem.depth];
        let profile = self.profile(stem);
        let path = &bench.path[first_point..];
        // Flare and beads change the radius faster than the path bends: more knots on the same path.
        let fine = stem.depth == 0 || level.taper > 1.0;
        let per_piece = if fine { 100_u32.div_ceil(level.curve_res).max(2) } else { 2 };
        let made = (path.len() - 1) * (per_piece as usize - 1) + 1;
        bench.budget.work(Cause::Walk, stem.depth, made as u64)?;
        bench.budget.stem(made)?;
        let knots = &mut bench.tree.knots;
        let first_knot = knots.len() as u32;
        let place = |i: f64| (f64::from(stem.start()) + i) / f64::from(level.curve_res);
        if fine {
            resample(path, per_piece, knots, |i| profile.at(place(i)));
        } else {
            knots.extend(path.iter().enumerate().map(|(i, p)| Knot {
                point: p.point,
                handle_in: p.handle_in,
                handle_out: p.handle_out,
                radius: profile.at(place(i as f64)),
            }));
        }
        let knot_count = knots.len() as u32 - first_knot;
        debug_assert_eq!(knot_count as usize, made, "knots are counted before they are made");
        let kind = match (stem.depth, stem.clone) {
            (_, Some(_)) => StemKind::Fork,
            (0, None) => StemKind::Trunk,
            _ => StemKind::Branch,
        };
        bench.tree.stems.push(Stem {
            parent: stem.parent,
            level: stem.depth as u16,
            kind,
            offset: stem.offset,
            first_knot,
            knot_count,
        });
        Ok(())
    }

    /// Radius along `stem`.
    pub(crate) fn profile(&self, stem: &Seedling) -> Profile {
        let taper = self.model.levels[stem.depth].taper;
        let flare = if stem.depth == 0 { self.model.flare } else { 0.0 };
        Profile { base: stem.radius, length: stem.length, taper, flare }
    }
}

/// Stems shorter than this, in metres, are not made.
pub(crate) const MIN_LENGTH: f64 = 1e-4;

/// Collects the clones of a stem.
struct Collect<'a> {
    origin: Seedling,
    clones: &'a mut Vec<Seedling>,
}

impl Forks for Collect<'_> {
    fn clone_at(&mut self, turtle: Turtle, state: CloneState, index: u32) {
        let key = self.origin.key.child(purpose::CLONE, index);
        self.clones.push(Seedling { key, turtle, clone: Some(state), ..self.origin });
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
