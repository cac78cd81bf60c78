//! Species files: one tree species as a plain TOML file.
//!
//! ```toml
//! generator = "weber-penn"
//! g_scale = 13
//! branches = [1, 50, 30, 1]
//! ```
//!
//! Parameters stand at the top level by their names; lists are arrays of as many numbers as they
//! have, vectors arrays of three; what is missing takes the generator's default. Beside them a file may say
//! `name`, `description`, `tree_seed` (the seed of one particular tree), `bare` (grown without leaves), a table `[appearance]` (see
//! [`Appearance`]), and whatever tables its generator knows: [`KEYS`] and
//! [`Family::keys`] declare them.

mod appearance;
mod doc;
mod error;
pub mod excerpt;
mod family;
mod individual;
mod key;
mod keys;
mod name;
mod quoted;
mod read;
mod write;

pub use appearance::appearance_keys;
pub use doc::{Entry, Node, SpeciesDoc, Value};
pub use error::{Issue, SpeciesError};
pub use family::Family;
pub use key::{Form, Key, Shape};
pub use keys::KEYS;
pub use name::{MAX_NAME_BYTES, MAX_NAME_CHARS, NameError, check_name, safe_name};

use crate::generator::Generator;
use crate::grow_error::GrowError;
use crate::growth::{Growth, Workspace};
use crate::param::CheckedParams;
use pleach_plant::{Appearance, Foliage, Tree};
use std::sync::Arc;

/// A species: a generator and the numbers that make it grow this kind of tree.
#[derive(Clone, Debug)]
pub struct Species {
    /// Short name, such as `quaking_aspen`. Names that are read from files pass [`check_name`];
    /// code that makes a species from other text uses [`safe_name`], or [`Species::file_stem`] later.
    pub name: String,
    /// One line about it, possibly empty.
    pub description: String,
    /// The generator, with everything settled but its numbers.
    pub generator: Arc<dyn Generator>,
    /// The numbers.
    pub params: CheckedParams,
    /// The seed of one particular tree, where the file says so.
    pub tree_seed: Option<u64>,
    /// Whether trees have leaves where nothing else is asked for: [`Foliage::None`] where the file says
    /// `bare = true`.
    pub foliage: Foliage,
    /// Colours and season, where the file says so.
    pub appearance: Appearance,
}

impl Species {
    /// Grows the tree of `seed` on this thread, with the leaves that [`Species::foliage`] says; see [`Generator::grow`] for reuse of memory.
    ///
    /// # Errors
    /// See [`GrowError`].
    pub fn grow(&self, seed: u64) -> Result<Tree, GrowError> {
        self.grow_with(&Growth { foliage: self.foliage, ..Growth::seed(seed) })
    }

    /// Grows the tree without leaves.
    ///
    /// # Errors
    /// See [`GrowError`].
    pub fn grow_bare(&self, seed: u64) -> Result<Tree, GrowError> {
        self.grow_with(&Growth { foliage: Foliage::None, ..Growth::seed(seed) })
    }

    /// Grows a tree as `growth` asks, with leaves or without whatever the species says.
    ///
    /// # Errors
    /// See [`GrowError`].
    pub fn grow_with(&self, growth: &Growth) -> Result<Tree, GrowError> {
        let mut tree = Tree::default();
        self.generator.grow(&self.params, growth, &mut Workspace::default(), &mut tree)?;
        Ok(tree)
    }

    /// The species as a file that [`SpeciesDoc::parse`] reads back to the same numbers. `comments`
    /// are paragraphs for its head, without the `#`; they are wrapped. A name that no file may have is
    /// written as [`safe_name`] makes it.
    #[must_use]
    pub fn to_toml(&self, comments: &[String]) -> String {
        write::species(self, comments)
    }
}

/// The species called `name` among those that come with `family`.
///
/// # Panics
/// If its file cannot be read: a mistake in the family, which its conformance tests find.
#[must_use]
pub fn preset(family: &dyn Family, name: &str) -> Option<Species> {
    let (_, text) = family.presets().iter().find(|(known, _)| *known == name)?;
    let species = SpeciesDoc::parse(name, text).and_then(|doc| doc.species(family));
    Some(species.unwrap_or_else(|error| panic!("a built-in species is broken:\n{error}")))
}

#[cfg(test)]
mod tests;
