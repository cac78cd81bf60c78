//! The axes of stems as a graph.

use crate::arrays::{self, column, triples};
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyImportError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The axes of the stems of a tree above the ground: nodes with parents. A branch starts on the axis of its parent, in a node of
/// its own at the same place as one of the parent's. Metres, z up.
#[pyclass(frozen, module = "pleach._native")]
pub(crate) struct Skeleton {
    pub(crate) inner: pleach::Skeleton,
}

#[pymethods]
impl Skeleton {
    /// Where each node is, float64 of shape (nodes, 3), metres; a view, read-only.
    #[getter]
    fn positions<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray2<f64>> {
        triples(slf.as_any(), &slf.get().inner.nodes, |node| node.position.as_ref())
    }

    /// Radius of the stem at each node, float64 of shape (nodes,), metres; a view, read-only.
    #[getter]
    fn radii<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray1<f64>> {
        column(slf.as_any(), &slf.get().inner.nodes, |node| &node.radius)
    }

    /// The node below each, −1 for the feet of trunks, int64 of shape (nodes,); parents come before their children.
    #[getter]
    fn parents<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        let parent = |node: &pleach::SkeletonNode| node.parent.map_or(-1, i64::from);
        arrays::numbers(py, self.inner.nodes.iter().map(parent).collect())
    }

    /// The stem of each node, in the tree's order, uint32 of shape (nodes,); a view, read-only.
    #[getter]
    fn stems<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray1<u32>> {
        column(slf.as_any(), &slf.get().inner.nodes, |node| &node.stem)
    }

    /// The level of each node's stem, 0 for trunks, uint16 of shape (nodes,); a view, read-only.
    #[getter]
    fn levels<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray1<u16>> {
        column(slf.as_any(), &slf.get().inner.nodes, |node| &node.level)
    }

    /// Length of all stems, metres.
    #[getter]
    fn length(&self) -> f64 {
        self.inner.length()
    }

    /// Volume of all stems, cubic metres.
    #[getter]
    fn volume(&self) -> f64 {
        self.inner.volume()
    }

    /// The graph as a `networkx.DiGraph`, from the feet of trunks to the tips. Nodes are numbers, with `position` (a tuple),
    /// `radius`, `stem` and `level`; edges have their `length`, which is 0 where a branch starts. `networkx` has to be
    /// installed.
    fn to_networkx<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let networkx = py.import("networkx").map_err(|_| {
            PyImportError::new_err("networkx is not installed, expected it: `pip install networkx`")
        })?;
        let graph = networkx.call_method0("DiGraph")?;
        let nodes = &self.inner.nodes;
        for (i, node) in nodes.iter().enumerate() {
            let facts = PyDict::new(py);
            facts.set_item("position", (node.position.x, node.position.y, node.position.z))?;
            facts.set_item("radius", node.radius)?;
            facts.set_item("stem", node.stem)?;
            facts.set_item("level", node.level)?;
            graph.call_method("add_node", (i,), Some(&facts))?;
            if let Some(below) = node.parent {
                let facts = PyDict::new(py);
                facts.set_item("length", node.position.distance(nodes[below as usize].position))?;
                graph.call_method("add_edge", (below, i), Some(&facts))?;
            }
        }
        Ok(graph)
    }

    fn __len__(&self) -> usize {
        self.inner.nodes.len()
    }

    fn __repr__(&self) -> String {
        format!("<pleach.Skeleton: {} nodes, {:.1} m>", self.inner.nodes.len(), self.inner.length())
    }
}
