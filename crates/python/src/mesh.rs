//! Meshes as arrays.

use crate::arrays::rows;
use crate::error::of_export;
use crate::wind::Wind;
use crate::{json, pool};
use numpy::PyArray2;
use pleach::{Export, Pictures, tangents};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

/// What of a mesh is of one material.
#[pyclass(frozen, get_all, module = "pleach._native")]
pub(crate) struct MeshPart {
    /// Corners, float32 of shape (corners, 3), metres, z up.
    positions: Py<PyArray2<f32>>,
    /// Directions outwards, float32 of shape (corners, 3), of length 1.
    normals: Py<PyArray2<f32>>,
    /// Texture coordinates, float32 of shape (corners, 2): u to the right, v from the top of a picture to its bottom, as in
    /// glTF. Those of bark count tiles.
    uvs: Py<PyArray2<f32>>,
    /// Directions in which u grows, float32 of shape (corners, 4): three numbers of length 1, then 1, or −1 where the
    /// picture is mirrored.
    tangents: Py<PyArray2<f32>>,
    /// Corner numbers, uint32 of shape (triangles, 3), counter-clockwise from outside.
    triangles: Py<PyArray2<u32>>,
    /// How wind moves each corner, if that was asked for with `wind=True`; `None` otherwise, and of cards that show the whole
    /// tree.
    wind: Option<Py<Wind>>,
    /// When each corner comes to be in a tree that grows, and from where, float32 of shape (corners, 4), if that was asked
    /// for with `growth=True`: a time from 0 to 0.9, then the way from the corner back to the place that it comes from, in
    /// metres. `None` otherwise, and of cards that show the whole tree.
    growth: Option<Py<PyArray2<f32>>>,
}

#[pymethods]
impl MeshPart {
    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let count = |array: &Bound<'_, PyAny>| array.len();
        let (corners, triangles) =
            (count(self.positions.bind(py).as_any())?, count(self.triangles.bind(py).as_any())?);
        Ok(format!("<pleach.MeshPart: {corners} corners, {triangles} triangles>"))
    }
}

/// The meshes of a tree: a dict of parts by material for each level of detail, and the pictures that materials show.
#[pyclass(frozen, get_all, module = "pleach._native")]
pub(crate) struct Mesh {
    /// For each level, from fine to coarse, its parts by the name of their material: `bark`, `leaves`, `blossom`, `twigs`
    /// or `card`. Those without a triangle are left out.
    levels: Vec<Py<PyDict>>,
    /// By material, PNG files by what they show: `color`, and of bark also `normal`, `roughness` (occlusion in red,
    /// roughness in green). Pictures of bark repeat.
    pictures: Py<PyDict>,
}

#[pymethods]
impl Mesh {
    fn __repr__(&self) -> String {
        format!("<pleach.Mesh of {} levels>", self.levels.len())
    }
}

/// The mesh of `tree` with these options of an export.
pub(crate) fn of_tree(
    py: Python<'_>,
    species: &pleach::Species,
    tree: &pleach::Tree,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Mesh> {
    let export = Export::from_json(&json::from_dict(options)?).map_err(of_export)?;
    let made = pool::on(py, None, || {
        let made = export.meshes(species, tree)?;
        let numbers = |mesh: &pleach::Mesh| mesh.parts.iter().map(|(_, block)| tangents(block, 0)).collect();
        let tangents: Vec<Vec<_>> = made.levels.iter().map(numbers).collect();
        Ok::<_, pleach::ExportError>((made, tangents))
    })?;
    let (made, tangents) = made.map_err(of_export)?;
    let mut levels = Vec::with_capacity(made.levels.len());
    for (mesh, tangents) in made.levels.into_iter().zip(tangents) {
        let parts = PyDict::new(py);
        for ((part, block), tangents) in mesh.parts.into_iter().zip(tangents) {
            let vertices = &block.vertices;
            let wind = (!block.wind.is_empty()).then(|| Py::new(py, Wind::new(block.wind))).transpose()?;
            let numbers = || rows(py, block.growth.iter().map(pleach::Emergence::to_array));
            let growth = (!block.growth.is_empty()).then(numbers).transpose()?;
            let part_of = MeshPart {
                positions: rows(py, vertices.iter().map(|vertex| vertex.position.to_array()))?,
                normals: rows(py, vertices.iter().map(|vertex| vertex.normal.to_array()))?,
                uvs: rows(py, vertices.iter().map(|vertex| vertex.uv.to_array()))?,
                tangents: rows(py, tangents.into_iter())?,
                triangles: rows(py, block.triangles.iter().copied())?,
                wind,
                growth,
            };
            parts.set_item(part.material.name(), Py::new(py, part_of)?)?;
        }
        levels.push(parts.unbind());
    }
    Ok(Mesh { levels, pictures: pictures(py, made.pictures)?.unbind() })
}

/// PNG files by material and by what they show.
fn pictures(py: Python<'_>, all: Vec<Pictures<Vec<u8>>>) -> PyResult<Bound<'_, PyDict>> {
    let by_material = PyDict::new(py);
    for pictures in all {
        let files = PyDict::new(py);
        for (what, png) in pictures.all() {
            files.set_item(what, PyBytes::new(py, png))?;
        }
        by_material.set_item(pictures.material.name(), files)?;
    }
    Ok(by_material)
}
