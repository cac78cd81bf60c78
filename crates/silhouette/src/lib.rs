//! Silhouettes of trees: cameras, a bit-packed rasteriser, goal images and image scores.
//!
//! ```
//! use pleach_silhouette::score::ScoreCard;
//! use pleach_silhouette::{View, silhouette};
//!
//! let species = pleach_generators::species("acer")?;
//! let [goal, other] = [1, 2].map(|seed| species.grow(seed).map(|tree| silhouette(&tree, View::FRONT, 64)));
//! let card = ScoreCard::new(&other?, &goal?)?;
//! assert!(card.iou < 1.0);
//! println!("IoU {:.2}, likeness {:.2}", card.iou, card.likeness);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A picture of a tree is read as a [`Goal`], a photograph becomes a [`mask::Mask`] first, and a [`Rasterizer`] draws many
//! trees in one memory.
//!
//! | module | idea |
//! | --- | --- |
//! | [`bitmap`] | one-bit pictures in 64-bit words |
//! | [`view`] | directions of view, frames, cameras |
//! | [`picture`] | overlays and sheets for people |
//! | [`score`] | how alike two silhouettes are |
//! | [`raster`] | a tree drawn straight into bits |
//! | [`goal`] | a picture file becomes ink with a ground and a trunk |
//! | [`mask`] | a photograph becomes ink |
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]

pub mod bitmap;
mod encode;
mod four_views;
pub mod goal;
pub mod mask;
mod outline;
pub mod picture;
mod pieces;
pub mod raster;
pub mod score;
mod touches;
pub mod view;

pub use bitmap::Bitmap;
pub use four_views::{FOUR_VIEWS, four_views};
pub use goal::{Goal, GoalError, GoalOptions, GoalWarning, Polarity};
pub use outline::outline;
pub use raster::{Detail, Layer, LayerPainter, Rasterizer, Stack, silhouette};
pub use view::{Camera, Frame, Projection, View};
