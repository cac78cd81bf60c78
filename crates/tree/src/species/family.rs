//! Families of generators, which read species files.

use super::doc::SpeciesDoc;
use super::error::Issue;
use super::key::Key;
use crate::generator::Generator;
use std::fmt;
use std::sync::Arc;

/// A family of generators: reads species files that name it.
pub trait Family: Send + Sync + fmt::Debug {
    /// The name in `generator = "…"`.
    fn name(&self) -> &'static str;

    /// One line of what it grows.
    fn summary(&self) -> &'static str;

    /// The keys of its species files beside parameters and [what all files may
    /// say](crate::species::KEYS); none unless a family has some.
    fn keys(&self) -> &'static [Key] {
        &[]
    }

    /// Names that people try in its files, each with what would be right, as a clause: `the height of
    /// the tree is …`. None of them is a key or a parameter.
    fn misplaced(&self) -> &'static [(&'static str, &'static str)] {
        &[]
    }

    /// Builds the generator that a species file describes: everything but its numbers, and but what
    /// [`SpeciesDoc::species`] reads for all families.
    ///
    /// What is wrong joins `issues`, with line and column. Where the numbers can be checked all the
    /// same, there is a generator nevertheless, so that all mistakes of a file are reported at once.
    fn read(&self, doc: &SpeciesDoc, issues: &mut Vec<Issue>) -> Option<Arc<dyn Generator>>;

    /// A species file whose structure is as small as can be: where a search over structures begins that
    /// begins from nothing. None of a family whose structures cannot be [varied](crate::Variation).
    fn blank(&self) -> Option<&'static str> {
        None
    }

    /// The species that come with pleach: name and text of the file.
    fn presets(&self) -> &'static [(&'static str, &'static str)];
}
