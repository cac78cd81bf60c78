//! The identity of a generator.

use pleach_plant::Fnv;
use std::fmt;

/// The identity of a generator, whatever its numbers: its family and a hash of its structure.
///
/// Stable from run to run and from version to version, so that it may be written to files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ModelId {
    family: &'static str,
    structure: u64,
}

impl ModelId {
    /// The identity of the generator of `family` with this
    /// [structure](crate::Generator::structure).
    #[must_use]
    pub fn new(family: &'static str, structure: &str) -> Self {
        Self { family, structure: Fnv::hash(structure.as_bytes()) }
    }

    /// The family's name.
    #[must_use]
    pub const fn family(&self) -> &'static str {
        self.family
    }
}

/// The family, and 16 hexadecimal digits: `weber-penn cbf29ce484222325`.
impl fmt::Display for ModelId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {:016x}", self.family, self.structure)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn family_and_structure_tell_models_apart() {
        let id = ModelId::new("bush", "rules = 1\n");
        assert_eq!(id, ModelId::new("bush", "rules = 1\n"));
        assert_ne!(id, ModelId::new("bush", "rules = 2\n"));
        assert_ne!(id, ModelId::new("shrub", "rules = 1\n"));
    }

    #[test]
    fn the_hash_is_the_published_one() {
        // Test vectors of the FNV page by L. C. Noll.
        assert_eq!(ModelId::new("a", "").to_string(), "a cbf29ce484222325");
        assert_eq!(ModelId::new("a", "foobar").to_string(), "a 85944171f73967e8");
    }
}
