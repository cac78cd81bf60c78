//! Trees by space colonisation, with twigs and leaves after Weber and Penn.
//!
//! Points are strewn in the volume of a crown. Shoots grow from the trunk and its limbs towards the points that are
//! nearest to them, and a point that is reached is gone (Runions, Lane and Prusinkiewicz 2007, *Modeling trees with a
//! space colonization algorithm*). Leaders and side shoots have other fates (after Pałubicki and others 2009,
//! *Self-organizing tree models for image synthesis*). Twigs and leaves stand on what has grown, by the formulas of
//! Weber and Penn 1995. `docs/space-colonization.md` shows the trees.
//!
//! ```
//! use pleach_space_colonization::SpaceColonizationFamily;
//!
//! let species = pleach_tree::species::preset(&SpaceColonizationFamily, "english_oak").unwrap();
//! let tree = species.grow(1)?;
//! assert!(!tree.stems.is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//! | module | idea |
//! | --- | --- |
//! | `params` | the numbers, declared once |
//! | `volume`, `sections` | what a crown fills: a solid of revolution, or the hull of an individual |
//! | `points` | attraction points in it, by address |
//! | `nodes` | the scaffold |
//! | `trunks` | trunks and limbs, which stand before points are colonised |
//! | `colony`, `grid` | shoots that grow towards points |
//! | `vigor` | how much of the resource each bud gets |
//! | `pipes` | thickness |
//! | `stems`, `pose` | from nodes to stems, and how draws of single stems turn them |
//! | `twigs`, `leaves` | what stands on the outer stems |
//! | `budget` | limits |
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]

mod adapt;
mod budget;
mod colony;
mod courses;
mod family;
mod finer_leaves;
mod generator;
mod grid;
mod leaves;
mod nodes;
mod params;
mod pipes;
mod points;
mod pose;
mod purpose;
mod rules;
mod sections;
mod stems;
mod trunks;
mod twigs;
mod vigor;
mod volume;

pub use family::SpaceColonizationFamily;
pub use generator::SpaceColonization;
