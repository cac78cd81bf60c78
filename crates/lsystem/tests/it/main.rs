//! Tests of the whole crate, in one program so that it is linked once.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod bounds;
mod chance;
mod classics;
mod conformance;
mod diagnostics;
mod docs;
mod edit;
mod evolve;
mod facts;
mod language;
mod normal_form;
mod plane;
mod silhouettes;
mod strings;
mod table;
mod turtle;
