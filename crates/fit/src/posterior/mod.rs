//! Answers with intervals: what a picture says about the numbers of its tree, and what it leaves open.
//!
//! A [`Prior`] says which trees there are before a picture is seen; a
//! [`PosteriorModel`] learns from trees of it.

mod examples;
mod form;
mod model;
mod prior;
mod ridge;

pub(crate) use examples::features;
pub(crate) use model::quantiles;
pub use model::{HeldOut, Interval, Posterior, PosteriorModel, PosteriorNumber, PosteriorSettings};
pub use prior::{NoSample, Prior};
pub(crate) use ridge::{Columns, Ridge, dot};
