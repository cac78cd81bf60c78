//! The generator: values, and what becomes of them.

use crate::grow::{Scratch, grow, spreads};
use crate::model::Model;
use crate::params::Numbers;
use pleach_tree::param::table::Parameters;
use pleach_tree::{CheckedParams, Generator, GrowError, Growth, ParamSpace, Slot, Spread, Tree, Workspace};
use std::sync::Arc;

/// What species files call the generator.
pub(crate) const NAME: &str = "fractal";

/// The growth model. It has nothing but its numbers, so there is nothing in it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fractal;

impl Generator for Fractal {
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
        growth: &Growth,
        workspace: &mut Workspace,
        tree: &mut Tree,
    ) -> Result<(), GrowError> {
        let model = Model::new(params.values_in(Numbers::space())?);
        grow(&model, growth, workspace.scratch::<Scratch>(), tree)
    }

    fn spreads(&self, values: &[f64]) -> Vec<Spread> {
        spreads(&Model::new(values))
    }
}
