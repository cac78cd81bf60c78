//! Leaves and blossoms on the deepest level.
//!
//! Weber and Penn 1995, §4.9; Hewitt 2017, §3.2.2.

use crate::budget::{Cause, Exceeded};
use crate::children::relative_length;
use crate::context::{Buffers, GrowContext};
use crate::leaf_batch::{LANES, LeafBatch, LeafSite};
use crate::leaf_fan::{self, LeafFan};
use crate::model::Model;
use crate::purpose;
use crate::spacing::Spacing;
use crate::stem::StemSpec;
use glam::Vec3;
use pleach_tree::{Leaf, Tree};

/// Grows the leaves and blossoms of `stem`, whose index in the tree is `index`.
pub(crate) fn grow(
    context: &GrowContext<'_>,
    buffers: &mut Buffers<'_>,
    stem: &StemSpec,
    index: u32,
    first_point: usize,
) -> Result<(), Exceeded> {
    let model = context.model;
    let relative_scale = stem.scale / model.g_scale;
    let spacing = spacing(model, stem);
    let profile = stem.profile(model);
    let kinds = Kinds {
        stem: (stem, index),
        blossom_rate: model.blossom_rate,
        leaf: (
            (model.leaf_scale * relative_scale) as f32,
            (model.leaf_scale * model.leaf_scale_x * relative_scale) as f32,
        ),
        blossom: (model.blossom_scale * relative_scale) as f32,
    };
    let helix = spacing.level.is_helix();

    let Buffers { tree, path, budget, .. } = buffers;
    let path = &path[first_point..];
    if spacing.count < 0.0 {
        budget.work(Cause::Leaves, stem.level, spacing.members().into())?;
        budget.leaves(spacing.members() as usize)?;
        let radius = profile.at(1.0);
        kinds.fan(tree, &spacing, LeafFan::new(spacing.tip(path), radius, model.leaf_bend));
        return Ok(());
    }
    let mut batch = LeafBatch::default();
    let mut numbers = [0; LANES];
    spacing.sites(path, (budget, Cause::Leaves), |budget, site| {
        budget.leaf()?;
        let radius = profile.at(site.offset / stem.length);
        let down_angle = spacing.down_angle(site.number, site.offset);
        numbers[batch.len()] = site.number;
        let leaf = LeafSite { piece: site.piece, t: site.t, rotation: site.rotation, down_angle, radius };
        batch.push(path, helix, &leaf);
        if batch.len() == LANES {
            kinds.flush(tree, &mut batch, &numbers, helix, model.leaf_bend);
        }
        Ok(())
    })?;
    kinds.flush(tree, &mut batch, &numbers, helix, model.leaf_bend);
    Ok(())
}

/// How the leaves and blossoms of `stem` are spaced.
pub(crate) fn spacing<'a>(model: &'a Model, stem: &'a StemSpec) -> Spacing<'a> {
    Spacing {
        stem,
        level: &model.levels[stem.level],
        next: model.child_level(stem.level),
        count: model.leaf_blos_num * (stem.scale / model.g_scale) * relative_length(stem),
        forks_cost: false,
    }
}

/// How large the leaves and blossoms of a stem are, and which are which.
struct Kinds<'a> {
    stem: (&'a StemSpec, u32),
    blossom_rate: f64,
    /// Length and width of the unit leaf, metres.
    leaf: (f32, f32),
    /// Scale of the unit blossom, metres.
    blossom: f32,
}

impl Kinds<'_> {
    fn flush(&self, tree: &mut Tree, batch: &mut LeafBatch, numbers: &[u32; LANES], helix: bool, bend: f64) {
        if batch.len() == 0 {
            return;
        }
        batch.site(helix, bend as f32);
        for (lane, &number) in numbers[..batch.len()].iter().enumerate() {
            self.push(tree, number, batch.leaf(lane));
        }
        batch.clear();
    }

    fn fan(&self, tree: &mut Tree, spacing: &Spacing<'_>, mut fan: LeafFan) {
        let mut numbers = (0..spacing.members()).peekable();
        while let Some(&first) = numbers.peek() {
            for number in numbers.by_ref().take(leaf_fan::LANES) {
                fan.push(spacing.fan_turn(number), spacing.down_angle(number, self.stem.0.length));
            }
            fan.site();
            for (lane, number) in (first..).take(fan.len()).enumerate() {
                self.push(tree, number, fan.leaf(lane));
            }
            fan.clear();
        }
    }

    fn push(&self, tree: &mut Tree, number: u32, (position, along, across): (Vec3, Vec3, Vec3)) {
        let (stem, index) = self.stem;
        let rate = self.blossom_rate;
        let blossom = rate > 0.0 && stem.key.unit(purpose::BLOSSOM, number) < rate;
        let (shapes, (length, width)) = if blossom {
            (&mut tree.blossoms, (self.blossom, self.blossom))
        } else {
            (&mut tree.leaves, self.leaf)
        };
        shapes.push(Leaf { position, along: along * length, across: across * width, stem: index, shape: 0 });
    }
}
