//! Rows of results under a declared set of columns.

use super::record::{self, Record};
use anyhow::{Context, bail};
use std::path::Path;

/// A row of results as text.
pub(super) type Row = Vec<String>;

/// Rows of results under a declared set of columns.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Table {
    pub(super) columns: Vec<String>,
    pub(super) rows: Vec<Row>,
}

impl Table {
    /// The rows as structs.
    pub(super) fn records<R: Record>(&self) -> anyhow::Result<Vec<R>> {
        self.rows.iter().map(|row| record::from_row(row, &self.columns)).collect()
    }

    /// Writes the table, whole or not at all.
    pub(super) fn write(&self, path: &Path) -> anyhow::Result<()> {
        pleach_console::files::write_whole(path, |file| {
            let mut csv = csv::Writer::from_writer(file);
            csv.write_record(&self.columns)?;
            self.rows.iter().try_for_each(|row| csv.write_record(row))?;
            Ok(csv.flush()?)
        })
    }

    /// Reads a table that has these columns.
    pub(super) fn read(path: &Path, columns: &[String]) -> anyhow::Result<Self> {
        let text =
            std::fs::read_to_string(path).with_context(|| format!("cannot read {}", path.display()))?;
        Self::parse(&text, columns).with_context(|| path.display().to_string())
    }

    /// The table in `text`.
    pub(super) fn parse(text: &str, columns: &[String]) -> anyhow::Result<Self> {
        let mut csv = csv::Reader::from_reader(text.as_bytes());
        let heading: Row = csv.headers()?.iter().map(str::to_owned).collect();
        if heading != columns {
            bail!("the columns are {}, expected {}", heading.join(","), columns.join(","));
        }
        let record = |record: csv::Result<csv::StringRecord>| -> anyhow::Result<Row> {
            Ok(record?.iter().map(str::to_owned).collect())
        };
        Ok(Self {
            columns: columns.to_vec(),
            rows: csv.records().map(record).collect::<anyhow::Result<_>>()?,
        })
    }

    /// Compares with the committed results: every row here must stand there, time columns apart.
    pub(super) fn check(&self, path: &Path) -> anyhow::Result<()> {
        let timeless = |row: &[String]| -> Row {
            let kept = row.iter().zip(&self.columns).filter(|(_, column)| !column.starts_with("wall_"));
            kept.map(|(cell, _)| cell.clone()).collect()
        };
        let committed = Self::read(path, &self.columns)?;
        let committed: std::collections::BTreeSet<_> =
            committed.rows.iter().map(|row| timeless(row)).collect();
        for row in &self.rows {
            let row = timeless(row);
            if !committed.contains(&row) {
                bail!("{} has no row like what came out now: {}", path.display(), row.join(","));
            }
        }
        Ok(())
    }
}
