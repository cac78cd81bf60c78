//! Tests of the whole crate, in one program so that it is linked once.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod files;
mod growth;
mod leaves;
mod levels;
mod mesh;
mod pictures;
mod pivots;
mod quantized;
mod silhouettes;
mod stems;
mod wind;
