//! What a fit has found, for the page.

use crate::error::thrown;
use pleach::{COLUMNS, FitReport, FittedTree};
use serde_json::{Map, Value, json};
use wasm_bindgen::JsError;

/// The report, with what its JSON leaves out and the page shows: JSON.
pub(crate) fn to_json(report: &FitReport) -> Result<String, JsError> {
    let history: Map<String, Value> = COLUMNS
        .iter()
        .map(|column| {
            let values = report.fitted.outcome.history.iter().map(column.value).collect();
            (column.name.to_owned(), values)
        })
        .collect();
    let file = |tree: &FittedTree| tree.species.to_toml(&[]);
    Ok(json!({
        "report": serde_json::to_value(report).map_err(thrown)?,
        "verdict": report.verdict.map(|verdict| verdict.to_string()),
        "history": history,
        "toml": file(&report.kind),
        "own_toml": report.trees.first().map(file),
    })
    .to_string())
}
