//! The plant model that every part of pleach shares.
//!
//! A *generator* turns checked parameters and a seed into a [`Tree`]: stems as cubic Bézier splines
//! with radii, leaves and blossoms as small oriented shapes. Renderers, meshers and scorers read the
//! tree and know nothing of how it grew.
//!
//! | module | idea |
//! | --- | --- |
//! | [`plant`] | [`Tree`], [`Stem`], [`Knot`], [`Leaf`]: flat arrays, metres, z up, right-handed |
//! | [`spline`] | one cubic Bézier piece: evaluate, differentiate, flatten by tolerance |
//! | [`math`] | powers, logarithms and the like, the same bits everywhere |
//! | [`trig`] | fast sine, cosine and arc tangent, the same bits everywhere |
//! | [`turtle`] | a position with two axes that walks and turns |
//! | [`random`] | draws that are a function of an address, never of the draws before |
//! | [`leaf_shape`] | outlines of ten leaves and faces of three blossoms |
//! | [`param`] | one declaration of a parameter, and everything that follows from it |
//! | [`species`] | reading and writing species files |
//! | [`individual`] | one particular tree: stems with draws of their own |
//! | [`generator`] | the traits that generators implement |
//! | [`stats`] | measurements of a tree, with fixed names |
//! | [`dendrometry`] | height, crown and stem diameter, as foresters measure them |
//!
//! # Invariants
//!
//! Nothing here reads the clock, the environment or the operating system's randomness, and nothing
//! here prints. Angles are in radians inside and in degrees in files; the name says which where both
//! occur.
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]

#[cfg(any(test, feature = "conformance"))]
pub mod conformance;
pub mod dendrometry;
mod fnv;
pub mod generator;
mod grow_error;
mod growth;
pub mod individual;
pub mod leaf_shape;
mod leafless;
pub mod math;
mod model;
pub mod param;
pub mod plant;
pub mod random;
pub mod species;
pub mod spline;
pub mod stats;
pub mod trig;
pub mod turtle;

pub use fnv::Fnv;
pub use generator::{Generator, Variation};
pub use grow_error::{Blame, Conflict, GrowError};
pub use growth::{Foliage, Growth, Limits, Workspace};
pub use individual::{Address, Draw, Draws, Individual, Spread};
pub use leafless::Leafless;
pub use model::ModelId;
pub use param::{CheckedParams, Kind, Param, ParamSpace, Slot, Unit};
pub use plant::{Blob, Knot, Leaf, MalformedTree, Parts, Stem, StemKind, Tree};
pub use random::Key;
pub use species::{Family, Species, SpeciesDoc, SpeciesError};
pub use stats::TreeStats;
