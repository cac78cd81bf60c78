//! How alike two silhouettes are.
//!
//! [`ScoreCard`] is what people read: each measure beside what says nothing would have. [`fast`] is
//! what searches call a million times.

mod blur;
mod card;
mod distance;
mod ellipse;
pub mod fast;

pub use blur::blurred_iou;
pub use card::{BlurredIou, Crown, ScoreCard, SizeMismatch};
pub use ellipse::best_ellipse_iou;
