//! Declared parameters, from Python's values and to them.

use crate::error::{SpeciesError, of_species};
use crate::json;
use pleach::param::{Kind, Shape, nearest};
use pleach::{ParamSpace, Slot};
use pyo3::IntoPyObjectExt as _;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString, PyTuple};

/// The number of the parameter called `name`.
pub(crate) fn find(space: &ParamSpace, name: &str) -> PyResult<usize> {
    space.find(name).map(|(number, _)| number).ok_or_else(|| {
        let names = space.params().iter().map(|param| param.name.as_ref());
        let near = nearest(name, names).map_or_else(String::new, |near| format!(", did you mean `{near}`?"));
        SpeciesError::new_err(format!("there is no parameter `{name}`{near}"))
    })
}

/// The number of the parameter called `name`, and of its numbers the one that is, such as `length[1]`, if it is one.
pub(crate) fn find_slot(space: &ParamSpace, name: &str) -> PyResult<(usize, Option<Slot>)> {
    match space.slots().find(|&slot| space.slot_name(slot) == name) {
        Some(slot) => Ok((space.info(slot).param, Some(slot))),
        None => find(space, name).map(|number| (number, None)),
    }
}

/// What `value` is in `slot`: the name of a choice, a whole number, or a number.
pub(crate) fn of_slot<'py>(
    py: Python<'py>,
    space: &ParamSpace,
    slot: Slot,
    value: f64,
) -> PyResult<Bound<'py, PyAny>> {
    match space.kind_of(slot) {
        Kind::Choice { first, names } => {
            names[(value as i64 - first) as usize].as_ref().into_bound_py_any(py)
        }
        Kind::Integer { .. } | Kind::FlaggedInteger { .. } => (value as i64).into_bound_py_any(py),
        Kind::Real { .. } | Kind::Flagged { .. } => value.into_bound_py_any(py),
    }
}

/// What `values`, one for every slot of `space`, say of parameter number `number`: one value, or a tuple.
pub(crate) fn get<'py>(
    py: Python<'py>,
    space: &ParamSpace,
    values: &[f64],
    number: usize,
) -> PyResult<Bound<'py, PyAny>> {
    let of = |slot: Slot| of_slot(py, space, slot, values[slot.index()]);
    let mut all = space.slots_of(number).map(of);
    if space.params()[number].shape == Shape::Scalar {
        return all.next().ok_or_else(|| SpeciesError::new_err("a parameter has a value"))?;
    }
    Ok(PyTuple::new(py, all.collect::<PyResult<Vec<_>>>()?)?.into_any())
}

/// Puts what `key`, a parameter or one number of it such as `length[1]`, is to be into `values`.
pub(crate) fn set(
    space: &ParamSpace,
    values: &mut [f64],
    key: &str,
    value: &Bound<'_, PyAny>,
) -> PyResult<()> {
    if let Some(slot) = space.slots().find(|&slot| space.slot_name(slot) == key) {
        values[slot.index()] = read(space, slot, value)?;
        return Ok(());
    }
    let slots = space.slots_of(find(space, key)?);
    let numbers: Vec<Bound<'_, PyAny>> = if value.is_instance_of::<PyString>() {
        Vec::new()
    } else {
        value.try_iter().and_then(Iterator::collect).unwrap_or_default()
    };
    if numbers.len() != slots.len() {
        let found = if numbers.is_empty() { "one value".to_owned() } else { format!("{}", numbers.len()) };
        return Err(SpeciesError::new_err(format!("`{key}` has {} numbers, not {found}", slots.len())));
    }
    for (slot, number) in slots.zip(&numbers) {
        values[slot.index()] = read(space, slot, number)?;
    }
    Ok(())
}

fn read(space: &ParamSpace, slot: Slot, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    let name = space.slot_name(slot);
    let number = match (value.extract::<String>(), space.kind_of(slot)) {
        (Ok(text), Kind::Choice { first, names }) => {
            let place = names.iter().position(|known| *known == text);
            place.map(|place| (*first + place as i64) as f64).ok_or_else(|| {
                SpeciesError::new_err(format!("`{name}` is {text:?}, expected {}", names.join(" or ")))
            })?
        }
        _ => value.extract::<f64>().map_err(|_| {
            let given = value.repr().map_or_else(|_| "?".to_owned(), |given| given.to_string());
            SpeciesError::new_err(format!("`{name}` is {given}, expected a number"))
        })?,
    };
    space.check_slot(slot, number).map_err(|problem| of_species(format!("`{name}` {problem}")))?;
    Ok(number)
}

/// What is declared about every parameter, by name.
pub(crate) fn all_declared<'py>(py: Python<'py>, space: &ParamSpace) -> PyResult<Bound<'py, PyAny>> {
    let declared = (0..space.params().len()).map(|number| serde_json::to_value(space.declared(number)));
    let declared: Vec<serde_json::Value> = declared.collect::<Result<_, _>>().map_err(of_species)?;
    let all = PyDict::new(py);
    for (param, one) in space.params().iter().zip(json::to_python(py, &declared.into())?.try_iter()?) {
        all.set_item(param.name.as_ref(), one?)?;
    }
    Ok(all.into_any())
}

/// What is declared about parameter number `number`, or about `one` of its numbers.
pub(crate) fn declared<'py>(
    py: Python<'py>,
    space: &ParamSpace,
    number: usize,
    one: Option<Slot>,
) -> PyResult<Bound<'py, PyAny>> {
    let declared = one.map_or_else(|| space.declared(number), |slot| space.declared_number(slot));
    let value = serde_json::to_value(declared).map_err(|error| SpeciesError::new_err(error.to_string()))?;
    json::to_python(py, &value)
}
