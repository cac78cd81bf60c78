//! Values that have been checked against their declarations.

use super::error::SlotError;
use super::space::ParamSpace;

/// A full list of values, one a slot, each allowed by its declaration.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckedParams {
    values: Vec<f64>,
}

impl CheckedParams {
    pub(super) const fn trust(values: Vec<f64>) -> Self {
        Self { values }
    }

    /// The values in slot order.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The numbers of parameter number `param` of `space`.
    #[must_use]
    pub fn of(&self, space: &ParamSpace, param: usize) -> &[f64] {
        &self.values[space.slots_of(param)]
    }

    /// Replaces all values without allocating.
    ///
    /// # Errors
    /// The first slot whose value is not allowed; the old values stay.
    pub fn set(&mut self, space: &ParamSpace, values: &[f64]) -> Result<(), SlotError> {
        space.check_all(values)?;
        self.values.copy_from_slice(values);
        Ok(())
    }
}
