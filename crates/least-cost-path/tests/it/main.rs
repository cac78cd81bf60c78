//! Tests of the family as its users see it.

mod conformance;

mod bad_input;
