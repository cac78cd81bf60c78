//! Tests of the whole crate, in one program so that it is linked once.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod default_limits;
mod foreign;
mod handles;
mod natural;
mod text;
