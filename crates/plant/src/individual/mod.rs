//! One particular tree of a species: stems with draws of their own, and a crown that grows into a hull.
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
//! | [`Hull`] | where pictures show the crown |
//! | [`Draws`] | what a generator asks, stem by stem |
//! | [`Individual`] | the hull and all draws of a tree, as they stand in a file |

mod address;
mod draw;
mod draws;
mod hull;

pub use address::{Address, BadStemPath, StemPath, Step};
pub use draw::{Draw, Spread};
pub use draws::{Draws, Trial};
pub use hull::{DENSEST, Hull, HullView};

use std::collections::BTreeMap;
use std::sync::Arc;

/// What makes one tree of a species the one that it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Individual {
    stems: BTreeMap<StemPath, Draw>,
    hull: Option<Arc<Hull>>,
}

impl Individual {
    /// The tree that grows into `hull`, [rounded](Hull::rounded), without draws of its own.
    #[must_use]
    pub fn with_hull(hull: Hull) -> Self {
        let mut individual = Self::default();
        individual.set_hull(Some(hull));
        individual
    }

    /// Gives its crown another hull, [rounded](Hull::rounded), or none.
    pub fn set_hull(&mut self, hull: Option<Hull>) {
        self.hull = hull.map(|hull| Arc::new(hull.rounded()));
    }

    /// What its crown grows into, if pictures say so; families that cannot do that pass over it.
    #[must_use]
    pub fn hull(&self) -> Option<&Hull> {
        self.hull.as_deref()
    }

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
        self.stems.is_empty() && self.hull.is_none()
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
        let stems = self.stems.iter().map(|(path, draw)| (path.address(), *draw));
        Draws::new(stems).with_hull(self.hull.clone())
    }
}
