//! Silhouettes compared, and photographs masked.

use crate::arrays::of_ink;
use crate::error::of_goal;
use crate::goal::Source;
use crate::{arrays, json, pool};
use numpy::PyArray2;
use pleach::{Bitmap, Mask, MaskHints, MaskOptions, Photo, ScoreCard};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The score card of two silhouettes of one size.
#[pyfunction]
pub(crate) fn score<'py>(
    py: Python<'py>,
    picture: &Bound<'py, PyAny>,
    goal: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let (one, other) = (ink(picture)?, ink(goal)?);
    let card = pool::on(py, None, || ScoreCard::new(&one, &other))?.map_err(of_goal)?;
    of_card(py, &card)
}

fn ink(picture: &Bound<'_, PyAny>) -> PyResult<Bitmap> {
    Ok(match Source::read(picture)? {
        Source::Ink(ink) => ink,
        picture @ Source::Picture(_) => picture.goal(&arrays::whole())?.bitmap,
    })
}

/// A score card as a dict.
pub(crate) fn of_card<'py>(py: Python<'py>, card: &ScoreCard) -> PyResult<Bound<'py, PyAny>> {
    let value = serde_json::to_value(card).map_err(of_goal)?;
    json::to_python(py, &value)
}

/// The tree in a photograph: what is tree, and how sure that is.
#[pyfunction]
pub(crate) fn mask<'py>(
    py: Python<'py>,
    photo: &Bound<'py, PyAny>,
    seed_point: Option<(u32, u32)>,
    hints: &str,
) -> PyResult<(Bound<'py, PyArray2<bool>>, Bound<'py, PyDict>)> {
    let Source::Picture(source) = Source::read(photo)? else {
        return Err(PyTypeError::new_err("an array of bool is a mask already; a photograph is uint8"));
    };
    let options = MaskOptions { seed_point, ..MaskOptions::default() };
    let hints: MaskHints = serde_json::from_str(hints).map_err(of_goal)?;
    let found = pool::on(py, None, || {
        let photo = Photo::from_encoded(&source).map_err(|error| error.to_string())?;
        let options = hints.over(options, &photo, &source.into()).map_err(|error| error.to_string())?;
        Mask::from_photo(&photo, &options).map_err(|error| error.to_string())
    })?
    .map_err(of_goal)?;
    let about = PyDict::new(py);
    about.set_item("confidence", found.confidence)?;
    about.set_item("warnings", found.warnings.iter().map(ToString::to_string).collect::<Vec<_>>())?;
    Ok((of_ink(py, &found.bitmap)?, about))
}
