//! The growth model: from numbers to a tree.

use crate::adapt::adapt;
use crate::budget::Budget;
use crate::colony::Colony;
use crate::finer_leaves::finer_leaves;
use crate::nodes::Nodes;
use crate::params::Numbers;
use crate::pipes::Pipes;
use crate::points;
use crate::purpose::{POINTS, VOLUME};
use crate::rules::Rules;
use crate::stems::Stems;
use crate::trunks;
use crate::twigs::Twigs;
use crate::volume::Volume;
use glam::DVec3;
use pleach_tree::param::table::Parameters;
use pleach_tree::{
    CheckedParams, Draw, Generator, GrowError, Growth, Key, ParamSpace, Slot, Spread, Stature, Tree,
    Workspace,
};
use std::sync::Arc;

/// The family's name in species files.
pub(crate) const NAME: &str = "space-colonization";

/// Trees that fill a volume. It has nothing but its numbers, so there is nothing in it.
#[derive(Clone, Copy, Debug, Default)]
pub struct SpaceColonization;

/// Memory that is kept from tree to tree.
#[derive(Debug, Default)]
struct Scratch {
    points: Vec<DVec3>,
    nodes: Nodes,
    colony: Colony,
    pipes: Pipes,
    stems: Stems,
}

impl SpaceColonization {
    /// Grows the scaffold alone, without stems, twigs and leaves, and says how many nodes it has: for measurements.
    ///
    /// # Errors
    /// As [`Generator::grow`].
    pub fn scaffold_nodes(
        &self,
        params: &CheckedParams,
        growth: &Growth<'_>,
        workspace: &mut Workspace,
    ) -> Result<usize, GrowError> {
        let n = Numbers::read(params.values_in(Numbers::space())?);
        let scratch: &mut Scratch = workspace.scratch();
        scaffold(&n, growth, scratch, &mut Budget::new(growth.limits))?;
        Ok(scratch.nodes.all.len())
    }
}

/// Grows the nodes of a tree.
fn scaffold(
    n: &Numbers,
    growth: &Growth<'_>,
    scratch: &mut Scratch,
    budget: &mut Budget,
) -> Result<(), GrowError> {
    let Scratch { points, nodes, colony, pipes, .. } = scratch;
    let hull = growth.hull();
    let key = Draw { seed: hull.map_or(0, |hull| hull.seed), ..Draw::OWN }.key(Key::root(growth.seed));
    let volume = Volume::new(n, hull, key.child(VOLUME, 0));
    points::scatter(n, &volume, key.child(POINTS, 0), points);
    let rules = Rules::new(n, Rules::spacing(volume.own_size(), n.points));
    nodes.clear();
    trunks::stand(n, &volume, &rules, key, nodes);
    colony.grow((points, &volume), &rules, nodes, budget)?;
    pipes.measure(n, nodes);
    Ok(())
}

impl Generator for SpaceColonization {
    fn family(&self) -> &'static str {
        NAME
    }

    fn space(&self) -> &Arc<ParamSpace> {
        Numbers::space()
    }

    fn is_active(&self, values: &[f64], slot: Slot) -> bool {
        Numbers::is_active(slot, &Numbers::read(values))
    }

    fn grow(
        &self,
        params: &CheckedParams,
        growth: &Growth<'_>,
        workspace: &mut Workspace,
        tree: &mut Tree,
    ) -> Result<(), GrowError> {
        let n = Numbers::read(params.values_in(Numbers::space())?);
        tree.clear();
        tree.leaf_shapes.push(Arc::clone(n.leaf_shape.outline()));
        let scratch: &mut Scratch = workspace.scratch();
        let mut budget = Budget::new(growth.limits);
        scaffold(&n, growth, scratch, &mut budget)?;
        let twigs = Twigs::new(&n, growth);
        let Scratch { nodes, pipes, stems, .. } = scratch;
        stems.build((&n, growth), (nodes, pipes), tree, &mut budget, &mut |limb, source, tree, budget| {
            twigs.grow(limb, source, tree, budget)
        })
    }

    fn trunks(&self, values: &[f64]) -> Option<u32> {
        Some(Numbers::read(values).trunks)
    }

    fn finer_leaves(&self, values: &[f64]) -> Vec<Vec<f64>> {
        finer_leaves(values)
    }

    fn adapt(&self, values: &mut [f64], wanted: &Stature, grown: &Stature) {
        adapt(values, wanted, grown);
    }

    /// A limb is turned with all that it carries, as if it had grown so; its points are not colonised again. What it
    /// draws again are its twigs.
    fn spreads(&self, values: &[f64]) -> Vec<Spread> {
        let n = Numbers::read(values);
        let twigs = Spread { azimuth: 0.0, pitch: n.twig_angle_v, length: n.twig_length_v };
        vec![Spread::for_trunks(), Spread::for_stems(twigs)]
    }

    fn hull_height(&self, values: &[f64]) -> Option<f64> {
        Some(Numbers::read(values).height)
    }

    fn grows_in_proportion(&self) -> bool {
        true
    }
}
