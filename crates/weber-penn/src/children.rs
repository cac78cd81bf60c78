//! How many children a stem has, and what they are before they grow.
//!
//! Weber and Penn 1995, §4.3; Hewitt 2017, §3.2.1 *Branch Distribution*.

use crate::budget::{CHILD_STEPS, Cause, Exceeded};
use crate::context::{Buffers, GrowContext};
use crate::crown;
use crate::model::Model;
use crate::purpose;
use crate::radius::Profile;
use crate::spacing::{ChildFrame, Spacing};
use crate::stem::StemSpec;
use pleach_tree::turtle::Turtle;
use pleach_tree::{Draw, Growth};

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

/// How the children of `stem` are spaced.
pub(crate) fn spacing<'a>(model: &'a Model, stem: &'a StemSpec) -> Spacing<'a> {
    Spacing {
        stem,
        level: &model.levels[stem.level],
        next: model.child_level(stem.level),
        count: count(model, stem),
        forks_cost: true,
    }
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
    let bearing = Bearing::new(context.model, context.growth, stem, child_length);
    let spacing = spacing(context.model, stem);
    let Buffers { path, children, budget, .. } = buffers;
    let path = &path[first_point..];
    spacing.sites(path, (budget, Cause::Children), |budget, mut site| {
        let Some((mut child, draw)) = bearing.child(site.number, site.offset, site.fan.is_some()) else {
            return Ok(());
        };
        budget.work(Cause::Children, stem.level, CHILD_STEPS)?;
        child.parent = Some(index);
        // The child's base sits inside the rim of its parent (Hewitt 2017, §3.2.1).
        site.rotation += draw.azimuth;
        let ChildFrame { turtle, outward } = spacing.child_frame(path, &site);
        child.turtle = turtle;
        if draw.pitch != 0.0 {
            child.turtle.pitch_down(draw.pitch);
        }
        if stem.level == 0 && !crown::is_round(context.model) {
            child.length *= crown::by_azimuth(context.model, child.turtle.direction);
            if context.model.prune_ratio <= 0.0 && !child.is_made() {
                return Ok(());
            }
            child.radius = child.branch_radius(context.model);
        }
        let radius_here =
            if site.fan.is_some() { bearing.radius_at(site.offset) } else { child.radius_limit };
        child.turtle.position += outward * (radius_here - child.radius.min(radius_here));
        children.push(child);
        budget.wait(children.len())
    })
}

/// A stem that bears children.
pub(crate) struct Bearing<'a> {
    model: &'a Model,
    growth: &'a Growth<'a>,
    stem: &'a StemSpec,
    profile: Profile,
    child_length: f64,
}

impl<'a> Bearing<'a> {
    pub(crate) fn new(
        model: &'a Model,
        growth: &'a Growth<'a>,
        stem: &'a StemSpec,
        child_length: f64,
    ) -> Self {
        Self { model, growth, stem, profile: stem.profile(model), child_length }
    }

    fn radius_at(&self, offset: f64) -> f64 {
        self.profile.at(offset / self.stem.length)
    }

    /// Child `number` at `offset` metres, without its place in space and in the tree, and its draws;
    /// `None` where the parent is too thin or the child would be too short.
    pub(crate) fn child(&self, number: u32, offset: f64, in_fan: bool) -> Option<(StemSpec, Draw)> {
        let Self { model, stem, child_length, .. } = *self;
        // The tip of a cone has no radius to bear a fan; its base has.
        let radius_limit = if in_fan { stem.radius } else { self.radius_at(offset) };
        if radius_limit < MIN_PARENT_RADIUS {
            return None;
        }
        let address = stem.address.child(number);
        let draw = self.growth.draw(address, stem.level + 1);
        let length = length(model, stem, child_length, offset) * draw.length;
        let key = draw.key(stem.key.child(purpose::CHILD, number));
        let mut child = StemSpec {
            key,
            fork_key: key,
            address,
            number,
            level: stem.level + 1,
            turtle: Turtle::UP,
            parent: None,
            offset,
            length,
            radius: 0.0,
            radius_limit,
            parent_length: stem.length,
            parent_radius: stem.radius,
            parent_child_length: child_length,
            scale: stem.scale,
            forked: None,
        };
        // Waiting children count as stems, so those that cannot grow are left out here. Only pruning
        // decides later.
        if model.prune_ratio <= 0.0 && !child.is_made() {
            return None;
        }
        child.radius = child.branch_radius(model);
        Some((child, draw))
    }
}

/// A parent thinner than this, in metres, bears nothing.
const MIN_PARENT_RADIUS: f64 = 1e-4;

/// Nominal length of a child at `offset` metres along `stem`.
fn length(model: &Model, stem: &StemSpec, child_length: f64, offset: f64) -> f64 {
    let length = if stem.level == 0 {
        // The bare base keeps its length when the trunk is pruned.
        let base = model.levels[0].base_size * stem.parent_length;
        let q = (stem.length - offset) / (stem.length - base);
        stem.length * child_length * model.shape_ratio(q) * crown::outline(model, q)
    } else {
        child_length * (stem.length - 0.7 * offset)
    };
    length.max(0.0)
}
