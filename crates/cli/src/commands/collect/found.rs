//! Scans a folder for what workers have written.

use super::run_name;
use super::table::{FAILED, GOAL, REASON, STATE};
use crate::commands::fit::run_folder::RunFolder;
use crate::text;
use anyhow::Context;
use pleach_table::Table;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, DirEntry};
use std::path::{Path, PathBuf};

/// Folders within folders, at most: workers' folders are a level or two below the one that is named.
const MAX_DEPTH: usize = 8;

/// A run folder with a finished fit.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Run {
    pub(super) folder: PathBuf,
    pub(super) summary: Value,
}

impl Run {
    /// The hash of the goal's file.
    pub(super) fn sha256(&self) -> Option<&str> {
        self.summary["goal_sha256"].as_str()
    }

    /// The goal's path, as its worker was given it.
    pub(super) fn goal(&self) -> PathBuf {
        self.summary["goal"].as_str().map_or_else(|| self.folder.clone(), PathBuf::from)
    }
}

/// A goal that a summary table calls failed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Failure {
    pub(super) goal: PathBuf,
    pub(super) reason: String,
}

/// All that was found, in the order of paths.
#[derive(Debug, Default)]
pub(super) struct Found {
    pub(super) finished: Vec<Run>,
    /// Run folders with a checkpoint, or with what a killed worker left.
    pub(super) unfinished: Vec<PathBuf>,
    /// By the name of the goal's run folder.
    pub(super) failures: BTreeMap<String, Failure>,
    /// Folders that have been visited, so that links cannot lead in circles.
    seen: BTreeSet<PathBuf>,
}

impl Found {
    pub(super) fn below(runs: &Path) -> anyhow::Result<Self> {
        let mut found = Self::default();
        found.look(runs, 0)?;
        Ok(found)
    }

    fn look(&mut self, folder: &Path, depth: usize) -> anyhow::Result<()> {
        let cannot = || format!("cannot read the folder {}", folder.display());
        if !self.seen.insert(folder.canonicalize().with_context(cannot)?) {
            return Ok(());
        }
        let run = RunFolder::at(folder.to_owned());
        if let Some(summary) = run.finished() {
            self.finished.push(Run { folder: folder.to_owned(), summary });
            return Ok(());
        }
        if run.was_left_unfinished() {
            self.unfinished.push(folder.to_owned());
            return Ok(());
        }
        let entries = fs::read_dir(folder).with_context(cannot)?.collect::<Result<Vec<_>, _>>();
        let mut entries = entries.with_context(cannot)?;
        entries.sort_by_key(DirEntry::file_name);
        for path in entries.iter().map(DirEntry::path) {
            if path.is_dir() {
                if depth < MAX_DEPTH {
                    self.look(&path, depth + 1)?;
                }
            } else if is_table(&path) {
                self.read_failures(&path)?;
            }
        }
        Ok(())
    }

    /// Reads the goals that failed from a table of a batch.
    fn read_failures(&mut self, table: &Path) -> anyhow::Result<()> {
        let cannot = || format!("cannot read {}", table.display());
        let name = text::path(table).to_string();
        let bytes = pleach_table::load(table).with_context(cannot)?;
        let read = Table::new(&name, &bytes).with_context(cannot)?;
        let at = |name| read.column(&[name]);
        let (Some(goal), Some(state), Some(reason)) = (at(GOAL)?, at(STATE)?, at(REASON)?) else {
            // Not a table of a batch.
            return Ok(());
        };
        for row in read.rows() {
            let row = row.with_context(cannot)?;
            let cell = |at: usize| text::from_cell(row.text(at)).into_owned();
            let goal = PathBuf::from(cell(goal));
            if cell(state) == FAILED
                && let Some(name) = run_name(&goal)
            {
                let _ = self.failures.insert(name, Failure { goal, reason: cell(reason) });
            }
        }
        Ok(())
    }
}

/// Whether a file has the name of a batch's table, or of a shard's.
fn is_table(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let shard = name.strip_prefix("summary-").and_then(|rest| rest.strip_suffix(".csv"));
    name == "summary.csv" || shard.is_some_and(|shard| shard.contains("-of-"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_known_by_their_names() {
        for name in ["runs/summary.csv", "summary-2-of-8.csv"] {
            assert!(is_table(Path::new(name)), "{name}");
        }
        for name in ["all.csv", "summary.json", "summary-2.csv", "my-summary.csv"] {
            assert!(!is_table(Path::new(name)), "{name}");
        }
    }
}
