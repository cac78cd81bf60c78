//! Reads a picture of a tree: what is in it, each measure with a number and a confidence.
//!
//! ```
//! use pleach_reading::Reading;
//! use pleach_plant::Parts;
//! use pleach_silhouette::{Frame, View, silhouette};
//!
//! let tree = pleach_generators::species("stylised_round")?.grow(1)?;
//! let reading = Reading::from_silhouette(&silhouette(&tree, View::FRONT, 256));
//! assert_eq!(reading.feet.len(), 1);
//! println!("{reading}"); // one trunk, 0.11 of the height wide, …
//!
//! let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 256, 256);
//! let truth = Reading::from_skeleton(&tree, &View::FRONT, &frame, Parts::LEAFY);
//! assert!((reading.feet[0].width - truth.feet[0].width).abs() < 0.02);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A goal and the pictures of a search go through the same code; a [`Reader`] keeps its memory from one picture to the
//! next.
//!
//! | module or type | idea |
//! | --- | --- |
//! | [`Reading`] | the measures, their definitions and units |
//! | [`Reader`] | from a silhouette to a reading, with a mask of wood where there is one |
//! | [`Reading::from_skeleton`] | the same measures of a grown tree, as the truth that readings are judged by |
//! | [`annotate`](annotate()) | the measures drawn over the picture |
//! | [`Evidence`] | what confidences are made from |
//!
//! # Invariants
//!
//! A reading is a function of its pictures, with the same bits on every platform, and any picture has one: an empty
//! one has confidences of 0.
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]

mod annotate;
mod colors;
mod compare;
mod confidence;
mod error;
mod reader;
mod reading;
mod skeleton;
mod words;

pub use annotate::{Anchor, annotate};
pub use colors::Colors;
pub use compare::{Difference, Measure};
pub use confidence::Evidence;
pub use error::ReadingError;
pub use reader::Reader;
pub use reading::{CROWN_HEIGHTS, Crown, Foot, GAP_HEIGHTS, GAP_SIZES, Reading};
