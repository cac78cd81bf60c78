//! Files of other programs, from outside.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod classics;
mod formats;
mod grammars;
mod hostile;
