//! The reason why a checkpoint was not read or written.

use pleach_tree::param::SlotError;
use std::io;
use std::path::PathBuf;

/// The reason why a checkpoint was not read or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CheckpointError {
    /// The file could not be read or written.
    #[error("{path}: {action}: {source}")]
    Io {
        /// The checkpoint's path.
        path: PathBuf,
        /// What failed.
        action: &'static str,
        /// What the operating system said.
        source: io::Error,
    },
    /// The file is not a checkpoint at all.
    #[error("{path} is not a checkpoint of pleach")]
    NotACheckpoint {
        /// The file.
        path: PathBuf,
    },
    /// A checkpoint of another version of pleach.
    #[error(
        "{path} is a checkpoint of format {found}, and this pleach reads format {expected}: finish the fit with \
         the version of pleach that began it, or start over"
    )]
    OtherFormat {
        /// The file.
        path: PathBuf,
        /// The format in its header.
        found: String,
        /// The format that this version reads and writes.
        expected: u32,
    },
    /// The file ends too early, or goes on too long.
    #[error("{path} is damaged: the header promises {expected} bytes, there are {found}")]
    WrongLength {
        /// The file.
        path: PathBuf,
        /// Length in the header.
        expected: usize,
        /// Actual length.
        found: usize,
    },
    /// Bytes have changed.
    #[error("{path} is damaged: the checksum does not match")]
    WrongChecksum {
        /// The file.
        path: PathBuf,
    },
    /// The body does not hold what this version writes.
    #[error("{path} does not hold the state of this optimiser: {problem}")]
    WrongBody {
        /// The file.
        path: PathBuf,
        /// The problem.
        problem: BodyProblem,
    },
    /// A checkpoint of another run.
    #[error("{path} is the checkpoint of another run: it differs in {}", differences.join(", "))]
    OtherRun {
        /// The file.
        path: PathBuf,
        /// What differs: goal, species, settings …
        differences: Vec<&'static str>,
    },
}

/// Problems of the body of a checkpoint whose checksum is right.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BodyProblem {
    /// It does not parse.
    #[error("{0}")]
    Form(postcard::Error),
    /// Something follows it.
    #[error("{bytes} bytes too many")]
    Trailing {
        /// How many bytes.
        bytes: usize,
    },
    /// A time that is not possible.
    #[error("`{name}` is {seconds}, expected 0 to {max:e}")]
    Seconds {
        /// Which time.
        name: &'static str,
        /// What it says, in seconds.
        seconds: f64,
        /// The longest.
        max: f64,
    },
    /// More time had passed before the search than in all.
    #[error("`before_search_s` is more than `elapsed_s`")]
    BeforeSearch,
    /// Not one row for each generation.
    #[error("the history has {rows} rows for {generations} generations")]
    Rows {
        /// Rows.
        rows: u64,
        /// Finished generations.
        generations: u64,
    },
    /// A row that is out of order.
    #[error("row {row} of the history is of generation {generation}")]
    Row {
        /// Its number, from 1.
        row: u64,
        /// Its generation.
        generation: u64,
    },
    /// Evaluations that fall from row to row, or are more than there can be.
    #[error("the evaluations in the history do not add up")]
    Evaluations,
    /// There are evaluations and no best individual.
    #[error("{evaluations} evaluations and no best individual")]
    NoBest {
        /// How many.
        evaluations: u64,
    },
    /// The best individual is not of this generator.
    #[error("its best list: {0}")]
    Best(SlotError),
    /// The best individual's structure is not one.
    #[error("its best structure cannot be read")]
    Structure,
    /// The optimiser cannot have come to this state.
    #[error("the optimiser's numbers do not fit together")]
    Method,
}
