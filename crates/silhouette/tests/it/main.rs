//! Tests of the whole crate, in one program so that it is linked once; allocations are counted in another.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod bent;
mod goals;
mod helpers;
mod misread;
mod referee;
mod shapes;
mod warnings;
