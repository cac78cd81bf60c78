//! Tests of the family as its users see it.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod conformance;
mod golden;

mod bad_input;
