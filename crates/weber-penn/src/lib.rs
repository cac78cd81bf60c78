//! Weber and Penn's parametric trees as extended by Hewitt.
//!
//! Jason Weber and Joseph Penn, *Creation and rendering of realistic trees*, SIGGRAPH 1995; Charlie
//! Hewitt, *Procedural generation of tree models for use in computer graphics*, Cambridge 2017,
//! §3.2 and Appendix C. Where the two differ, or where the species were tuned for a behaviour of the
//! public Blender add-on, `PAPERS.md` lists which was followed and why.
//!
//! ```
//! let species = pleach_weber_penn::preset("quaking_aspen").unwrap();
//! let tree = species.grow(1).unwrap();
//! assert_eq!(tree.stems[0].level, 0);
//! assert!(tree.leaves.len() > 10_000);
//! ```
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]

mod adapt;
mod blame;
mod budget;
mod census;
mod certain;
mod children;
mod context;
mod course;
mod crown;
mod family;
mod generator;
mod grow;
mod leaf_batch;
mod leaf_fan;
mod leafless;
mod leaves;
mod model;
mod params;
mod parts;
mod path;
mod prune;
mod purpose;
mod radius;
mod solid;
mod spacing;
mod spread;
mod stem;
mod trunks;

pub use family::{HEWITT_2017, WeberPennFamily, preset};
pub use generator::WeberPenn;
pub use params::space;
pub use solid::{Solid, Surroundings};
