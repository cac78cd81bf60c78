//! The registry of generators: from a species' name or file to something that grows.
//!
//! A new generator is one more line in [`families`].
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]

mod choice;
mod file;

pub use choice::GeneratorChoice;
pub use file::{read, read_file};

use pleach_tree::{Family, Species, SpeciesDoc, SpeciesError};
use std::path::{Path, PathBuf};

/// Every family of generators, the default one first.
#[must_use]
pub fn families() -> &'static [&'static dyn Family] {
    &[
        &pleach_weber_penn::WeberPennFamily,
        &pleach_lsystem::LSystemFamily,
        &pleach_fractal::FractalFamily,
        &pleach_least_cost_path::LeastCostPathFamily,
        &pleach_stylised::StylisedFamily,
    ]
}

/// The family of this name.
///
/// # Errors
/// A name that no family has.
pub fn family(name: &str) -> Result<&'static dyn Family, UnknownFamily> {
    let known = families().iter().copied().find(|family| family.name() == name);
    known.ok_or_else(|| UnknownFamily { name: name.to_owned() })
}

/// A word that names no family of generators.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown generator `{}`, known are {}", pleach_tree::param::shown(.name), family_names().join(", "))]
pub struct UnknownFamily {
    /// The word.
    pub name: String,
}

/// The names of all families, the default one first.
#[must_use]
pub fn family_names() -> Vec<&'static str> {
    families().iter().map(|family| family.name()).collect()
}

/// The family of species files that name none, and of fits that are not told another.
#[must_use]
pub fn default_family() -> &'static dyn Family {
    families()[0]
}

/// The species that come with `family`.
///
/// # Panics
/// If a file that comes with pleach cannot be read: a mistake in pleach.
#[must_use]
pub fn presets(family: &dyn Family) -> Vec<Species> {
    family.presets().iter().filter_map(|(name, _)| pleach_tree::species::preset(family, name)).collect()
}

/// The names of all species that come with pleach, family by family.
#[must_use]
pub fn names() -> Vec<&'static str> {
    families().iter().flat_map(|family| family.presets().iter().map(|(name, _)| *name)).collect()
}

/// The fifteen species of Hewitt's dissertation.
pub use pleach_weber_penn::HEWITT_2017;

/// Why loading a species failed.
#[derive(Debug, thiserror::Error)]
pub enum RegistryError {
    /// Neither a known name nor a file.
    #[error("no species and no file is called `{}`{}; `pleach species` lists the known ones", pleach_tree::param::shown(.name), suggestion(.nearest))]
    Unknown {
        /// What was asked for.
        name: String,
        /// The nearest known name, or the species file that lacks only its ending.
        nearest: Option<String>,
    },
    /// A word that several species have in their names.
    #[error("`{name}` may be {}: say which", known.join(" or "))]
    Ambiguous {
        /// What was asked for.
        name: String,
        /// The names that hold it.
        known: Vec<&'static str>,
    },
    /// The file cannot be read.
    #[error("cannot read the species file {}: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The file is far larger than a species.
    #[error("{} is too large: a species file has at most {} bytes", path.display(), file::MAX_BYTES)]
    TooLarge {
        /// The file.
        path: PathBuf,
    },
    /// The file is a picture.
    #[error("{} is a {kind} picture, expected a species file; `pleach fit` finds the species of a picture", path.display())]
    Picture {
        /// The file.
        path: PathBuf,
        /// The format of the picture.
        kind: &'static str,
    },
    /// The file says something wrong.
    #[error(transparent)]
    Species(#[from] SpeciesError),
}

fn suggestion(nearest: &Option<String>) -> String {
    nearest.as_ref().map_or_else(String::new, |name| format!(", did you mean `{name}`?"))
}

/// The species called `name` among those that come with pleach.
#[must_use]
pub fn preset(name: &str) -> Option<Species> {
    families().iter().find_map(|family| pleach_tree::species::preset(*family, name))
}

/// The names of known species that `name` may stand for: a name stands for itself, and a whole word of a
/// name, such as `aspen`, for every name that holds it in the first family where any does.
#[must_use]
pub fn names_like(name: &str) -> Vec<&'static str> {
    if let Some(known) = names().into_iter().find(|known| *known == name) {
        return vec![known];
    }
    let of_family = |family: &&dyn Family| -> Vec<&'static str> {
        let names = family.presets().iter().map(|(name, _)| *name);
        names.filter(|known| pleach_tree::param::is_word_of(name, known)).collect()
    };
    families().iter().map(of_family).find(|names| !names.is_empty()).unwrap_or_default()
}

/// A species by name or by file: a known name wins, then a file, then a word that only one known name
/// holds ([`names_like`]).
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

/// Reads the text of a species file; `origin` is for messages.
///
/// # Errors
/// Every problem of the text, with line and column.
pub fn read_text(origin: &str, text: &str) -> Result<Species, SpeciesError> {
    use pleach_tree::param::Problem;
    let doc = SpeciesDoc::parse(origin, text)?;
    let wrong = |issue| doc.wrong(vec![issue]);
    let name = doc.text("generator").map_err(wrong)?.unwrap_or_else(|| default_family().name());
    let Ok(family) = family(name) else {
        let span = doc.get("generator").map_or(0..0, |node| node.span.clone());
        let problem = Problem::UnknownChoice {
            value: name.to_owned(),
            known: family_names().into_iter().map(str::to_owned).collect(),
            nearest: None,
        };
        return Err(wrong(doc.issue(span, "generator", problem)));
    };
    doc.species(family)
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
