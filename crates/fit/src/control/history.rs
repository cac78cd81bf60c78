//! The history of a fit: one row per generation.

use serde::{Deserialize, Serialize};

/// The state of a search at the end of a generation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Number of the generation, from 1.
    pub generation: u64,
    /// Individuals evaluated so far.
    pub evaluations: u64,
    /// Cost of the best individual so far.
    pub best_cost: f64,
    /// Cost of the best individual of this generation.
    pub generation_best_cost: f64,
    /// Intersection over union of the best individual so far, in 0..=1.
    pub iou: f64,
    /// Pixel accuracy of the best individual so far, in 0..=1.
    pub accuracy: f64,
    /// Likeness of the best individual so far, in 0..=1; `None` for objectives without pictures.
    pub likeness: Option<f64>,
    /// Seconds so far by the caller's clock: the one column that differs between two runs.
    pub elapsed_s: f64,
}

/// One column of the history.
#[derive(Clone, Copy, Debug)]
pub struct Column {
    /// Its name.
    pub name: &'static str,
    /// One line about it.
    pub doc: &'static str,
    /// Whether it depends on the clock and so is never compared.
    pub is_time: bool,
    /// Its value in a row.
    pub value: fn(&Row) -> f64,
}

/// The columns of `history.csv`.
pub const COLUMNS: [Column; 8] = [
    Column {
        name: "generation",
        doc: "number of the generation, from 1",
        is_time: false,
        value: |row| row.generation as f64,
    },
    Column {
        name: "evaluations",
        doc: "trees grown and scored so far",
        is_time: false,
        value: |row| row.evaluations as f64,
    },
    Column {
        name: "best_cost",
        doc: "cost of the best individual so far",
        is_time: false,
        value: |row| row.best_cost,
    },
    Column {
        name: "generation_best_cost",
        doc: "cost of the best individual of this generation",
        is_time: false,
        value: |row| row.generation_best_cost,
    },
    Column {
        name: "iou",
        doc: "intersection over union of the best individual so far",
        is_time: false,
        value: |row| row.iou,
    },
    Column {
        name: "accuracy",
        doc: "pixel accuracy of the best individual so far",
        is_time: false,
        value: |row| row.accuracy,
    },
    Column {
        name: "likeness",
        doc: "likeness of the best individual so far",
        is_time: false,
        value: |row| row.likeness.unwrap_or(f64::NAN),
    },
    Column {
        name: "elapsed_s",
        doc: "seconds so far (wall clock, not comparable)",
        is_time: true,
        value: |row| row.elapsed_s,
    },
];

impl Row {
    /// The row's values in the order of [`COLUMNS`], as text that reads back to the same number.
    pub fn cells(&self) -> impl Iterator<Item = String> + '_ {
        COLUMNS.iter().map(|column| format!("{}", (column.value)(self)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_read_back_and_one_column_is_time() {
        let row = Row {
            generation: 3,
            evaluations: 60,
            best_cost: 0.1 + 0.2,
            generation_best_cost: f64::INFINITY,
            iou: 1.0 / 3.0,
            accuracy: 1.0,
            likeness: Some(0.5),
            elapsed_s: 0.25,
        };
        let numbers: Vec<f64> = row.cells().map(|cell| cell.parse().unwrap()).collect();
        let values: Vec<f64> = COLUMNS.iter().map(|column| (column.value)(&row)).collect();
        assert_eq!(numbers, values);
        assert_eq!(values, [3.0, 60.0, 0.1 + 0.2, f64::INFINITY, 1.0 / 3.0, 1.0, 0.5, 0.25]);
        let time: Vec<&str> = COLUMNS.iter().filter(|c| c.is_time).map(|c| c.name).collect();
        assert_eq!(time, ["elapsed_s"]);
    }
}
