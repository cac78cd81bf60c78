//! Counts of the book's plane and space curves, step by step.

use crate::table::rows;
use pleach_lsystem::{Derivation, LSystem};

/// A row of the table as a grammar.
pub(crate) fn grammar(row: &[String]) -> String {
    let modules = if row[3].contains("Fl") || row[3].contains("Fr") { "module Fl = F, Fr = F\n" } else { "" };
    // The flowering plant uses the letter G as a symbol of its own.
    let modules = if row[0] == "plant_flowering" { "module G\n" } else { modules };
    let rules = row[4].replace(" ; ", "\n");
    format!("{modules}angle: {}\nsteps: {}\naxiom: {}\n{rules}\n", row[5], row[6], row[3])
}

#[test]
fn counts_of_the_classics() {
    for row in rows(include_str!("../data/lsystems_classic.csv")) {
        let name = &row[0];
        let system = LSystem::read(name, &grammar(&row)).unwrap_or_else(|e| panic!("{e}"));
        for (step, count) in row[7].split(' ').enumerate() {
            let derivation = Derivation { steps: Some(step), ..Derivation::default() };
            let derived = system.derive(&derivation).unwrap();
            let drawn: usize = ["F", "Fl", "Fr"].iter().map(|f| derived.count(f)).sum();
            assert_eq!(drawn.to_string(), count, "{name} after {step}");
        }
        let derived = system.derive(&Derivation::default()).unwrap();
        assert_eq!(derived.len().to_string(), row[8], "symbols of {name}");
    }
}
