//! The suite passes a family that keeps its promises, and fails one that does not.

use super::bush::{Bush, Bushes, FILES, space};
use crate::generator::Generator;
use crate::grow_error::{Blame, Conflict, GrowError};
use crate::growth::{Growth, Limits, Workspace};
use crate::model::ModelId;
use crate::param::{CheckedParams, ParamSpace, Slot};
use crate::species::Family;
use crate::species::{Issue, Key, SpeciesDoc};
use pleach_plant::Tree;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

crate::conformance!(Bushes);

/// A bush that breaks one promise.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Broken {
    GrowsByCalls,
    IgnoresKnots,
    IgnoresWork,
    TakesAnyValues,
    CallsAllInactive,
    ChecksInVain,
    ResizesInPart,
    ForgetsStructure,
    MovesWithLeaves,
    IsEmpty,
}

impl Family for Broken {
    fn name(&self) -> &'static str {
        "bush"
    }

    fn summary(&self) -> &'static str {
        "a broken bush"
    }

    fn keys(&self) -> &'static [Key] {
        Bushes.keys()
    }

    fn read(&self, doc: &SpeciesDoc, issues: &mut Vec<Issue>) -> Option<Arc<dyn Generator>> {
        let pairs = !Bushes.read(doc, issues)?.structure().is_empty();
        Some(Arc::new(BrokenBush { bush: Bush { pairs }, how: *self }))
    }

    fn presets(&self) -> &'static [(&'static str, &'static str)] {
        FILES
    }
}

#[derive(Debug)]
struct BrokenBush {
    bush: Bush,
    how: Broken,
}

impl Generator for BrokenBush {
    fn family(&self) -> &'static str {
        "bush"
    }

    fn space(&self) -> &Arc<ParamSpace> {
        space()
    }

    fn structure(&self) -> String {
        self.bush.structure()
    }

    fn model(&self) -> ModelId {
        let structure = if self.how == Broken::ForgetsStructure { "" } else { &self.structure() };
        ModelId::new("bush", structure)
    }

    fn is_active(&self, values: &[f64], slot: Slot) -> bool {
        self.how != Broken::CallsAllInactive && self.bush.is_active(values, slot)
    }

    fn check(&self, values: &[f64]) -> Result<(), Conflict> {
        if self.how == Broken::ChecksInVain && (values[1] != 0.2 || values[2] > 8.0) {
            return Err(Conflict::NothingLeft { blame: Blame::default() });
        }
        self.bush.check(values)
    }

    fn resize(&self, values: &mut [f64], factor: f64) -> bool {
        if self.how == Broken::ResizesInPart {
            values[0] *= factor.min(1.5);
            return factor < 10.0;
        }
        self.bush.resize(values, factor)
    }

    fn grow(
        &self,
        params: &CheckedParams,
        growth: &Growth,
        workspace: &mut Workspace,
        tree: &mut Tree,
    ) -> Result<(), GrowError> {
        let mut growth = *growth;
        let free = Limits::default();
        match self.how {
            Broken::GrowsByCalls => {
                let calls: &mut u64 = workspace.scratch();
                growth.seed += *calls;
                *calls += 1;
            }
            Broken::IgnoresKnots => growth.limits.knots = free.knots,
            Broken::IgnoresWork => growth.limits.work = free.work,
            Broken::MovesWithLeaves => growth.seed += u64::from(growth.foliage == crate::Foliage::All),
            Broken::TakesAnyValues => {
                let mut values = space().defaults();
                values.iter_mut().zip(params.values()).for_each(|(to, from)| *to = *from);
                space().repair(&mut values);
                let params = space().check(values).unwrap();
                return self.bush.grow(&params, &growth, workspace, tree);
            }
            _ => {}
        }
        self.bush.grow(params, &growth, workspace, tree)?;
        if self.how == Broken::IsEmpty {
            tree.clear();
        }
        Ok(())
    }
}

#[test]
fn every_broken_promise_is_found() {
    let found = |how: Broken, promise: fn(&dyn Family)| {
        let result = catch_unwind(AssertUnwindSafe(|| promise(&how)));
        assert!(result.is_err(), "{how:?} is not found");
    };
    found(Broken::GrowsByCalls, super::the_same_seed_is_the_same_tree);
    found(Broken::IgnoresKnots, super::limits_are_errors);
    found(Broken::IgnoresWork, super::limits_are_errors);
    found(Broken::TakesAnyValues, super::values_of_another_space_are_refused);
    found(Broken::CallsAllInactive, super::inactive_numbers_change_nothing);
    found(Broken::ChecksInVain, super::conflicts_are_told_before_growing);
    found(Broken::ResizesInPart, super::resizing_is_similar_or_refused);
    found(Broken::ForgetsStructure, super::models_are_told_apart_by_structure);
    found(Broken::MovesWithLeaves, super::stems_do_not_depend_on_leaves);
    found(Broken::IsEmpty, super::trees_are_well_formed);
}
