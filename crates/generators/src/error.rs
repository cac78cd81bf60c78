//! Why loading a species fails.

use pleach_tree::SpeciesError;
use std::path::PathBuf;

/// Largest species file that is read, in bytes: a thousand times the usual.
pub(crate) const MAX_BYTES: u64 = 4 << 20;

/// Why loading a species failed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
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
    #[error("{} is too large: a species file has at most {} bytes", path.display(), MAX_BYTES)]
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
    /// The file is meant for pleach.
    #[error("{} is not a species of another program, expected a preset of tree-gen or Sapling, XML of Arbaro or JSON of ez-tree", path.display())]
    NotForeign {
        /// The file.
        path: PathBuf,
    },
    /// The file of a measured tree says something wrong.
    #[error(transparent)]
    Skeleton(#[from] pleach_import::SkeletonError),
    /// The file says something wrong.
    #[error(transparent)]
    Species(#[from] SpeciesError),
}

fn suggestion(nearest: &Option<String>) -> String {
    nearest.as_ref().map_or_else(String::new, |name| format!(", did you mean `{name}`?"))
}
