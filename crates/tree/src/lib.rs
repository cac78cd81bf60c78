//! What generators of plants share: parameters, species files, and the traits that they implement.
//!
//! A *generator* turns checked parameters and a seed into a [`Tree`]. A *family* reads the species files that
//! say which parameters. What a tree is stands in `pleach-plant`; all of that is exported here too, so that a
//! generator needs one dependency.
//!
//! | module | idea |
//! | --- | --- |
//! | [`param`] | one declaration of a parameter, and everything that follows from it |
//! | [`species`] | reading and writing species files |
//! | [`generator`] | the traits that generators implement |
//!
//! # Invariants
//!
//! Nothing here reads the clock, the environment or the operating system's randomness, and nothing
//! here prints. Angles are in radians inside and in degrees in files; the name says which where both
//! occur.
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]

#[cfg(any(test, feature = "conformance"))]
pub mod conformance;
pub mod generator;
mod grow_error;
mod growth;
mod leafless;
mod model;
pub mod param;
pub mod species;

pub use generator::{Generator, Stature, Variation};
pub use grow_error::{Blame, Conflict, GrowError};
pub use growth::{Growth, Limits, Workspace};
pub use leafless::Leafless;
pub use model::ModelId;
pub use param::{CheckedParams, Kind, Param, ParamSpace, Slot, Unit};
pub use pleach_plant::{
    Address, Appearance, BREAST_HEIGHT, BadStemPath, BarkPattern, Blob, Bounds, Color, DENSEST, Dendrometry,
    Draw, Draws, Fnv, Foliage, Helpers, Hull, HullView, Individual, Key, Knot, Leaf, Look, MalformedTree,
    NextPart, Parts, Season, Spread, Stem, StemKind, StemPath, Step, Tree, TreeStats, Trial, leaflet_size,
    piece, push_leaflets,
};
pub use pleach_plant::{leaf_shape, math, random, spline, trig, turtle};
pub use species::{Family, Species, SpeciesDoc, SpeciesError};
