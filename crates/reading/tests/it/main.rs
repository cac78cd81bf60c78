//! Readings of pictures drawn by hand.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod hand;
mod hostile;
mod json;
mod skeleton;
