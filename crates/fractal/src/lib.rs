//! Fractal trees: every branch ends in smaller copies of itself, turned by fixed angles.
//!
//! Coffey 2025, *Modelling the Growth and Shape of Trees*, §3 (in the plane) and Appendix (in space,
//! with chance). The declarations say what each number does; `docs/fractal.md` shows the
//! trees.
//!
//! ```
//! use pleach_fractal::FractalFamily;
//!
//! let species = pleach_tree::species::preset(&FractalFamily, "coffey_umbrella").unwrap();
//! let tree = species.grow(1)?;
//! assert!(!tree.stems.is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//! | module | idea |
//! | --- | --- |
//! | `params` | the numbers, declared once |
//! | `choices` | parameters that are one of a few words |
//! | `model` | the numbers as a generator wants them |
//! | [`frame`] | where a branch points, and how its daughters' azimuths are counted |
//! | [`noise`] | the two laws of chance |
//! | `count` | how many branches are certain, before any grows |
//! | `grow` | the recursion, as a stack |
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]

mod choices;
mod count;
mod family;
pub mod frame;
mod generator;
mod grow;
mod model;
pub mod noise;
mod params;
mod purpose;

pub use family::FractalFamily;
pub use generator::Fractal;
