//! Stylised trees as a generator.

use crate::draws::turned;
use crate::foliage;
use crate::params::{Id, Numbers};
use crate::skeleton::Skeleton;
use crate::write::{Budget, Writer};
use pleach_tree::param::table::Parameters;
use pleach_tree::{
    Address, CheckedParams, Foliage, Generator, GrowError, Growth, Key, ParamSpace, Slot, Spread, Tree,
    Workspace,
};
use std::sync::Arc;

/// The family's name in species files.
pub(crate) const NAME: &str = "stylised";

/// The growth model, which is nothing but its numbers.
#[derive(Debug)]
pub(crate) struct Stylised;

/// Memory that is reused from tree to tree.
#[derive(Debug, Default)]
struct Scratch {
    skeleton: Skeleton,
    foliage: foliage::Scratch,
}

impl Generator for Stylised {
    fn family(&self) -> &'static str {
        NAME
    }

    fn space(&self) -> &Arc<ParamSpace> {
        Numbers::space()
    }

    fn trunks(&self, values: &[f64]) -> Option<u32> {
        Some(Numbers::read(values).trunks).filter(|count| *count > 0)
    }

    fn is_active(&self, values: &[f64], slot: Slot) -> bool {
        Numbers::is_active(slot, &Numbers::read(values))
    }

    fn grow(
        &self,
        params: &CheckedParams,
        growth: &Growth,
        workspace: &mut Workspace,
        tree: &mut Tree,
    ) -> Result<(), GrowError> {
        let numbers = Numbers::read(params.values_in(Numbers::space())?);
        tree.clear();
        let Scratch { skeleton, foliage: scratch } = workspace.scratch();
        let draw = growth.draw(Address::trunk(0), 0);
        let key = draw.key(Key::root(growth.seed));
        let turn = ((draw.azimuth, draw.pitch) != (0.0, 0.0)).then(|| turned(&draw));
        // A skeleton has a few hundred vertices at most: only foliage is counted in detail.
        let mut budget = Budget::new(&growth.limits);
        skeleton.grow(&numbers, growth, key);
        budget.spend(skeleton.knots.len() as u64, Id::branch_quantity)?;
        let mut writer = Writer { tree, limits: &growth.limits, scale: numbers.scale, turn };
        writer.skeleton(skeleton)?;
        if growth.foliage == Foliage::All {
            foliage::grow(scratch, &numbers, skeleton, key, &mut budget, &mut writer)?;
        }
        Ok(())
    }

    fn spreads(&self, _: &[f64]) -> Vec<Spread> {
        // Azimuths of branches are drawn within a tenth of a turn, and elevations between two angles.
        let branches = Spread::for_stems(Spread::from_degrees(20.0, 40.0, 0.0));
        vec![Spread::for_trunks(), branches]
    }
}
