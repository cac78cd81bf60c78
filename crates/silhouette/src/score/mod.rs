//! How alike two silhouettes are.
//!
//! [`ScoreCard`] is what people read: each measure beside what says nothing would have. [`fast`] is
//! what searches call a million times, [`likeness`] is of use to both.

mod blur;
mod card;
mod columns;
mod distance;
mod ellipse;
pub mod fast;
pub mod likeness;

pub use blur::{Blurred, blob, blurred_iou};
pub use card::{BlurredIou, Crown, ScoreCard, SizeMismatch};
pub use columns::ScoreColumn;
pub use ellipse::{best_ellipse, best_ellipse_iou};
pub use likeness::Likeness;
