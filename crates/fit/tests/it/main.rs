//! Tests of the whole crate, in one program so that it is linked once; allocations are counted in another.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;
mod families;
mod grows;
mod guess;
mod height;
mod helpers;
mod hull;
mod individual;
mod judged;
mod known_start;
mod nuisances;
mod pole;
mod problems;
mod same_bits;
mod stature;
mod stepwise;
mod whole;
