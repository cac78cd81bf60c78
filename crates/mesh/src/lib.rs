//! Trees as triangles.
//!
//! ```
//! use pleach_mesh::{Mesh, MeshSettings, Palette, write};
//!
//! let species = pleach_generators::species("acer")?;
//! let tree = species.grow(1)?;
//! let mesh = Mesh::new(&tree, MeshSettings::with_tolerance(0.01));
//! println!("{} triangles", mesh.triangles());
//! let mut file = std::io::Cursor::new(Vec::new());
//! write::glb::write(&mut file, "acer", &tree, &Palette::new(&species.appearance, None))?;
//! assert!(mesh.triangles() > 1_000 && file.into_inner().starts_with(b"glTF"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//! | module | idea |
//! | --- | --- |
//! | [`settings`] | how fine a mesh should be |
//! | [`mesher`] | from a [`pleach_plant::Tree`] to blocks of triangles, sizes known beforehand |
//! | [`part`] | materials, and the traits of what triangles come from and go to |
//! | [`stream`] | from the one to the other, block by block |
//! | [`block`] | corners and triangles |
//! | [`lod`] | levels of detail |
//! | [`atlas`] | leaves that differ from each other, and where their pictures are |
//! | [`twigs`] | cards that show pictures of twigs |
//! | [`card`] | the last level: cards with pictures of the tree |
//! | [`forest`] | where many trees stand |
//! | [`mod@write`] | GLB, OBJ, PLY, STL, USDA |
//! | [`palette`] | colours of species and seasons |
//! | [`Pictures`] | pictures that materials show instead |
//! | [`weld`] | all stems as one watertight surface |
//! | [`wind`], [`rig`] | how stems sway |
//! | [`growth`] | when each vertex comes to be |
//! | [`pivots`] | what turns about which point, as textures for Unreal |
//!
//! # Invariants
//!
//! A mesh is a function of the tree and the settings: meshing draws no random numbers (planting a
//! forest does, by address), nothing here reads the clock or prints, and the number of threads changes
//! nothing. A mesher knows trees, not generators.
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]

pub mod atlas;
mod blobs;
pub mod block;
pub mod card;
mod collision;
mod decimate;
mod foliage;
pub mod forest;
pub mod growth;
pub mod lod;
pub mod mesh;
pub mod mesher;
mod nearest;
pub mod palette;
pub mod part;
mod pictures;
pub mod pivots;
mod placed;
pub mod rig;
pub mod settings;
pub mod stream;
mod tangents;
mod tube;
pub mod twigs;
pub mod weld;
mod welded;
pub mod wind;
pub mod write;

pub use atlas::Atlas;
pub use blobs::{TILE as BLOB_TILE, have_tiles as blobs_have_tiles};
pub use block::{Block, Emergence, Placement, Vertex, Wind};
pub use card::{Card, Cards};
pub use collision::{Collision, Prism};
pub use foliage::blossom_spread;
pub use mesh::Mesh;
pub use mesher::Mesher;
pub use palette::Palette;
pub use part::{Count, Material, MeshError, Part, Sink, Source};
pub use pictures::Pictures;
pub use pivots::Pivots;
pub use rig::Rig;
pub use settings::{LeafStyle, MeshSettings};
pub use stream::send;
pub use tangents::tangents;
pub use tube::TILE as BARK_TILE;
pub use twigs::{TwigModel, Twigs};
pub use welded::Welded;
