//! From a grown tree to a mesh file, described once.
//!
//! [`Export`] says what a file is to hold: levels of detail, how leaves are drawn, a season, wind. It is plain values,
//! read from and written to JSON, and [`Export::check`] says what is wrong with them for a format.
//! [`Export::write`] streams one tree, [`Export::meshes`] keeps one in memory, [`Export::write_forest`] many. `pleach grow`, the Python package and the page
//! in the browser are made of these, so that the same options give the same bytes in each.

mod arrays;
mod extras;
mod forest;
mod forms;
mod options;
mod pivots;
mod tree;
mod usual;

pub use arrays::ExportedMeshes;
pub use forest::Forest;
pub use forms::{Compression, LeafForm};
pub use options::Export;
pub use tree::{Beside, ExportedFile, Written};

use crate::option_error::OptionError;
use pleach_mesh::MeshError;
use pleach_mesh::forest::ForestError;
use pleach_mesh::lod::TooFew;
use pleach_mesh::pivots::TooManyTrunks;
use pleach_mesh::weld::WeldError;
use pleach_tree::GrowError;

/// Why a file cannot be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExportError {
    /// An option that cannot be, or that the format cannot hold.
    #[error(transparent)]
    Option(#[from] OptionError),
    /// The stems cannot be welded.
    #[error(transparent)]
    Weld(#[from] WeldError),
    /// The tree does not fit into so few triangles.
    #[error(transparent)]
    Budget(#[from] TooFew),
    /// The tree has more parts that move than textures of pivots hold.
    #[error(transparent)]
    Pivots(#[from] TooManyTrunks),
    /// The mesh cannot be written.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A picture of leaves or of the tree cannot be written.
    #[error("a picture of the tree cannot be written: {0}")]
    Picture(#[source] std::io::Error),
    /// The forest cannot be planted.
    #[error(transparent)]
    Forest(#[from] ForestError),
    /// A tree of the forest does not grow.
    #[error("{species} does not grow from seed {seed}")]
    Grow {
        /// The species.
        species: String,
        /// The seed.
        seed: u64,
        /// Why not.
        source: GrowError,
    },
}
