//! Tests of the whole crate, in one program so that it is linked once; memory is measured in another.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod billboards;
mod preview;
