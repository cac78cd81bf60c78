//! Pictures of trees, drawn by the processor.
//!
//! ```
//! use pleach_mesh::Palette;
//! use pleach_plant::Season;
//!
//! let species = pleach_generators::species("acer")?;
//! let mut tree = species.grow(1)?;
//! let palette = Palette::new(&species.appearance, Some(Season::Autumn));
//! palette.apply_season(&mut tree);
//! let picture = pleach_render::preview::render(&tree, &palette, 64);
//! picture.write_png(&mut std::io::sink())?;
//! assert_eq!((picture.width, picture.rgba.len()), (64, 64 * 64 * 4));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//! | module | idea |
//! | --- | --- |
//! | [`preview`] | shaded pictures without a graphics card |
//! | [`billboard`] | a tree from a few sides, for the cards of a last level of detail |
//! | [`twig_sheet`] | some of a tree's twigs, for the cards of a level with few triangles |
//! | [`bark_picture`] | pictures of bark that repeat: colour, relief, roughness |
//! | [`blob_picture`] | pictures of foliage that repeat, for blobs: colour, relief |
//! | [`leaf_atlas`] | pictures of leaves and blossoms that differ from each other |
//! | [`picture`], [`png_file`] | pixels in memory and in files |
//!
//! # Invariants
//!
//! A picture is a function of the tree, the palette and the settings: nothing here draws random
//! numbers, reads the clock or prints, and the number of threads changes nothing.
#![cfg_attr(not(test), warn(clippy::disallowed_types))]

pub mod bark_picture;
pub mod billboard;
mod blade;
pub mod blob_picture;
mod cutoff;
mod few_colors;
pub mod leaf_atlas;
mod petals;
pub mod picture;
pub mod png_file;
pub mod preview;
mod srgb;
mod tile;
pub mod twig_sheet;

pub use billboard::Billboards;
pub use picture::Picture;
pub use preview::{Preview, PreviewSettings};
