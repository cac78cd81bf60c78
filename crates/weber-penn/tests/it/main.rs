//! Tests of the whole crate, in one program so that it is linked once; allocations are counted in another.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod behaviour;
mod census;
mod conformance;
mod helpers;
mod hulls;
mod leafless;
mod stature;
