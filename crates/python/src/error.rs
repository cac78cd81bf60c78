//! What goes wrong, as Python's exceptions.

use pyo3::exceptions::PyException;
use pyo3::{PyErr, create_exception};
use std::fmt::Display;

create_exception!(pleach, PleachError, PyException, "Whatever pleach refuses; what is below says what of.");
create_exception!(pleach, SpeciesError, PleachError, "A species or a parameter that cannot be.");
create_exception!(pleach, GoalError, PleachError, "A picture or an array that is not a goal.");
create_exception!(pleach, GrowError, PleachError, "A tree that does not grow: too large, or broken rules.");
create_exception!(pleach, FitError, PleachError, "A fit that cannot begin, or has found nothing.");

/// The message of `error` as a [`SpeciesError`].
pub(crate) fn of_species(error: impl Display) -> PyErr {
    SpeciesError::new_err(error.to_string())
}

/// The message of `error` as a [`GoalError`].
pub(crate) fn of_goal(error: impl Display) -> PyErr {
    GoalError::new_err(error.to_string())
}

/// The message of `error` as a [`GrowError`].
pub(crate) fn of_growth(error: impl Display) -> PyErr {
    GrowError::new_err(error.to_string())
}

/// The message of `error` as a [`FitError`].
pub(crate) fn of_fit(error: impl Display) -> PyErr {
    FitError::new_err(error.to_string())
}

/// The message of `error` as a [`PleachError`].
pub(crate) fn of_export(error: impl Display) -> PyErr {
    PleachError::new_err(error.to_string())
}
