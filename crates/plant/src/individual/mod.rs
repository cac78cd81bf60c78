//! One particular tree of a species: stems with draws of their own.
//!
//! Randomness is addressed, so the draws of one stem can be changed and every other stem stays as it
//! is. An [`Individual`] says of some stems of the tree of one seed which draws they have instead: it is
//! still a tree of its species, but one that was chosen branch by branch. All other seeds grow as ever.
//!
//! | type | idea |
//! | --- | --- |
//! | [`StemPath`] | where a stem is, as people write it: `0/12/f1` |
//! | [`Address`] | the same while a tree grows: a few bytes, made from the parent's |
//! | [`Draw`] | draws of one stem that replace its own |
//! | [`Spread`] | how far draws of a level may lie from a stem's own |
//! | [`Draws`] | what a generator asks, stem by stem |
//! | [`Individual`] | all draws of a tree, as they stand in a file |

mod address;
mod draw;
mod draws;

pub use address::{Address, BadStemPath, StemPath, Step};
pub use draw::{Draw, Spread};
pub use draws::{Draws, Trial};

use std::collections::BTreeMap;

/// The draws that make one tree of a species the one that it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Individual {
    stems: BTreeMap<StemPath, Draw>,
}

impl Individual {
    /// The stems with draws of their own, those from the ground first.
    pub fn stems(&self) -> impl Iterator<Item = (&StemPath, &Draw)> {
        self.stems.iter()
    }

    /// Number of stems with draws of their own.
    #[must_use]
    pub fn len(&self) -> usize {
        self.stems.len()
    }

    /// Whether it is the tree that its seed grows.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.stems.is_empty()
    }

    /// The draw that replaces `stem`'s own, if there is one.
    #[must_use]
    pub fn get(&self, stem: &StemPath) -> Option<&Draw> {
        self.stems.get(stem)
    }

    /// Gives `stem` another draw, [rounded](Draw::rounded).
    pub fn set(&mut self, stem: StemPath, draw: Draw) {
        self.stems.insert(stem, draw.rounded());
    }

    /// Gives `stem` its own draws back.
    pub fn unset(&mut self, stem: &StemPath) {
        self.stems.remove(stem);
    }

    /// Gives all stems that `stem` carries their own draws back.
    pub fn clear_above(&mut self, stem: &StemPath) {
        self.stems.retain(|path, _| path == stem || !path.is_on(stem));
    }

    /// The same for a generator.
    #[must_use]
    pub fn draws(&self) -> Draws {
        Draws::new(self.stems.iter().map(|(path, draw)| (path.address(), *draw)))
    }
}
