//! The registry of generators: from a species' name or file to something that grows.
//!
//! A new generator is one more line in [`families()`].
//!
//! ```
//! let species = pleach_generators::species("aspen")?; // a name, a word that one name holds, or a file
//! assert_eq!((species.name.as_str(), species.generator.family()), ("quaking_aspen", "weber-penn"));
//! let tree = species.grow(1)?;
//! assert!(tree.leaves.len() > 1_000);
//!
//! let text = "generator = \"fractal\"\nname = \"mine\"\n";
//! let mine = pleach_generators::read(text.as_bytes(), "mine.toml")?;
//! assert!(!mine.grow(1)?.stems.is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]

mod choice;
mod error;
mod families;
mod file;
mod measured;
mod natural;

pub use choice::{GeneratorChoice, UnknownGenerator};
pub use error::RegistryError;
pub use families::{UnknownFamily, default_family, families, family, family_names};
pub use file::{import, read, read_file, read_text};
pub use natural::natural_names;
pub use pleach_import::{Foreign, Program, SkeletonError, SkeletonProblem};

use pleach_tree::{Family, Species};
use std::path::Path;

/// The species that come with `family`.
///
/// # Panics
/// If a file that comes with pleach cannot be read: a mistake in pleach.
#[must_use]
pub fn presets(family: &dyn Family) -> Vec<Species> {
    family.presets().iter().filter_map(|(name, _)| pleach_tree::species::preset(family, name)).collect()
}

/// The names of all species that come with pleach: family by family, then those with leaves of natural size.
#[must_use]
pub fn names() -> Vec<&'static str> {
    let of_families = families().iter().flat_map(|family| family.presets().iter().map(|(name, _)| *name));
    of_families.chain(natural_names()).collect()
}

/// The fifteen species of Hewitt's dissertation.
pub use pleach_weber_penn::HEWITT_2017;

/// The species called `name` among those that come with pleach.
#[must_use]
pub fn preset(name: &str) -> Option<Species> {
    let of_families = families().iter().find_map(|family| pleach_tree::species::preset(*family, name));
    of_families.or_else(|| natural::natural(name))
}

/// The names of known species that `name` may stand for: a name stands for itself, and a whole word of a
/// name, such as `aspen`, for every name that holds it in the first family where any does, or else for those of
/// [`natural_names`] that hold it.
#[must_use]
pub fn names_like(name: &str) -> Vec<&'static str> {
    if let Some(known) = names().into_iter().find(|known| *known == name) {
        return vec![known];
    }
    let is_like = |known: &&'static str| pleach_tree::param::is_word_of(name, known);
    let of_family = |family: &&dyn Family| -> Vec<&'static str> {
        family.presets().iter().map(|(name, _)| *name).filter(is_like).collect()
    };
    let of_families = families().iter().map(of_family).find(|names| !names.is_empty());
    of_families.unwrap_or_else(|| natural_names().filter(is_like).collect())
}

/// A species by name or by file: a known name wins, then a file, then a word that only one known name
/// holds ([`names_like`]).
///
/// ```
/// let error = pleach_generators::species("aser").unwrap_err().to_string();
/// assert!(error.contains("did you mean `acer`"), "{error}");
/// ```
///
/// # Errors
/// See [`RegistryError`].
pub fn species(name_or_path: &str) -> Result<Species, RegistryError> {
    if let Some(species) = preset(name_or_path) {
        return Ok(species);
    }
    let path = Path::new(name_or_path);
    let looks_like_a_path = name_or_path.contains(['/', '\\']) || path.extension().is_some();
    if path.exists() || looks_like_a_path {
        return read_file(path);
    }
    let known = names_like(name_or_path);
    match known.as_slice() {
        [only] => {
            if let Some(species) = preset(only) {
                return Ok(species);
            }
        }
        [] => {}
        _ => return Err(RegistryError::Ambiguous { name: name_or_path.to_owned(), known }),
    }
    let with_ending = format!("{name_or_path}.toml");
    let nearest = if Path::new(&with_ending).is_file() {
        Some(with_ending)
    } else {
        pleach_tree::param::nearest(name_or_path, names())
    };
    Err(RegistryError::Unknown { name: name_or_path.to_owned(), nearest })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_of_a_name_will_do_where_it_is_clear() {
        assert_eq!(species("aspen").unwrap().name, "quaking_aspen");
        assert_eq!(species("palm").unwrap().name, "palm", "and not the fan palm");
        let error = species("oak").unwrap_err().to_string();
        assert!(error.contains("`oak` may be black_oak or cambridge_oak"), "{error}");
        assert!(matches!(species("as"), Err(RegistryError::Unknown { .. })));
        assert!(matches!(species("aspen.toml"), Err(RegistryError::Unreadable { .. })), "a path is a path");
    }
}
