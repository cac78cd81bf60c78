//! A smooth union of ellipsoids as one closed mesh.
//!
//! The report joined icospheres by a Boolean modifier and remeshed the result, which fails where faces
//! coincide. A distance field has no such cases: it is sampled on a small grid (`grid`), the inside is
//! made one piece that touches itself nowhere at a corner or an edge only, and its surface is meshed
//! with one vertex per cell (`nets`). So every edge has two faces, whatever the ellipsoids are.

mod ellipsoid;
mod grid;
mod nets;

pub(crate) use ellipsoid::{Ellipsoid, Union};
pub(crate) use grid::Grid;
pub(crate) use nets::Mesh;
