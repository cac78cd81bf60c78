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
//! | [`Draw`] | what one stem has drawn instead |
//! | [`Spread`] | how far draws of a level may lie from a stem's own |
//! | [`Draws`] | what a generator asks, stem by stem |
//! | [`Individual`] | all draws of a tree, as they stand in a file |

mod address;
mod draw;
mod draws;
mod generator;
mod read;

pub use address::{Address, BadStemPath, StemPath, Step};
pub use draw::{Draw, Spread};
pub use draws::{Draws, Trial};
pub(crate) use generator::WithIndividual;
pub use read::KEYS;

use crate::generator::Generator;
use crate::species::Species;
use std::collections::BTreeMap;
use std::sync::Arc;

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

    /// What `stem` has drawn instead, if anything.
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

impl Species {
    /// The same species whose tree of seed `tree_seed` is `individual`. An individual that it had before is
    /// forgotten.
    #[must_use]
    pub fn with_individual(&self, tree_seed: u64, individual: Individual) -> Self {
        let kind = self.kind();
        let generator = if individual.is_empty() {
            kind.generator
        } else {
            Arc::new(WithIndividual::new(kind.generator, tree_seed, individual)) as Arc<dyn Generator>
        };
        Self { generator, tree_seed: Some(tree_seed), ..kind }
    }

    /// The draws of its individual, if it has one.
    #[must_use]
    pub fn individual(&self) -> Option<&Individual> {
        self.generator.individual()
    }

    /// The same species without its individual.
    #[must_use]
    pub fn kind(&self) -> Self {
        let generator = self.generator.kind().unwrap_or_else(|| Arc::clone(&self.generator));
        Self { generator, ..self.clone() }
    }
}
