//! This very tree: draws of single stems, chosen until the tree lies on the picture.
//!
//! A search finds the kind of a tree. One seed draws all of its branches at once, so no list of numbers puts
//! every branch where the picture has it (`experiments/needle`). Here single stems get other draws, within the
//! spreads that the species allows ([`pleach_tree::Generator::spreads`]), and those that lower the cost are kept.
//!
//! One tree in which all stems of a generation have other draws is a candidate for each of them at once. Every
//! stem with its descendants is a [layer](pleach_silhouette::Layer) of the picture, so that a trial takes one
//! layer out and puts another in, whatever the number of other stems.
//!
//! Where crowns can grow into a hull ([`pleach_tree::Generator::hull_height`]), the hull of the goals comes first: which
//! sides of a crown are full and where its gaps are is not a matter of single stems.
//!
//! The objective is overlap, pixel by pixel and in coarser cells, of trees that are as like the goal as two trees of
//! a species are at best. Draws far from a stem's own have a price, so that stems that the picture does not show stay
//! as the species would have them.

mod cells;
mod chosen;
mod fill;
mod hull;
mod individuals;
mod plan;
mod search;
mod state;
mod task;
mod units;
mod worker;

pub use individuals::individuals;
pub use task::{FoundIndividual, IndividualProgress, IndividualSettings};
