//! What is in a picture of a tree.

use crate::arrays::of_ink;
use crate::error::of_fit;
use crate::fit::of_prepare;
use crate::goal::Source;
use crate::{json, pool};
use numpy::{IntoPyArray as _, PyArray2, PyArray3, PyArrayMethods as _};
use pleach::{FitOptions, FitSource, PictureReading, read_picture};
use pyo3::prelude::*;
use std::collections::BTreeMap;

/// The measures as a dict, the tree as ink, and the measures drawn over it.
type Read<'py> = (Bound<'py, PyAny>, Bound<'py, PyArray2<bool>>, Bound<'py, PyArray3<u8>>);

/// Reads a picture, with the options of a fit as JSON and the pictures that they name.
#[pyfunction]
pub(crate) fn read<'py>(
    py: Python<'py>,
    picture: &Bound<'py, PyAny>,
    options: &str,
    pictures: BTreeMap<String, Bound<'py, PyAny>>,
) -> PyResult<Read<'py>> {
    let options = FitOptions::from_json(options).map_err(of_fit)?;
    let mut source: FitSource = Source::read(picture)?.into();
    for (name, picture) in pictures {
        let _ = source.pictures.insert(name, Source::read(&picture)?.into());
    }
    let read = pool::on(py, None, || read_picture(source, &options))?.map_err(of_prepare)?;
    let found = serde_json::to_value(&read.found).map_err(of_fit)?;
    Ok((json::to_python(py, &found)?, of_ink(py, &read.silhouette)?, drawn(py, &read)?))
}

fn drawn<'py>(py: Python<'py>, read: &PictureReading) -> PyResult<Bound<'py, PyArray3<u8>>> {
    let picture = read.annotated();
    let (width, height) = (picture.width(), picture.height());
    let colors =
        (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).flat_map(|(x, y)| picture.get(x, y));
    colors.collect::<Vec<u8>>().into_pyarray(py).reshape([height as usize, width as usize, 3])
}
