//! The draws that gave no tree, as a table.

use crate::error::DatasetError;
use crate::example::Maker;
use crate::folder::{FAILURES, Folder};
use std::collections::BTreeMap;
use std::io;

/// A draw that gave no tree.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Failure {
    /// Its number among all draws of the data set.
    pub(crate) draw: u64,
    pub(crate) reason: String,
}

/// Failures of each shard that has any, in the order of draws.
pub(crate) type Failures = BTreeMap<u64, Vec<Failure>>;

const HEAD: [&str; 3] = ["species", "number", "reason"];

/// Writes the table.
pub(crate) fn write(
    folder: &Folder,
    maker: &Maker<'_>,
    names: &[String],
    failures: &Failures,
) -> Result<(), DatasetError> {
    folder.write(FAILURES, |file| {
        let mut table = csv::Writer::from_writer(file);
        table.write_record(HEAD)?;
        for failure in failures.values().flatten() {
            let (species, number) = maker.place(failure.draw);
            table.write_record([&names[species], &number.to_string(), &failure.reason])?;
        }
        table.flush()
    })
}

/// Reads what [`write`] wrote. Rows that are not those of this data set are left out: the shards that they are missing
/// in are then made again.
pub(crate) fn read(folder: &Folder, names: &[String], shard_draws: u64) -> Result<Failures, DatasetError> {
    let path = folder.at(FAILURES);
    let text = match std::fs::read_to_string(&path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => String::new(),
        text => text.map_err(DatasetError::io(&path, "cannot be read"))?,
    };
    let mut failures = Failures::new();
    for row in csv::Reader::from_reader(text.as_bytes()).records().map_while(Result::ok) {
        let cell = |place: usize| row.get(place).unwrap_or_default();
        let species = names.iter().position(|name| name == cell(0));
        let (Some(species), Ok(number)) = (species, cell(1).parse::<u64>()) else { continue };
        let draw = number * names.len() as u64 + species as u64;
        let rows = failures.entry(draw / shard_draws).or_default();
        rows.push(Failure { draw, reason: cell(2).to_owned() });
    }
    Ok(failures)
}
