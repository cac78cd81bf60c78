//! Grammars that are edited as text.

use crate::grammar_text::grammar_of;
use crate::species::Species;
use pleach_lsystem::{Diagnostic, Report, with_grammar};
use serde_json::{Value, json};
use wasm_bindgen::prelude::wasm_bindgen;

/// Most remarks on one text.
const MAX_REMARKS: usize = 50;

#[wasm_bindgen]
impl Species {
    /// The grammar as it was written. `undefined` of species of other families.
    #[must_use]
    pub fn grammar(&self) -> Option<String> {
        grammar_of(&self.inner)
    }

    /// The species with the grammar in `text`: JSON with its file (`toml`, null where the grammar is wrong) and
    /// `remarks` on places of the text, the first at the top.
    #[must_use]
    pub fn with_grammar(&self, text: &str) -> String {
        match with_grammar(&self.inner, text) {
            Ok(edited) => {
                let remarks = edited.warnings.as_ref().map_or_else(Vec::new, remarks);
                json!({"toml": edited.species.to_toml(&[]), "remarks": remarks})
            }
            Err(report) => json!({"toml": null, "remarks": remarks(&report)}),
        }
        .to_string()
    }
}

fn remarks(report: &Report) -> Vec<Value> {
    let remark = |Diagnostic { span, fault }: &Diagnostic| {
        let (line, column) = report.place(span.start);
        let (end_line, end_column) = report.place(span.end.max(span.start));
        json!({
            "line": line,
            "column": column,
            "end_line": end_line,
            "end_column": end_column,
            "warning": fault.is_warning(),
            "message": fault.to_string(),
            "help": fault.help(),
        })
    };
    report.diagnostics.iter().take(MAX_REMARKS).map(remark).collect()
}
