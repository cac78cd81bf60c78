//! Pictures of trees, drawn by the processor.
//!
//! | module | idea |
//! | --- | --- |
//! | [`preview`] | shaded pictures without a graphics card |
//! | [`billboard`] | a tree from a few sides, for the cards of a last level of detail |
//! | [`leaf_picture`] | pictures of leaves and blossoms for cards |
//! | [`picture`], [`png_file`] | pixels in memory and in files |
//!
//! # Invariants
//!
//! A picture is a function of the tree, the palette and the settings: nothing here draws random
//! numbers, reads the clock or prints, and the number of threads changes nothing.
#![cfg_attr(not(test), warn(clippy::disallowed_types))]

pub mod billboard;
mod few_colors;
pub mod leaf_picture;
pub mod picture;
pub mod png_file;
pub mod preview;

pub use billboard::Billboards;
pub use picture::Picture;
pub use preview::{Preview, PreviewSettings};
