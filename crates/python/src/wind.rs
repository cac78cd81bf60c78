//! How wind moves the parts of a tree, as arrays.

use crate::arrays::{numbers, rows};
use crate::error::PleachError;
use glam::Vec3;
use numpy::{
    AllowTypeChange, PyArray1, PyArray2, PyArrayLike2, PyReadonlyArray1, PyReadonlyArray2,
    PyUntypedArrayMethods as _,
};
use pleach::wind::{Bodies, Breeze, moved};
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;

/// The numbers by which wind moves what they were made for: a row for each. A *body* is what turns as one: a limb, which grows
/// from a trunk, or a twig, which grows from a limb, with all that it carries. `docs/wind.md` has the formula.
#[pyclass(frozen, module = "pleach._native")]
pub(crate) struct Wind {
    rows: Vec<pleach::Wind>,
}

/// Numbers of rows.
#[derive(FromPyObject)]
enum Numbers<'py> {
    #[pyo3(transparent, annotation = "int64")]
    Signed(PyReadonlyArray1<'py, i64>),
    #[pyo3(transparent, annotation = "uint32")]
    Unsigned(PyReadonlyArray1<'py, u32>),
}

#[pymethods]
impl Wind {
    /// The point about which the row's own body turns, float32 of shape (rows, 3), metres, z up.
    #[getter]
    fn pivots(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f32>>> {
        rows(py, self.rows.iter().map(|row| row.pivot.to_array()))
    }

    /// Along the body, as long as the radians by which each metre of it turns in a fresh breeze, float32 of shape (rows, 3); 0
    /// for trunks, which lean.
    #[getter]
    fn bends(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f32>>> {
        rows(py, self.rows.iter().map(|row| row.bend.to_array()))
    }

    /// Of the body, in turns, 0 to less than 1, float32 of shape (rows,).
    #[getter]
    fn phases<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f32>> {
        numbers(py, self.rows.iter().map(|row| row.phase).collect())
    }

    /// As `pivots`, of the body that carries it.
    #[getter]
    fn parent_pivots(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f32>>> {
        rows(py, self.rows.iter().map(|row| row.parent_pivot.to_array()))
    }

    /// As `bends`, of the body that carries it.
    #[getter]
    fn parent_bends(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f32>>> {
        rows(py, self.rows.iter().map(|row| row.parent_bend.to_array()))
    }

    /// As `phases`, of the body that carries it.
    #[getter]
    fn parent_phases<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f32>> {
        numbers(py, self.rows.iter().map(|row| row.parent_phase).collect())
    }

    /// 0 for trunks, 1 for limbs, 2 for twigs and all that they carry, float32 of shape (rows,).
    #[getter]
    fn levels<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f32>> {
        numbers(py, self.rows.iter().map(|row| row.level).collect())
    }

    /// How far the row goes along its normal, metres, float32 of shape (rows,): 0 but for leaves and cards. Of a whole leaf it is
    /// that of its tip.
    #[getter]
    fn flutters<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f32>> {
        numbers(py, self.rows.iter().map(|row| row.flutter).collect())
    }

    /// These rows, by number, as often as they are named: `tree.wind().take(stem_of_knot)` are
    /// those of the knots. The numbers are of int64, or of uint32 as those of stems are.
    fn take(&self, numbers: Numbers<'_>) -> PyResult<Self> {
        let numbers: Vec<i64> = match &numbers {
            Numbers::Signed(numbers) => numbers.as_array().to_vec(),
            Numbers::Unsigned(numbers) => numbers.as_array().iter().map(|&number| number.into()).collect(),
        };
        let row = |number: &i64| {
            let found = usize::try_from(*number).ok().and_then(|number| self.rows.get(number)).copied();
            let words = || {
                format!("there is no row {number}, expected from 0 to {}", self.rows.len().saturating_sub(1))
            };
            found.ok_or_else(|| PyIndexError::new_err(words()))
        };
        Ok(Self { rows: numbers.iter().map(row).collect::<PyResult<_>>()? })
    }

    /// Where places that have these rows are in wind, float32 of shape (rows, 3), metres: `positions` is where they are at rest.
    ///
    /// `wind` is where it blows to, of length 1 in a fresh breeze, `time` is in seconds, and `height` is that of the tree. What
    /// flutters does so along `normals`, and nothing does without them.
    ///
    /// >>> import pleach
    /// >>> tree = pleach.species("acer").grow()
    /// >>> wind, height = tree.wind("leaves"), tree.bounds[1, 2]
    /// >>> moved = wind.moved(tree.leaf_positions, wind=(1, 0, 0), time=2.0, height=height)
    /// >>> moved.shape == tree.leaf_positions.shape
    /// True
    #[pyo3(signature = (positions, *, wind, time, height, normals = None))]
    fn moved(
        &self,
        py: Python<'_>,
        positions: PyArrayLike2<'_, f32, AllowTypeChange>,
        wind: [f32; 3],
        time: f32,
        height: f32,
        normals: Option<PyArrayLike2<'_, f32, AllowTypeChange>>,
    ) -> PyResult<Py<PyArray2<f32>>> {
        let positions = self.triples(&positions, "positions")?;
        let normals = match normals {
            Some(normals) => self.triples(&normals, "normals")?,
            None => vec![Vec3::ZERO; self.rows.len()],
        };
        let breeze = Breeze { wind: Vec3::from_array(wind), time, height };
        let places = self.rows.iter().zip(positions).zip(normals);
        let moved: Vec<[f32; 3]> = py.detach(|| {
            places.map(|((row, at), normal)| moved(at, normal, row, &breeze).to_array()).collect()
        });
        rows(py, moved.into_iter())
    }

    fn __len__(&self) -> usize {
        self.rows.len()
    }

    fn __repr__(&self) -> String {
        format!("<pleach.Wind of {} rows>", self.rows.len())
    }
}

impl Wind {
    pub(crate) const fn new(rows: Vec<pleach::Wind>) -> Self {
        Self { rows }
    }

    /// The rows of an array that has one for each of these.
    fn triples(&self, array: &PyReadonlyArray2<'_, f32>, name: &str) -> PyResult<Vec<Vec3>> {
        let (expected, found) = ([self.rows.len(), 3], array.shape());
        if found != expected {
            let words =
                format!("`{name}` has the shape {found:?}, expected {expected:?}: one row for each here");
            return Err(PleachError::new_err(words));
        }
        Ok(array.as_array().rows().into_iter().map(|row| Vec3::new(row[0], row[1], row[2])).collect())
    }
}

/// What a tree has one row for each of.
const PARTS: [&str; 4] = ["stems", "leaves", "blossoms", "blobs"];

/// The numbers of all stems, leaves, blossoms or surfaces of foliage of `tree`.
pub(crate) fn of_parts(py: Python<'_>, tree: &pleach::Tree, parts: &str) -> PyResult<Wind> {
    if !PARTS.contains(&parts) {
        let known = PARTS.join(", ");
        return Err(PleachError::new_err(format!("a tree has no `{parts}`, expected one of {known}")));
    }
    let rows = py.detach(|| {
        let bodies = Bodies::new(tree);
        let tips = |leaves: &[pleach::Leaf]| leaves.iter().map(|leaf| bodies.of_leaf(leaf, 1.0)).collect();
        match parts {
            "leaves" => tips(&tree.leaves),
            "blossoms" => tips(&tree.blossoms),
            "blobs" => tree.blobs.iter().map(|blob| bodies.of_stem(blob.stem as usize)).collect(),
            _ => (0..tree.stems.len()).map(|stem| bodies.of_stem(stem)).collect(),
        }
    });
    Ok(Wind::new(rows))
}
