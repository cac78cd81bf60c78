//! Species with leaves of natural size, which no family's list has.

use crate::file::read_text;
use pleach_species::NATURAL;
use pleach_tree::Species;

/// The names of species with leaves of natural size. A fit does not compare with them: their leaves take long to grow, and
/// at its resolution they look like others.
pub fn natural_names() -> impl Iterator<Item = &'static str> {
    NATURAL.iter().map(|(name, _)| *name)
}

/// The species of this name with leaves of natural size.
pub(crate) fn natural(name: &str) -> Option<Species> {
    let (_, text) = NATURAL.iter().find(|(known, _)| *known == name)?;
    Some(read_text(name, text).unwrap_or_else(|error| panic!("a built-in species is broken:\n{error}")))
}
