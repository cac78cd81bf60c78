//! Where a tree stands in a picture, as users know it.

use crate::error::FitError;
use pleach::GoalOptions;
use pyo3::prelude::*;

/// Metres per pixel, the column of the trunk's foot and the row of the ground, in pixels of the picture.
#[derive(Clone, Copy, FromPyObject)]
#[pyo3(transparent)]
pub(crate) struct KnownFrame((f64, f64, f64));

impl KnownFrame {
    /// The same, if its scale is one; places are checked when the picture is read.
    pub(crate) fn checked(self) -> PyResult<Self> {
        let (scale, ..) = self.0;
        if scale > 0.0 && scale.is_finite() {
            return Ok(self);
        }
        Err(FitError::new_err(format!("frame has {scale} metres per pixel, expected a number above 0")))
    }

    pub(crate) const fn meters_per_pixel(self) -> f64 {
        self.0.0
    }

    /// A goal that is read with these places.
    pub(crate) fn options(self) -> GoalOptions {
        let (_, column, row) = self.0;
        GoalOptions { axis_column: Some(column), ground_row: Some(row), ..GoalOptions::default() }
    }
}
