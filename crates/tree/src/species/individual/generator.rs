//! A generator one of whose trees is an individual.

use super::table::to_toml;
use crate::generator::{Generator, Stature, Variation};
use crate::grow_error::{Conflict, GrowError};
use crate::growth::{Growth, Workspace};
use crate::leafless::Leafless;
use crate::param::{CheckedParams, ParamSpace, Slot};
use pleach_plant::Tree;
use pleach_plant::{Draws, Individual, Spread};
use std::sync::Arc;

/// The generator of a kind, whose tree of one seed is an individual and whose other trees are of the kind.
#[derive(Clone, Debug)]
pub(crate) struct WithIndividual {
    kind: Arc<dyn Generator>,
    tree_seed: u64,
    individual: Individual,
    draws: Draws,
}

impl WithIndividual {
    pub(crate) fn new(kind: Arc<dyn Generator>, tree_seed: u64, individual: Individual) -> Self {
        let draws = individual.draws();
        Self { kind, tree_seed, individual, draws }
    }
}

impl Generator for WithIndividual {
    fn family(&self) -> &'static str {
        self.kind.family()
    }

    fn space(&self) -> &Arc<ParamSpace> {
        self.kind.space()
    }

    fn grow(
        &self,
        params: &CheckedParams,
        growth: &Growth<'_>,
        workspace: &mut Workspace,
        tree: &mut Tree,
    ) -> Result<(), GrowError> {
        let is_individual = growth.draws.is_none() && growth.seed == self.tree_seed;
        let draws = if is_individual { Some(&self.draws) } else { growth.draws };
        self.kind.grow(params, &Growth { draws, ..*growth }, workspace, tree)
    }

    fn spreads(&self, values: &[f64]) -> Vec<Spread> {
        self.kind.spreads(values)
    }

    fn hull_height(&self, values: &[f64]) -> Option<f64> {
        self.kind.hull_height(values)
    }

    fn structure(&self) -> String {
        format!("{}{}", self.kind.structure(), to_toml(&self.individual))
    }

    fn written(&self) -> String {
        format!("{}{}", self.kind.written(), to_toml(&self.individual))
    }

    fn variation(&self) -> Option<&dyn Variation> {
        self.kind.variation()
    }

    fn is_active(&self, values: &[f64], slot: Slot) -> bool {
        self.kind.is_active(values, slot)
    }

    fn trunks(&self, values: &[f64]) -> Option<u32> {
        self.kind.trunks(values)
    }

    fn adapt(&self, values: &mut [f64], wanted: &Stature, grown: &Stature) {
        self.kind.adapt(values, wanted, grown);
    }

    fn finer_leaves(&self, values: &[f64]) -> Vec<Vec<f64>> {
        self.kind.finer_leaves(values)
    }

    fn check(&self, values: &[f64]) -> Result<(), Conflict> {
        self.kind.check(values)
    }

    fn leafless(&self, values: &[f64]) -> Option<Leafless> {
        self.kind.leafless(values)
    }

    fn resize(&self, values: &mut [f64], factor: f64) -> bool {
        self.kind.resize(values, factor)
    }

    fn grows_in_proportion(&self) -> bool {
        self.kind.grows_in_proportion()
    }

    fn shows_size_jitter(&self, values: &[f64]) -> bool {
        self.kind.shows_size_jitter(values)
    }

    fn individual(&self) -> Option<&Individual> {
        Some(&self.individual)
    }

    fn kind(&self) -> Option<Arc<dyn Generator>> {
        Some(Arc::clone(&self.kind))
    }
}
