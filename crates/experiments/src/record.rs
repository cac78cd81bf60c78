//! Rows as structs: a column is a field, declared once. Files hold text; these are the two ways.

use anyhow::Context;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;

/// A row of results as text.
pub(super) type Row = Vec<String>;

/// A row of results, whose fields are the columns.
pub(super) trait Record: Serialize + DeserializeOwned {}

impl<T: Serialize + DeserializeOwned> Record for T {}

/// The columns of rows like `example`: its fields, without those that it skips.
pub(super) fn columns(example: &impl Record) -> anyhow::Result<Vec<String>> {
    let mut csv = csv::Writer::from_writer(Vec::new());
    csv.serialize(example)?;
    let bytes = csv.into_inner().map_err(csv::IntoInnerError::into_error)?;
    Ok(csv::Reader::from_reader(bytes.as_slice()).headers()?.iter().map(str::to_owned).collect())
}

/// The cells of `record`.
pub(super) fn to_row(record: &impl Record) -> anyhow::Result<Row> {
    let mut csv = csv::WriterBuilder::new().has_headers(false).from_writer(Vec::new());
    csv.serialize(record)?;
    let bytes = csv.into_inner().map_err(csv::IntoInnerError::into_error)?;
    let mut csv = csv::ReaderBuilder::new().has_headers(false).from_reader(bytes.as_slice());
    let row = csv.records().next().context("a record has cells")??;
    Ok(row.iter().map(str::to_owned).collect())
}

/// The record in the cells of `row` under `columns`.
pub(super) fn from_row<R: Record>(row: &Row, columns: &[String]) -> anyhow::Result<R> {
    let header = csv::StringRecord::from(columns);
    let row = csv::StringRecord::from(row.as_slice());
    row.deserialize(Some(&header))
        .with_context(|| format!("the row {}", row.iter().collect::<Vec<_>>().join(",")))
}

/// A number that is written with this many decimals.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Fixed<const DECIMALS: usize>(pub(super) f64);

impl<const DECIMALS: usize> fmt::Display for Fixed<DECIMALS> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:.DECIMALS$}", self.0)
    }
}

impl<const DECIMALS: usize> Serialize for Fixed<DECIMALS> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de, const DECIMALS: usize> Deserialize<'de> for Fixed<DECIMALS> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        f64::deserialize(deserializer).map(Self)
    }
}

/// A number that is written with as many decimals as tell it from all others.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Exact(pub(super) f64);

impl Exact {
    /// To the nearest millionth.
    pub(super) fn millionths(value: f64) -> Self {
        Self((value * 1e6).round() / 1e6)
    }
}

impl Serialize for Exact {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&self.0)
    }
}

impl<'de> Deserialize<'de> for Exact {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        f64::deserialize(deserializer).map(Self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
    struct Tree {
        name: String,
        leaves: u64,
        height: Fixed<2>,
        cost: Exact,
        #[serde(skip_serializing_if = "Option::is_none")]
        wall_s: Option<Fixed<1>>,
    }

    #[test]
    fn fields_are_columns_and_cells_come_back() {
        let tree = |wall_s| Tree {
            name: "a, \"b\"".to_owned(),
            leaves: 7,
            height: Fixed(1.0),
            cost: Exact(f64::INFINITY),
            wall_s,
        };
        let timed = tree(Some(Fixed(0.25)));
        let names = columns(&timed).unwrap();
        assert_eq!(names, ["name", "leaves", "height", "cost", "wall_s"]);
        let row = to_row(&timed).unwrap();
        assert_eq!(row, ["a, \"b\"", "7", "1.00", "inf", "0.2"]);
        assert_eq!(from_row::<Tree>(&row, &names).unwrap(), Tree { wall_s: Some(Fixed(0.2)), ..timed });

        let plain = tree(None);
        let names = columns(&plain).unwrap();
        assert_eq!(names, ["name", "leaves", "height", "cost"]);
        let row = to_row(&plain).unwrap();
        assert_eq!(from_row::<Tree>(&row, &names).unwrap(), plain);
        assert!(from_row::<Tree>(&["a", "b", "c", "d"].map(str::to_owned).to_vec(), &names).is_err());
    }
}
