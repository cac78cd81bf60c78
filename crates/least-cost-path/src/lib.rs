//! Trees from least-cost paths through random graphs, after Xu and Mould 2012, *A procedural method
//! for irregular tree models*, Computers & Graphics 36.
//!
//! Nodes are thrown into a volume, none too near to another (`graph`), and linked to the nearest in
//! each sector around them (a Yao graph). Edges have random weights. From some nodes, the endpoints,
//! the paths of least weight to the root become branches, and around each endpoint a smaller graph
//! grows the next ones.
//!
//! ```
//! use pleach_least_cost_path::LeastCostPathFamily;
//!
//! let species = pleach_tree::species::preset(&LeastCostPathFamily, "fan_elm").unwrap();
//! let tree = species.grow(1)?;
//! assert!(!tree.stems.is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//! | module | idea |
//! | --- | --- |
//! | `numbers` | every parameter, declared once |
//! | `structure` | what a species file says beside numbers: drawn outlines, parts of volumes |
//! | `volume` | solids and their unions |
//! | `graph` | one graph: nodes, links, weights, paths |
//! | `levels` | graphs around the endpoints of graphs |
//! | `life`, `direction` | how long branches live, what light does, where they point |
//! | `sketch` | a species that follows the outline of a tree in pictures |
//! | `skeleton`, `thickness`, `stems`, `leaves` | from paths to a tree |
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]

mod budget;
mod direction;
mod family;
mod generator;
mod graph;
mod leaves;
mod levels;
mod life;
mod numbers;
mod purpose;
mod skeleton;
mod sketch;
mod stems;
mod structure;
mod thickness;
mod volume;

pub use family::LeastCostPathFamily;
pub use generator::LeastCostPath;
pub use graph::Work;
pub use sketch::{SideView, species_around};
