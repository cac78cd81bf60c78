//! What goes wrong.

use pleach_fit::SpaceError;
use std::io;
use std::path::PathBuf;

/// Why a data set is not written, or not to its end. Shards that were finished before stay valid.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DatasetError {
    /// An option with a value that cannot be.
    #[error("`{option}` {problem}")]
    Option {
        /// The name of the field of [`crate::DatasetOptions`].
        option: &'static str,
        /// What is wrong, and what would be right.
        problem: String,
    },
    /// No species at all.
    #[error("there is no species, expected one or more")]
    NoSpecies,
    /// Two species of one name, which the manifest could not tell apart.
    #[error("{name} is there twice; each species is named once")]
    Twice {
        /// The name of both.
        name: String,
    },
    /// Patterns that a species does not know.
    #[error("{species}: {source}")]
    Space {
        /// The name of the species.
        species: String,
        /// What is wrong.
        source: SpaceError,
    },
    /// No number of a species varies, so that its trees differ by their seeds alone.
    #[error("no number of {species} varies; fewer fixed numbers, or more free ones")]
    NothingVaries {
        /// The name of the species.
        species: String,
    },
    /// A folder with files, where none were expected.
    #[error("{} is not empty; `resume` goes on with the data set that it holds, `overwrite` replaces it", folder.display())]
    NotEmpty {
        /// The folder.
        folder: PathBuf,
    },
    /// A folder with files that are not those of a data set.
    #[error("{} holds {name}, which is not a file of a data set; choose an empty folder", folder.display())]
    Foreign {
        /// The folder.
        folder: PathBuf,
        /// The first such file.
        name: String,
    },
    /// A manifest that cannot be read.
    #[error("{} is not the manifest of a data set: {problem}; `overwrite` starts again", path.display())]
    Manifest {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        problem: String,
    },
    /// A data set of other species or options, or of another version.
    #[error("{} was made with other arguments: {}; `overwrite` starts again", folder.display(), differences.join("; "))]
    OtherArguments {
        /// The folder.
        folder: PathBuf,
        /// What was asked for then and now.
        differences: Vec<String>,
    },
    /// A file or folder that cannot be read or written.
    #[error("{} {action}: {source}", path.display())]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// What cannot be done, as the rest of a sentence.
        action: &'static str,
        /// What the system says.
        source: io::Error,
    },
    /// The skeletons of a shard need too much memory.
    #[error("the skeletons of shard {shard} have more than {} MB; choose a smaller `shard`", limit >> 20)]
    Skeletons {
        /// The number of the shard.
        shard: u64,
        /// The largest size in bytes.
        limit: u64,
    },
    /// None of the draws is a tree.
    #[error("none of {draws} draws is a tree; failures.csv says why, and a smaller `spread` may help")]
    NoTrees {
        /// How many there were.
        draws: u64,
    },
    /// The caller asked to stop.
    #[error("interrupted after {shards} of {all} shards; `resume` goes on there")]
    Interrupted {
        /// Shards that are finished.
        shards: u64,
        /// All shards.
        all: u64,
    },
}

impl DatasetError {
    pub(crate) fn option(option: &'static str, problem: impl Into<String>) -> Self {
        Self::Option { option, problem: problem.into() }
    }

    /// An error of the system at `path`; `action` is what cannot be done, as the rest of a sentence.
    pub(crate) fn io(path: &std::path::Path, action: &'static str) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Io { path, action, source }
    }
}
