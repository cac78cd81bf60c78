//! Tables as CSV files.

use crate::files;
use pleach_fit::{COLUMNS, Row};
use std::path::Path;

/// Writes `history.csv`.
pub(super) fn write_history(path: &Path, rows: &[Row]) -> anyhow::Result<()> {
    let header = COLUMNS.iter().map(|c| c.name.to_owned()).collect();
    let rows = rows.iter().map(|row| row.cells().collect());
    write_table(path, std::iter::once(header).chain(rows))
}

/// Writes a table, its header first.
pub(super) fn write_table(path: &Path, rows: impl IntoIterator<Item = Vec<String>>) -> anyhow::Result<()> {
    files::write_whole(path, |file| {
        let mut csv = csv::Writer::from_writer(file);
        for row in rows {
            csv.write_record(row)?;
        }
        Ok(csv.flush()?)
    })
}
