//! The map of species, and every tree between them.
//!
//! Species are points in the space of their parameters. Principal components lay them out on a
//! plane (Hewitt 2017, §3.3.1), and every point of the plane is a tree: a *blend* of the species
//! around it.
//!
//! ```
//! use pleach_blend::{BlendMap, Point, Settings};
//!
//! let names = ["quaking_aspen", "silver_birch", "palm", "bamboo"];
//! let species = names.iter().map(|n| pleach_generators::species(n).unwrap()).collect();
//! let map = BlendMap::new(species, Settings::default()).unwrap();
//! let (aspen, birch) = (map.dots()[0], map.dots()[1]);
//! let mix = map.at(Point { x: (aspen.x + birch.x) / 2.0, y: (aspen.y + birch.y) / 2.0 }).unwrap();
//! assert!(!mix.is_extrapolated());
//! println!("{}", map.species_at(&mix, "mix").to_toml(&[]));
//! ```
//!
//! | module | idea |
//! | --- | --- |
//! | [`coding`] | what the numbers of a species mean, as features that can be compared and averaged |
//! | [`landmarks`] | the species that a map or a blend is made of, and averaging them |
//! | [`pca`] | principal components through `linfa-reduction`, its traps avoided |
//! | [`plane`] | points, the convex hull |
//! | [`natural`] | natural-neighbour weights: how much of which species is at a point |
//! | [`map`] | all of it together: point → parameters, parameters → point |
//! | [`looks`] | the other layout: dots by how alike silhouettes are |
//! | [`draw`] | species as silhouettes, on all threads |
//! | [`measures`] | what people see of a tree, as numbers |
//! | [`picture`] | the map as a picture |
//!
//! # Invariants
//!
//! Nothing here prints, reads the clock or draws unseeded random numbers, and results do not depend
//! on the number of threads. No generator is known by name: what is special about a parameter comes
//! from its declaration or from [`pleach_tree::Generator`]. `linfa` and `ndarray` stay inside.
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]

pub mod coding;
pub mod draw;
mod error;
pub mod landmarks;
pub mod looks;
pub mod map;
pub mod measures;
mod mix;
pub mod natural;
mod notes;
pub mod pca;
pub mod picture;
pub mod plane;
#[cfg(test)]
mod testing;

pub use coding::{Coding, Encoding};
pub use error::{BlendError, DecompositionFault};
pub use landmarks::{Landmarks, Weights};
pub use map::{Blend, BlendMap, Settings};
pub use measures::Measure;
pub use mix::mix;
pub use notes::notes;
pub use pca::Pca;
pub use plane::{Hull, Point};
