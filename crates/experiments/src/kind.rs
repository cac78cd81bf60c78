//! What every kind of experiments does, and how much of one is run.

use crate::journal::Journal;
use crate::outputs::Outputs;
use crate::table::Table;
use std::path::{Path, PathBuf};

/// Which part of an experiment is checked.
#[derive(Clone, Copy, Debug, Default)]
pub struct Slice {
    /// Only this many repetitions, the first ones; all by default.
    pub repetitions: Option<u64>,
    /// Only up to this many evaluations of a fit.
    pub evaluations: Option<u64>,
}

impl Slice {
    /// How many of `all` the slice takes: the first ones.
    pub(crate) fn take_of(self, all: usize) -> usize {
        self.repetitions.map_or(all, |n| all.min(usize::try_from(n).unwrap_or(usize::MAX)))
    }
}

/// A kind of experiments.
pub(crate) trait Kind {
    /// The columns of its results.
    ///
    /// # Errors
    /// If they cannot be determined, which is a bug in the kind.
    fn columns(&self) -> anyhow::Result<Vec<String>>;

    /// Its outputs beside the results, and its inputs: paths relative to `folder`.
    fn files(&self, folder: &Path) -> (Vec<String>, Vec<PathBuf>);

    /// Makes the rows.
    fn rows(&self, folder: &Path, slice: Slice, journal: &mut Journal) -> anyhow::Result<()>;

    /// Makes plots and pictures of a whole run, and a report.
    fn report(&self, folder: &Path, table: &Table, outputs: &Outputs) -> anyhow::Result<String>;
}
