//! Directions of view.

use crate::error::PleachError;
use pleach::View;
use pyo3::prelude::*;

/// Azimuth in degrees, or azimuth and elevation.
#[derive(Clone, Copy, Debug, FromPyObject)]
pub(crate) enum Direction {
    /// A level view.
    #[pyo3(transparent)]
    Level(f64),
    /// From above or from below.
    #[pyo3(transparent)]
    Tilted((f64, f64)),
}

impl Direction {
    /// The view.
    pub(crate) fn view(self) -> PyResult<View> {
        let (azimuth, elevation) = match self {
            Self::Level(azimuth) => (azimuth, 0.0),
            Self::Tilted(both) => both,
        };
        if azimuth.is_finite() && (-90.0..=90.0).contains(&elevation) {
            return Ok(View::degrees(azimuth, elevation));
        }
        Err(PleachError::new_err(format!(
            "the view is from {azimuth}, {elevation} degrees, expected an azimuth, or an azimuth and an elevation from \
             -90 to 90"
        )))
    }
}

/// The view that was asked for; the front if none was.
pub(crate) fn view(direction: Option<Direction>) -> PyResult<View> {
    direction.map_or(Ok(View::FRONT), Direction::view)
}
