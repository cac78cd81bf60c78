//! The plant model that every part of pleach shares: what a plant *is*, whatever grew it.
//!
//! A [`Tree`] is stems as cubic Bézier splines with radii, and leaves and blossoms as small oriented shapes.
//! Renderers, meshers and scorers read it and know nothing of generators and their files, which are the
//! business of `pleach-tree`.
//!
//! ```
//! use pleach_plant::glam::DVec3;
//! use pleach_plant::{Knot, Stem, StemKind, Tree};
//!
//! let knot = |z: f64, radius| {
//!     let point = DVec3::new(0.0, 0.0, z);
//!     Knot { point, handle_in: point - DVec3::Z, handle_out: point + DVec3::Z, radius }
//! };
//! let trunk = Stem {
//!     parent: None,
//!     level: 0,
//!     kind: StemKind::Trunk,
//!     number: 0,
//!     offset: 0.0,
//!     first_knot: 0,
//!     knot_count: 2,
//! };
//! let pole = Tree { stems: vec![trunk], knots: vec![knot(0.0, 0.1), knot(3.0, 0.0)], ..Tree::default() };
//! pole.well_formed().unwrap();
//! assert!((pole.length_of(&pole.stems[0]) - 3.0).abs() < 0.01);
//! ```
//!
//! | module or type | idea |
//! | --- | --- |
//! | [`Tree`], [`Stem`], [`Knot`], [`Leaf`], [`Blob`] | flat arrays, metres, z up, right-handed |
//! | [`leaf_shape`] | outlines of ten leaves and faces of three blossoms |
//! | [`push_leaflets`] | compound leaves |
//! | [`Appearance`], [`Color`], [`Season`] | colours and season |
//! | [`spline`] | one cubic Bézier piece: evaluate, differentiate, flatten by tolerance |
//! | [`turtle`] | a position with two axes that walks and turns |
//! | [`math`] | powers, logarithms and the like, the same bits everywhere |
//! | [`trig`] | fast sine, cosine and arc tangent, the same bits everywhere |
//! | [`random`] | draws that are a function of an address, never of the draws before |
//! | [`StemPath`], [`Draw`], [`Individual`] | one particular tree: stems with draws of their own |
//! | [`TreeStats`] | measurements of a tree, with fixed names |
//! | [`Dendrometry`] | height, crown and stem diameter, as foresters measure them |
//!
//! # Invariants
//!
//! Nothing here reads the clock, the environment or the operating system's randomness, and nothing
//! here prints or reads files. Angles are in radians inside and in degrees in files; the name says which where
//! both occur.
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]

mod appearance;
mod dendrometry;
mod fnv;
mod helpers;
mod individual;
pub mod leaf_shape;
mod leaflets;
pub mod math;
pub mod random;
pub mod spline;
mod stats;
mod tree;
pub mod trig;
pub mod turtle;

pub use appearance::{Appearance, BarkPattern, Color, Look, Season, oklab};
pub use dendrometry::{BREAST_HEIGHT, Dendrometry};
pub use fnv::Fnv;
pub use glam;
pub use helpers::{Helpers, NextPart};
pub use individual::{
    Address, BadStemPath, DENSEST, Draw, Draws, Hull, HullView, Individual, Spread, StemPath, Step, Trial,
};
pub use leaflets::{leaflet_size, push_leaflets};
pub use random::Key;
pub use stats::{Bounds, TreeStats};
pub use tree::{Blob, Foliage, Knot, Leaf, MalformedTree, Parts, Stem, StemKind, Tree, piece};
