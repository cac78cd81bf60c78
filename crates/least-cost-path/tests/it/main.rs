//! Tests of the family as its users see it.

mod conformance;
mod golden;

mod bad_input;
