//! The generator: a parameter space, what trees are pruned against, and growing.

use crate::adapt::adapt;
use crate::blame;
use crate::grow::{Memory, grow};
use crate::leafless::leafless;
use crate::model::Model;
use crate::params::active::is_active;
use crate::params::space;
use crate::solid::{Solid, Surroundings};
use crate::spread::spreads;
use pleach_tree::param::table::Parameters;
use pleach_tree::{
    CheckedParams, Conflict, Generator, GrowError, Growth, Leafless, ParamSpace, Slot, Spread, Stature, Tree,
    Workspace,
};
use std::sync::Arc;

/// Weber and Penn's model, with the surroundings that its trees are pruned against.
#[derive(Clone, Debug, Default)]
pub struct WeberPenn {
    /// What pruning tests points against.
    pub surroundings: Surroundings,
}

impl Generator for WeberPenn {
    fn family(&self) -> &'static str {
        "weber-penn"
    }

    fn space(&self) -> &Arc<ParamSpace> {
        space()
    }

    fn grow(
        &self,
        params: &CheckedParams,
        growth: &Growth<'_>,
        workspace: &mut Workspace,
        tree: &mut Tree,
    ) -> Result<(), GrowError> {
        let model = Model::read(params.values_in(space())?);
        check(&model)?;
        grow(&model, &self.surroundings, growth, workspace.scratch::<Memory>(), tree)
    }

    fn is_active(&self, values: &[f64], slot: Slot) -> bool {
        is_active(Model::read(values), &self.surroundings, slot)
    }

    fn trunks(&self, values: &[f64]) -> Option<u32> {
        let model = Model::read(values);
        // A number below 0 is drawn.
        (model.floor_splits > 0 || model.levels[0].branches >= 0.0).then(|| model.trunks())
    }

    fn adapt(&self, values: &mut [f64], wanted: &Stature, grown: &Stature) {
        adapt(values, wanted, grown);
    }

    fn check(&self, values: &[f64]) -> Result<(), Conflict> {
        check(&Model::read(values))
    }

    fn leafless(&self, values: &[f64]) -> Option<Leafless> {
        leafless(&Model::read(values))
    }

    fn spreads(&self, values: &[f64]) -> Vec<Spread> {
        spreads(&Model::read(values))
    }

    fn hull_height(&self, values: &[f64]) -> Option<f64> {
        Some(Model::read(values).g_scale)
    }

    fn shows_size_jitter(&self, values: &[f64]) -> bool {
        // No two trunks of a tree are of one size.
        Model::read(values).trunks() > 1
    }

    fn structure(&self) -> String {
        let mut text = String::new();
        if let Some(inside) = &self.surroundings.inside {
            text.push_str(&format!("prune_inside = {}\n", Solid::write_list(inside)));
        }
        if !self.surroundings.obstacles.is_empty() {
            text.push_str(&format!(
                "prune_obstacles = {}\n",
                Solid::write_list(&self.surroundings.obstacles)
            ));
        }
        text
    }
}

/// A tree of trunks that never have a length would be no tree at all.
fn check(model: &Model) -> Result<(), Conflict> {
    let trunk = &model.levels[0];
    if trunk.length + trunk.length_v > 0.0 { Ok(()) } else { Err(blame::nothing_left(model)) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::table::Id;
    use pleach_tree::Blame;

    #[test]
    fn solids_make_another_model() {
        let plain = WeberPenn::default();
        let inside = |solids: &[Solid]| {
            let inside = Some(solids.to_vec());
            WeberPenn { surroundings: Surroundings { inside, ..Surroundings::default() } }.model()
        };
        let sphere = Solid::Sphere { center: glam::DVec3::Z, radius: 1.0 };
        assert_eq!(plain.model(), WeberPenn::default().model());
        assert_ne!(plain.model(), inside(&[]), "no bound at all is not the envelope");
        assert_ne!(inside(&[]), inside(&[sphere]));
        assert_eq!(inside(&[sphere]), inside(&[sphere]));
    }

    #[test]
    fn trunks_without_length_are_told_before_growing() {
        let mut values = space().defaults();
        values[Id::length.slot(0).index()] = 0.0;
        let blame = Blame(vec!["length[0]".to_owned(), "length_v[0]".to_owned()]);
        let conflict = Conflict::NothingLeft { blame };
        assert_eq!(WeberPenn::default().check(&values), Err(conflict.clone()));
        let params = space().check(values.clone()).unwrap();
        let grown = WeberPenn::default().grow(
            &params,
            &Growth::default(),
            &mut Workspace::default(),
            &mut Tree::default(),
        );
        assert_eq!(grown, Err(GrowError::Conflict(conflict)));
        // By chance, some trees have a trunk.
        values[Id::length_v.slot(0).index()] = 1.0;
        assert_eq!(WeberPenn::default().check(&values), Ok(()));
    }
}
