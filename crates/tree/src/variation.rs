//! Structures that a search changes.

use crate::generator::Generator;
use crate::random::Key;
use std::fmt;
use std::sync::Arc;

/// What a family offers to searches that change the structure of a generator (a grammar) and not only
/// its numbers.
///
/// A structure is a text that the family writes and reads. Every structure that comes out of
/// [`Variation::fresh`], [`Variation::vary`] or [`Variation::cross`] is one that
/// [`Variation::generator`] takes; whether its trees grow within limits is not promised. The generators
/// of all structures that descend from one have equal parameter spaces.
///
/// The same arguments give the same structure.
pub trait Variation: Send + Sync + fmt::Debug {
    /// The structure of the generator that offers the variation.
    fn own(&self) -> String;

    /// A structure that is drawn from nothing: one that descends from [`Family::blank`](crate::Family::blank).
    fn fresh(&self, key: Key) -> String;

    /// `structure`, changed in one place or a few; the same if no change that was tried is valid.
    fn vary(&self, structure: &str, key: Key) -> String;

    /// `one` with a part of `other`; `one` if no part that was tried fits.
    fn cross(&self, one: &str, other: &str, key: Key) -> String;

    /// How long `structure` is for a reader, in words and signs.
    fn length(&self, structure: &str) -> usize;

    /// The generator with this structure; none if `structure` is not one.
    fn generator(&self, structure: &str) -> Option<Arc<dyn Generator>>;
}
