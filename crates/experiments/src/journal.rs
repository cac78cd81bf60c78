//! Rows as they come, kept in a file until all are there.
//!
//! A run appends the rows of each finished job to `results.csv.partial`, a job at a time, so that
//! neither ctrl-C nor a kill loses one. The first line names the `experiment.toml` that they are of.
//! A line that a kill has cut short is left out when the file is read.

use super::record::{self, Record, Row};
use super::table::Table;
use super::{Part, stop};
use anyhow::{Context, bail};
use pleach_console::interrupted::Interrupted;
use pleach_console::regular;
use pleach_tree::Key;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Rows of a run or of a check.
pub(super) struct Journal {
    columns: Vec<String>,
    rows: Vec<Row>,
    /// Rows of finished jobs whose turn has not come.
    known: Vec<Row>,
    kept: Option<Kept>,
}

/// The file of a run.
struct Kept {
    folder: PathBuf,
    path: PathBuf,
    file: File,
}

/// Where an unfinished run keeps its rows.
pub(super) fn path(folder: &Path) -> PathBuf {
    folder.join("results.csv.partial")
}

impl Journal {
    /// A journal that keeps nothing.
    pub(super) fn unkept(columns: &[String]) -> Self {
        Self { columns: columns.to_vec(), rows: Vec::new(), known: Vec::new(), kept: None }
    }

    /// The journal of a run of `spec` in `folder`, with the rows of an earlier, unfinished run.
    pub(super) fn open(folder: &Path, spec: &str, columns: &[String], part: &Part) -> anyhow::Result<Self> {
        let path = path(folder);
        let head = head(spec);
        // Rows are appended in place: not to what a link leads to.
        regular::check_file(&path)?;
        let mut known = Vec::new();
        let mut text = head.clone() + &columns.join(",") + "\n";
        if path.exists() && !part.overwrite {
            let found =
                std::fs::read_to_string(&path).with_context(|| format!("cannot read {}", path.display()))?;
            let marked = found.split_once('\n').filter(|(line, _)| line.starts_with('#'));
            // A last line without an end was cut short.
            let rows = marked.map_or(found.as_str(), |(_, rows)| rows);
            let whole = rows.rfind('\n').map_or("", |end| &rows[..=end]);
            if whole.lines().count() > 1 {
                if !part.resume {
                    bail!(
                        "{} has rows of an unfinished run: --resume goes on with it, --overwrite starts over",
                        path.display()
                    );
                }
                if marked.is_some() && !found.starts_with(&head) {
                    bail!(
                        "{} is of another experiment.toml: put that one back, or --overwrite starts over",
                        path.display()
                    );
                }
                known = Table::parse(whole, columns).with_context(|| path.display().to_string())?.rows;
                text = head + whole;
            }
        }
        pleach_console::files::write_text(&path, &text)?;
        let file = regular::open(&path, OpenOptions::new().append(true))?;
        let kept = Some(Kept { folder: folder.to_owned(), path, file });
        Ok(Self { columns: columns.to_vec(), rows: Vec::new(), known, kept })
    }

    /// Takes over rows that are not run again, but for those that an unfinished run has left as well.
    pub(super) fn know<R: Record>(
        &mut self,
        mut rows: Vec<Row>,
        is_same: impl Fn(&R, &R) -> bool,
    ) -> anyhow::Result<()> {
        let known: Vec<R> = self.known.iter().filter_map(|row| self.read(row)).collect();
        // They stay as they are, cell by cell.
        rows.retain(|row| self.read(row).is_none_or(|row| !known.iter().any(|known| is_same(known, &row))));
        self.keep(&rows)?;
        self.known.extend(rows);
        Ok(())
    }

    /// A row of an earlier run as a struct, if it has the right columns.
    fn read<R: Record>(&self, row: &Row) -> Option<R> {
        record::from_row(row, &self.columns).ok()
    }

    /// Adds rows to the file.
    fn keep(&mut self, rows: &[Row]) -> anyhow::Result<()> {
        let Some(kept) = &mut self.kept else { return Ok(()) };
        let mut csv = csv::Writer::from_writer(Vec::new());
        rows.iter().try_for_each(|row| csv.write_record(row))?;
        let bytes = csv.into_inner().map_err(csv::IntoInnerError::into_error)?;
        kept.file.write_all(&bytes).with_context(|| format!("cannot write {}", kept.path.display()))
    }

    /// Whether files beside the rows are written as well.
    pub(super) const fn is_kept(&self) -> bool {
        self.kept.is_some()
    }

    /// The rows of a job, those that `is_of` holds for: what an earlier run has left of them, or what
    /// `make` gives. None are made once the experiment is to end.
    pub(super) fn job<R: Record>(
        &mut self,
        is_of: impl Fn(&R) -> bool,
        make: impl FnOnce() -> anyhow::Result<Vec<R>>,
    ) -> anyhow::Result<()> {
        let (known, others): (Vec<Row>, Vec<Row>) = std::mem::take(&mut self.known)
            .into_iter()
            .partition(|row| self.read(row).is_some_and(|record| is_of(&record)));
        self.known = others;
        if !known.is_empty() {
            self.rows.extend(known);
            return Ok(());
        }
        if stop::is_raised() {
            return Err(self.interrupted());
        }
        let made = make();
        // A job that ends early because of the signal is not finished, even if it returned rows.
        if stop::is_raised() {
            return Err(self.interrupted());
        }
        let made = made?.iter().map(record::to_row).collect::<anyhow::Result<Vec<Row>>>()?;
        self.keep(&made)?;
        self.rows.extend(made);
        Ok(())
    }

    /// The error of a run; an interruption also says how to continue.
    pub(super) fn told(&self, error: anyhow::Error) -> anyhow::Error {
        if stop::is_raised() { self.interrupted() } else { error }
    }

    fn interrupted(&self) -> anyhow::Error {
        let text = self.kept.as_ref().map_or_else(
            || "interrupted".to_owned(),
            |kept| {
                format!(
                    "interrupted: finished rows are in {}; `pleach experiment run {} --resume` goes on",
                    kept.path.display(),
                    kept.folder.display()
                )
            },
        );
        Interrupted::new(text).into()
    }

    /// All rows so far.
    pub(super) fn table(&self) -> Table {
        Table { columns: self.columns.clone(), rows: self.rows.clone() }
    }
}

/// The line that names the `experiment.toml` of the rows.
fn head(spec: &str) -> String {
    let hash = spec.bytes().fold(Key::root(0), |key, byte| key.child(0, u32::from(byte))).bits(1, 0);
    format!("# rows of the experiment.toml {hash:016x}\n")
}
