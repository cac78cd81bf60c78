//! Numpy arrays: pictures of ink, and views of a tree's memory.

use crate::error::GoalError;
use numpy::ndarray::{ArrayView1, ArrayView2, Axis, ShapeBuilder as _};
use numpy::{Element, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, ToPyArray as _};
use numpy::{IntoPyArray as _, PyUntypedArrayMethods as _};
use pleach::{Bitmap, GoalOptions};
use pyo3::prelude::*;

/// Ink as an array of bool, a row for each row of pixels.
pub(crate) fn of_ink<'py>(py: Python<'py>, ink: &Bitmap) -> PyResult<Bound<'py, PyArray2<bool>>> {
    let (width, height) = (ink.width() as usize, ink.height() as usize);
    let pixels: Vec<bool> =
        (0..ink.height()).flat_map(|y| (0..ink.width()).map(move |x| ink.get(x, y))).collect();
    pixels.into_pyarray(py).reshape([height, width])
}

/// Largest side of an array that is a picture: that of a file.
const MAX_SIDE: usize = 8192;
/// Smallest side.
const MIN_SIDE: usize = 8;

/// Tells whether an array of this shape can be a goal, before it is looked at.
pub(crate) fn check_size(shape: &[usize]) -> PyResult<()> {
    let (height, width) = (shape[0], shape[1]);
    if height.min(width) < MIN_SIDE || height.max(width) > MAX_SIDE {
        return Err(GoalError::new_err(format!(
            "the array has {height} × {width} pixels, expected from {MIN_SIDE} to {MAX_SIDE} a side"
        )));
    }
    Ok(())
}

/// An array of bool as ink.
pub(crate) fn to_ink(array: &PyReadonlyArray2<'_, bool>) -> PyResult<Bitmap> {
    check_size(array.shape())?;
    let pixels = array.as_array();
    Ok(Bitmap::from_fn(pixels.ncols() as u32, pixels.nrows() as u32, |x, y| pixels[[y as usize, x as usize]]))
}

/// What a picture of ink is read with at full size.
pub(crate) fn whole() -> GoalOptions {
    GoalOptions::default()
}

/// One number of each item of `items`, which `owner` keeps as they are: no copy, and read-only.
#[allow(
    unsafe_code,
    reason = "the array shows memory of `owner`, which it keeps alive and which never changes"
)]
pub(crate) fn column<'py, I, T: Element>(
    owner: &Bound<'py, PyAny>,
    items: &[I],
    number: impl Fn(&I) -> &T,
) -> Bound<'py, PyArray1<T>> {
    let py = owner.py();
    let Some(first) = items.first() else { return PyArray1::zeros(py, 0, false) };
    let shape = [items.len()];
    // SAFETY: one number of every item, at the same place in each; `items` is one allocation of a frozen class.
    let view = unsafe {
        let strides = [stride::<I, T>()];
        ArrayView1::from_shape_ptr(shape.strides(strides), std::ptr::from_ref(number(first)))
    };
    // SAFETY: `owner` holds `items`, is frozen, and lives as long as the array does.
    let array = unsafe { PyArray1::borrow_from_array(&view, owner.clone()) };
    array.readwrite().make_nonwriteable();
    array
}

/// Three numbers of each item of `items`, side by side, as [`column`] shows one.
#[allow(unsafe_code, reason = "as in `column`")]
pub(crate) fn triples<'py, I, T: Element>(
    owner: &Bound<'py, PyAny>,
    items: &[I],
    numbers: impl Fn(&I) -> &[T; 3],
) -> Bound<'py, PyArray2<T>> {
    let py = owner.py();
    let Some(first) = items.first() else { return PyArray2::zeros(py, [0, 3], false) };
    // SAFETY: as in `column`; the three numbers of an item follow each other.
    let view = unsafe {
        let strides = [stride::<I, T>(), 1];
        ArrayView2::from_shape_ptr([items.len(), 3].strides(strides), numbers(first).as_ptr())
    };
    debug_assert_eq!(view.len_of(Axis(1)), 3);
    // SAFETY: as in `column`.
    let array = unsafe { PyArray2::borrow_from_array(&view, owner.clone()) };
    array.readwrite().make_nonwriteable();
    array
}

/// From one item to the next, in numbers.
const fn stride<I, T>() -> usize {
    assert!(size_of::<I>().is_multiple_of(size_of::<T>()), "numbers of an item lie at whole steps");
    size_of::<I>() / size_of::<T>()
}

/// Numbers that were computed, given away.
pub(crate) fn numbers<T: Element>(py: Python<'_>, numbers: Vec<T>) -> Bound<'_, PyArray1<T>> {
    numbers.into_pyarray(py)
}

/// A copy of `numbers`.
pub(crate) fn copied<'py, T: Element + Copy>(py: Python<'py>, numbers: &[T]) -> Bound<'py, PyArray1<T>> {
    numbers.to_pyarray(py)
}

/// An array of rows of numbers.
pub(crate) fn rows<T: Element + Copy, const N: usize>(
    py: Python<'_>,
    rows: impl ExactSizeIterator<Item = [T; N]>,
) -> PyResult<Py<PyArray2<T>>> {
    let shape = [rows.len(), N];
    let numbers: Vec<T> = rows.flatten().collect();
    Ok(numbers.into_pyarray(py).reshape(shape)?.unbind())
}
