//! Shapes of leaves and blossoms, and where stems stand on their parents.

use crate::arrays::rows;
use numpy::PyArray2;
use pyo3::prelude::*;

/// An outline: its name and its corners.
pub(crate) type Outline = (String, Py<PyArray2<f32>>);
/// A blossom: its name, its corners, and the corner numbers of its faces.
pub(crate) type Blossom = (&'static str, Py<PyArray2<f32>>, Vec<Vec<u32>>);

/// The outlines of the leaves of `tree`.
pub(crate) fn outlines(py: Python<'_>, tree: &pleach::Tree) -> PyResult<Vec<Outline>> {
    let outline = |shape: &std::sync::Arc<pleach::Outline>| {
        Ok((shape.name().to_owned(), rows(py, shape.corners().iter().copied())?))
    };
    tree.leaf_shapes.iter().map(outline).collect()
}

/// The faces of the blossoms of `tree`.
pub(crate) fn blossoms(py: Python<'_>, tree: &pleach::Tree) -> PyResult<Vec<Blossom>> {
    let blossom = |shape: &pleach::BlossomShape| {
        let faces = shape.faces();
        let polygons =
            faces.polygons.iter().map(|polygon| polygon.iter().map(|&i| u32::from(i)).collect()).collect();
        Ok((shape.name(), rows(py, faces.vertices.iter().copied())?, polygons))
    };
    tree.blossom_shapes.iter().map(blossom).collect()
}

/// The triangles of all blobs, by numbers of vertices of the tree.
pub(crate) fn blob_triangles(py: Python<'_>, tree: &pleach::Tree) -> PyResult<Py<PyArray2<u32>>> {
    let of_blob = |blob: &pleach::Blob| {
        let first = blob.first_vertex;
        tree.blob_triangles[blob.triangles()].iter().map(move |triangle| triangle.map(|i| first + i))
    };
    let triangles: Vec<[u32; 3]> = tree.blobs.iter().flat_map(of_blob).collect();
    rows(py, triangles.into_iter())
}

/// Of each stem, where on its parent's spline it stands, as by [`pleach::Tree::place_of`]; NaN without a parent.
pub(crate) fn places(tree: &pleach::Tree) -> Vec<f64> {
    tree.stems.iter().map(|stem| tree.place_of(stem).unwrap_or(f64::NAN)).collect()
}
