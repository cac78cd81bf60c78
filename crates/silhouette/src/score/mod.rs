//! How alike two silhouettes are.

pub mod fast;
