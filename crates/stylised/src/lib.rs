//! Stylised trees: a skeleton of few vertices, each with a radius, and foliage as closed blobs.
//!
//! The model is that of Lorite (2021, *Procedural tree mesh generator plugin for Blender*): up to
//! sixteen roots, one to four trunks, up to twelve branches per trunk, and at the branches' ends blobs
//! of one to five joined spheres. The report gives little of it as formulas; what had to be decided is
//! said where it is decided.
//!
//! ```
//! use pleach_stylised::StylisedFamily;
//!
//! let species = pleach_tree::species::preset(&StylisedFamily, "stylised_oak").unwrap();
//! let tree = species.grow(1)?;
//! assert!(!tree.stems.is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//! | module | idea |
//! | --- | --- |
//! | `params` | the declarations: the report's seventeen sliders and six numbers of ours |
//! | `skeleton` | trunks, roots and branches as chains of vertices with radii |
//! | `foliage` | where blobs, cones and fronds grow, and what they are made of |
//! | `surface` | a smooth union of ellipsoids as one closed mesh |
//! | `generator` | from numbers and a seed to a tree |
//!
//! Inside, lengths are in units of the report's sliders; the parameter `scale` makes metres of them
//! where the tree is written.
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]

mod draws;
mod family;
mod foliage;
mod generator;
mod params;
mod skeleton;
mod surface;
mod write;

pub use family::StylisedFamily;
