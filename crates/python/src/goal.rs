//! Goals, as users give them.

use crate::arrays::{check_size, of_ink, to_ink};
use crate::error::{GoalError, of_goal};
use image::{DynamicImage, GrayImage, ImageFormat, RgbImage, RgbaImage};
use numpy::{PyArrayDyn, PyArrayMethods as _, PyReadonlyArray2, PyUntypedArray, PyUntypedArrayMethods as _};
use pleach::{Bitmap, Encoded, Goal, GoalOptions, PictureSource};
use pyo3::exceptions::{PyFileNotFoundError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::io::Cursor;
use std::path::PathBuf;

/// A picture before it is a goal.
pub(crate) enum Source {
    /// Of a file, or of numbers: read as a file is.
    Picture(Encoded),
    /// What is tree is said pixel by pixel.
    Ink(Bitmap),
}

impl Source {
    /// A path, the bytes of a file, or an array: of bool, or of `uint8` with one, three or four channels.
    pub(crate) fn read(goal: &Bound<'_, PyAny>) -> PyResult<Self> {
        if let Ok(bytes) = goal.extract::<Vec<u8>>()
            && goal.is_instance_of::<PyBytes>()
        {
            return Ok(Self::Picture(Encoded::new("goal", bytes)));
        }
        if let Ok(array) = goal.cast::<PyUntypedArray>() {
            return of_array(array);
        }
        let Ok(path) = goal.extract::<PathBuf>() else {
            return Err(PyTypeError::new_err(format!(
                "a goal is a path, an array, a PIL image or an open file, not {}",
                goal.get_type().name()?
            )));
        };
        if !path.exists() {
            return Err(PyFileNotFoundError::new_err(format!("there is no file {}", path.display())));
        }
        Ok(Self::Picture(Encoded::load(path).map_err(of_goal)?))
    }

    /// The same as an object that [`Source::read`] takes.
    pub(crate) fn given<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(match self {
            Self::Picture(encoded) => PyBytes::new(py, encoded.bytes()).into_any(),
            Self::Ink(ink) => of_ink(py, ink)?.into_any(),
        })
    }

    /// The goal.
    pub(crate) fn goal(&self, options: &GoalOptions) -> PyResult<Goal> {
        match self {
            Self::Picture(encoded) => Goal::from_encoded(encoded, options),
            Self::Ink(ink) => Goal::from_ink(ink.clone(), options),
        }
        .map_err(of_goal)
    }
}

impl From<Source> for PictureSource {
    fn from(source: Source) -> Self {
        match source {
            Source::Picture(encoded) => encoded.into(),
            Source::Ink(ink) => ink.into(),
        }
    }
}

fn of_array(array: &Bound<'_, PyUntypedArray>) -> PyResult<Source> {
    if let Ok(ink) = array.extract::<PyReadonlyArray2<'_, bool>>() {
        return Ok(Source::Ink(to_ink(&ink)?));
    }
    let wrong = || {
        let (shape, dtype) = (array.shape(), array.dtype());
        GoalError::new_err(format!(
            "the array is {dtype} of shape {shape:?}, expected bool of (height, width), True where the tree is, or \
             uint8 of (height, width), (height, width, 3) or (height, width, 4); `array > 0.5` makes bool of floats"
        ))
    };
    let tones = array.cast::<PyArrayDyn<u8>>().map_err(|_| wrong())?;
    let channels = match *tones.shape() {
        [_, _] => 1,
        [_, _, channels @ (3 | 4)] => channels,
        _ => return Err(wrong()),
    };
    check_size(tones.shape())?;
    let (height, width) = (tones.shape()[0] as u32, tones.shape()[1] as u32);
    // In rows, however the array lies in memory.
    let bytes: Vec<u8> = tones.readonly().as_array().iter().copied().collect();
    let picture = match channels {
        1 => GrayImage::from_raw(width, height, bytes).map(DynamicImage::from),
        3 => RgbImage::from_raw(width, height, bytes).map(DynamicImage::from),
        _ => RgbaImage::from_raw(width, height, bytes).map(DynamicImage::from),
    };
    let mut png = Cursor::new(Vec::new());
    picture.ok_or_else(wrong)?.write_to(&mut png, ImageFormat::Png).map_err(of_goal)?;
    Ok(Source::Picture(Encoded::new("goal", png.into_inner())))
}
