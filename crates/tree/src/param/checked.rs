//! Values that have been checked against their declarations.

use super::error::SlotError;
use super::space::{ParamSpace, Slot};
use std::sync::Arc;

/// A full list of values, one for each slot of a space, each allowed by its declaration.
#[derive(Clone, Debug)]
pub struct CheckedParams {
    space: Arc<ParamSpace>,
    values: Vec<f64>,
}

impl CheckedParams {
    pub(super) const fn trust(space: Arc<ParamSpace>, values: Vec<f64>) -> Self {
        Self { space, values }
    }

    /// The space that they were checked against.
    #[must_use]
    pub const fn space(&self) -> &Arc<ParamSpace> {
        &self.space
    }

    /// The values in slot order.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The values in slot order, if they were checked against `space` or an equal one. A generator
    /// asks this before it grows them.
    ///
    /// # Errors
    /// [`ForeignParams`] if they belong to another generator's space.
    pub fn values_in(&self, space: &Arc<ParamSpace>) -> Result<&[f64], ForeignParams> {
        // Spaces are shared, so they are compared by their declarations only where two generators
        // made equal ones.
        if Arc::ptr_eq(&self.space, space) || self.space == *space {
            Ok(&self.values)
        } else {
            Err(ForeignParams)
        }
    }

    /// The value in `slot`.
    #[must_use]
    pub fn get(&self, slot: Slot) -> f64 {
        self.values[slot.index()]
    }

    /// The numbers of parameter number `param`.
    #[must_use]
    pub fn list(&self, param: usize) -> &[f64] {
        &self.values[self.space.range_of(param)]
    }

    /// Replaces all values without allocating.
    ///
    /// # Errors
    /// The first slot whose value is not allowed; the old values stay.
    pub fn set(&mut self, values: &[f64]) -> Result<(), SlotError> {
        self.space.check_all(values)?;
        self.values.copy_from_slice(values);
        Ok(())
    }
}

/// Equal values of equal spaces.
impl PartialEq for CheckedParams {
    fn eq(&self, other: &Self) -> bool {
        other.values_in(&self.space) == Ok(&self.values)
    }
}

/// Values that were checked against the parameters of another generator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("these values belong to another generator's parameters")]
pub struct ForeignParams;
