//! The generator: a parameter space, what trees are pruned against, and growing.

use crate::blame;
use crate::grow::{Scratch, grow};
use crate::model::Model;
use crate::params::active::is_active;
use crate::params::space;
use crate::solid::{Solid, Surroundings};
use pleach_tree::{CheckedParams, Conflict, Generator, GrowError, Growth, ParamSpace, Slot, Tree, Workspace};
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
        growth: &Growth,
        workspace: &mut Workspace,
        tree: &mut Tree,
    ) -> Result<(), GrowError> {
        let model = Model::new(params.values_in(space())?);
        check(&model)?;
        grow(&model, &self.surroundings, growth, workspace.scratch::<Scratch>(), tree)
    }

    fn is_active(&self, values: &[f64], slot: Slot) -> bool {
        is_active(Model::new(values), &self.surroundings, space().info(slot))
    }

    fn check(&self, values: &[f64]) -> Result<(), Conflict> {
        check(&Model::new(values))
    }

    fn shows_size_jitter(&self, values: &[f64]) -> bool {
        // No two trunks of a tree are of one size.
        Model::new(values).trunks() > 1
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
