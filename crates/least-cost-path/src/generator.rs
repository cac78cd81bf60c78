//! The growth model.

use crate::budget::{Budget, Causes};
use crate::graph::{Rules, Work};
use crate::leaves;
use crate::levels::{First, Levels};
use crate::numbers::{Facts, Given, Id, Numbers};
use crate::skeleton::Skeleton;
use crate::stems::Stems;
use crate::structure::{Structure, VOLUMES};
use crate::volume;
use pleach_tree::param::table::Parameters;
use pleach_tree::{
    Blame, CheckedParams, Conflict, Foliage, Generator, GrowError, Growth, Key, ParamSpace, Slot, StemKind,
    Tree, Workspace,
};
use std::sync::Arc;

/// The family's name in species files.
pub(crate) const NAME: &str = "least-cost-path";

/// Trees of least-cost paths, with everything settled but the numbers.
#[derive(Clone, Debug, Default)]
pub struct LeastCostPath {
    pub(crate) structure: Structure,
}

/// Memory that is kept from tree to tree.
#[derive(Debug, Default)]
struct Scratch {
    levels: Levels,
    skeleton: Skeleton,
    stems: Stems,
}

impl LeastCostPath {
    /// What the graphs of a tree take, beside growing it: for measurements.
    ///
    /// # Errors
    /// As [`Generator::grow`].
    pub fn grow_counted(
        &self,
        params: &CheckedParams,
        growth: &Growth,
        workspace: &mut Workspace,
        tree: &mut Tree,
    ) -> Result<Work, GrowError> {
        let n = Numbers::read(params.values_in(Numbers::space())?);
        tree.clear();
        let scratch: &mut Scratch = workspace.scratch();
        let key = Key::root(growth.seed);
        let rules = Rules::new(&n, growth.parallel);
        let mut budget = Budget::new(growth.limits, &rules);
        let (volume, crowded) = match &self.structure.volumes {
            Some(volumes) => (volumes.volume(n.crown_radius), VOLUMES.to_owned()),
            None => {
                let drawn = self.structure.outline.as_ref().map(|drawn| &drawn.outline);
                (volume::first(&n, drawn, key), Id::nodes.slot_name(0))
            }
        };
        let first = First { volume: &volume, causes: Causes::first(crowded) };
        let Scratch { levels, skeleton, stems } = scratch;
        levels.above(&n, &first, key, &rules, &mut budget, skeleton)?;
        if skeleton.points.len() < 2 {
            let blame = Blame(vec![Id::nodes.slot_name(0), Id::shell.slot_name(0)]);
            return Err(Conflict::NothingLeft { blame }.into());
        }
        stems.build(skeleton, &n, StemKind::Trunk, &growth.limits, tree)?;
        if growth.foliage == Foliage::All {
            leaves::put(&n, &stems.tips, &growth.limits, tree)?;
        }
        if n.root_depth > 0.0 {
            levels.below(&n, key, &rules, &mut budget, skeleton)?;
            stems.build(skeleton, &n, StemKind::Root, &growth.limits, tree)?;
        }
        Ok(budget.work)
    }
}

impl Generator for LeastCostPath {
    fn family(&self) -> &'static str {
        NAME
    }

    fn space(&self) -> &Arc<ParamSpace> {
        Numbers::space()
    }

    fn structure(&self) -> String {
        self.structure.to_toml()
    }

    fn is_active(&self, values: &[f64], slot: Slot) -> bool {
        let given =
            Given { volumes: self.structure.volumes.is_some(), outline: self.structure.outline.is_some() };
        let index = Numbers::space().info(slot).index;
        Numbers::is_active(slot, &Facts { n: Numbers::read(values), given, index })
    }

    fn grow(
        &self,
        params: &CheckedParams,
        growth: &Growth,
        workspace: &mut Workspace,
        tree: &mut Tree,
    ) -> Result<(), GrowError> {
        self.grow_counted(params, growth, workspace, tree).map(|_| ())
    }
}
