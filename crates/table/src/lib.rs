//! Tables as spreadsheets write them.
//!
//! The first line has the headings. Cells are separated by commas, semicolons or tabs, whichever the headings are
//! separated by. Numbers have a decimal point or a decimal comma, the same in the whole table, and no marks between
//! thousands. Text is UTF-8, with or without a byte order mark, or Windows-1252. Headings are compared by their letters and
//! digits alone, without regard to case: `Ground Row` is `ground_row`.
//!
//! ```
//! use pleach_table::Table;
//!
//! let text = "Name;Height (m)\noak;12,5\nelm;8\n";
//! let table = Table::new("trees.csv", text.as_bytes())?;
//! let height = table.column(&["height"])?.expect("there is such a column");
//! let heights: Vec<Option<f64>> = table.rows().map(|row| row?.number(height)).collect::<Result<_, _>>()?;
//! assert_eq!(heights, [Some(12.5), Some(8.0)]);
//! # Ok::<(), pleach_table::TableError>(())
//! ```
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]

mod dialect;
mod error;
mod heading;
mod number;
mod text;

pub use error::{Problem, TableError};
pub use heading::plain;

use dialect::Dialect;
use number::Marks;
use std::borrow::Cow;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// A table in memory: its headings are known, its rows are read one after the other.
#[derive(Debug)]
pub struct Table<'a> {
    name: &'a str,
    text: Cow<'a, str>,
    dialect: Dialect,
    headings: Vec<String>,
    marks: Marks,
}

/// Most bytes of a file that [`load`] reads.
pub const MAX_BYTES: u64 = 64 << 20;

/// The bytes of a file that is a table.
///
/// # Errors
/// If the file cannot be read, or has more than [`MAX_BYTES`].
pub fn load(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?.take(MAX_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MAX_BYTES {
        let what = format!("it has more than {MAX_BYTES} bytes, which a table may have");
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, what));
    }
    Ok(bytes)
}

/// Most cells of a row.
const MAX_COLUMNS: usize = 1000;

impl<'a> Table<'a> {
    /// The table in `bytes`; `name` is what errors call it.
    ///
    /// # Errors
    /// If it is no text, or if its headings cannot be told apart.
    pub fn new(name: &'a str, bytes: &'a [u8]) -> Result<Self, TableError> {
        let wrong = |problem| TableError { name: name.to_owned(), line: 1, problem };
        let text = text::decode(bytes).map_err(wrong)?;
        let dialect = Dialect::new(&text).map_err(|(line, problem)| TableError { line, ..wrong(problem) })?;
        let mut table = Self { name, text, dialect, headings: Vec::new(), marks: Marks::default() };
        let first = table.records(0).next().transpose()?;
        let Some((_, record)) = first else { return Err(wrong(Problem::Empty)) };
        table.headings = record.iter().map(str::to_owned).collect();
        // Spreadsheets write the cells of empty columns too.
        while table.headings.last().is_some_and(String::is_empty) {
            table.headings.pop();
        }
        match table.headings.len() {
            0 => Err(wrong(Problem::Empty)),
            1..=MAX_COLUMNS => Ok(table),
            _ => Err(wrong(Problem::TooManyColumns)),
        }
    }

    /// The headings as they stand there.
    #[must_use]
    pub fn headings(&self) -> &[String] {
        &self.headings
    }

    /// Puts several headings in the place of each one that is called `name`: for tables that head three columns of
    /// coordinates by one word.
    pub fn split(&mut self, name: &str, into: &[&str]) {
        let wanted = plain(name);
        let split = |heading: String| match plain(&heading) == wanted {
            true => into.iter().map(|&part| part.to_owned()).collect(),
            false => vec![heading],
        };
        self.headings = std::mem::take(&mut self.headings).into_iter().flat_map(split).collect();
    }

    /// The number of the column that has one of these names; `None` if there is none.
    ///
    /// # Errors
    /// If there are several.
    pub fn column(&self, names: &[&str]) -> Result<Option<usize>, TableError> {
        let wanted: Vec<String> = names.iter().map(|name| plain(name)).collect();
        let mut found = (0..self.headings.len()).filter(|&at| wanted.contains(&plain(&self.headings[at])));
        let first = found.next();
        match (first, found.next()) {
            (Some(first), Some(second)) => {
                let [first, second] = [first, second].map(|at| self.headings[at].clone());
                Err(self.wrong(self.first_line(), Problem::Twice { first, second }))
            }
            _ => Ok(first),
        }
    }

    /// The number of the column that has one of these names, of which the first is in the message.
    ///
    /// # Errors
    /// If there are several, or none.
    pub fn expect_column(&self, names: &[&str]) -> Result<usize, TableError> {
        self.column(names)?.ok_or_else(|| {
            let name = names.first().copied().unwrap_or_default().to_owned();
            self.wrong(self.first_line(), Problem::NoColumn { name, headings: self.headings.clone() })
        })
    }

    /// The headings that mean none of `names`.
    pub fn others<'b>(&'b self, names: &'b [&str]) -> impl Iterator<Item = &'b str> + 'b {
        let is_known = move |heading: &str| names.iter().any(|name| plain(name) == plain(heading));
        self.headings
            .iter()
            .map(String::as_str)
            .filter(move |heading| !heading.is_empty() && !is_known(heading))
    }

    /// The line of the headings.
    #[must_use]
    pub fn first_line(&self) -> u64 {
        self.dialect.skipped + 1
    }

    /// The rows under the headings; those without any text are left out.
    pub fn rows(&self) -> impl Iterator<Item = Result<Row<'_>, TableError>> + '_ {
        let rows = self.records(1).map(|read| {
            let (line, cells) = read?;
            let filled = (0..cells.len()).rfind(|&at| !cells[at].is_empty()).map_or(0, |last| last + 1);
            let (found, expected) = (cells.len(), self.headings.len());
            if filled > expected || filled > 0 && found < expected {
                return Err(self.wrong(line, Problem::Cells { found, expected }));
            }
            Ok((filled > 0).then_some(Row { table: self, line, cells }))
        });
        rows.filter_map(Result::transpose)
    }

    /// Records with their lines, without the first `skip`.
    fn records(
        &self,
        skip: usize,
    ) -> impl Iterator<Item = Result<(u64, csv::StringRecord), TableError>> + '_ {
        let reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .delimiter(self.dialect.delimiter)
            .trim(csv::Trim::All)
            .from_reader(self.text[self.dialect.start..].as_bytes());
        let mut place =
            Place { text: &self.text[self.dialect.start..], byte: 0, line: self.dialect.skipped + 1 };
        let records = reader.into_records().map(move |record| {
            let position = match &record {
                Ok(record) => record.position(),
                Err(error) => error.position(),
            };
            let line = position.map_or(place.line, |position| place.line_of(position.byte() as usize));
            let unreadable = |error: csv::Error| {
                let detail = error.to_string();
                self.wrong(line, Problem::Unreadable { detail })
            };
            Ok((line, record.map_err(unreadable)?))
        });
        records.skip(skip)
    }

    fn wrong(&self, line: u64, problem: Problem) -> TableError {
        TableError { name: self.name.to_owned(), line, problem }
    }
}

/// A place in a text, and its line.
struct Place<'a> {
    text: &'a str,
    byte: usize,
    line: u64,
}

impl Place<'_> {
    /// The line of the record that begins at `byte` or behind empty lines there; later than all before.
    fn line_of(&mut self, byte: usize) -> u64 {
        let rest = self.text.as_bytes().get(byte..).unwrap_or_default();
        let byte = byte + rest.iter().take_while(|sign| matches!(sign, b'\r' | b'\n')).count();
        let passed = self.text.as_bytes().get(self.byte..byte).unwrap_or_default();
        self.line += passed.iter().filter(|&&sign| sign == b'\n').count() as u64;
        self.byte = byte;
        self.line
    }
}

/// A row of a table.
#[derive(Debug)]
pub struct Row<'a> {
    table: &'a Table<'a>,
    line: u64,
    cells: csv::StringRecord,
}

impl Row<'_> {
    /// Its line in the file, from 1.
    #[must_use]
    pub const fn line(&self) -> u64 {
        self.line
    }

    /// The text of the cell in a column, without space around it; empty where there is none.
    #[must_use]
    pub fn text(&self, column: usize) -> &str {
        self.cells.get(column).unwrap_or_default()
    }

    /// The number in a column; `None` where the cell is empty.
    ///
    /// # Errors
    /// If it is not a number, or if it could be two.
    pub fn number(&self, column: usize) -> Result<Option<f64>, TableError> {
        let text = self.text(column);
        // R writes `NA` where there is nothing.
        if text.is_empty() || text == "NA" {
            return Ok(None);
        }
        let number = self.table.marks.number(text, self.line, self.table.dialect.delimiter);
        number.map(Some).map_err(|problem| {
            let heading = self.table.headings.get(column).cloned().unwrap_or_default();
            self.wrong(Problem::Cell { heading, problem })
        })
    }

    /// The number in a column.
    ///
    /// # Errors
    /// As [`Row::number`], and where the cell is empty.
    pub fn expect_number(&self, column: usize) -> Result<f64, TableError> {
        self.number(column)?.ok_or_else(|| {
            let heading = self.table.headings.get(column).cloned().unwrap_or_default();
            self.wrong(Problem::Cell { heading, problem: "is empty, expected a number".to_owned() })
        })
    }

    fn wrong(&self, problem: Problem) -> TableError {
        self.table.wrong(self.line, problem)
    }
}

#[cfg(test)]
mod tests;
