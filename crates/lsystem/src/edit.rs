//! Another grammar for a species: what an editor does.

use crate::diagnostic::Report;
use crate::generator::GrammarGenerator;
use pleach_tree::{Generator, Species};
use std::sync::Arc;

/// A species with another grammar.
#[derive(Clone, Debug)]
pub struct Edited {
    /// The species.
    pub species: Species,
    /// What is odd about the grammar and not wrong.
    pub warnings: Option<Report>,
}

/// `species` with the grammar in `text`, which its file then has with its comments.
///
/// A number that is not its parameter's default stays, where the grammar in `text` declares that parameter with the
/// same default and allows the number; all others are the new defaults. So whatever was changed last counts.
///
/// # Errors
/// Everything that is wrong with the grammar, with its places.
pub fn with_grammar(species: &Species, text: &str) -> Result<Edited, Report> {
    let generator = GrammarGenerator::read(text)?;
    let space = Arc::clone(generator.space());
    let mut values = space.defaults();
    for slot in space.slots() {
        let old = changed(species, &space.slot_name(slot), space.default_of(slot));
        if let Some(old) = old.filter(|&old| space.check_slot(slot, old).is_ok()) {
            values[slot.index()] = old;
        }
    }
    let params = space.check(values).unwrap_or_else(|error| panic!("each was checked: {error}"));
    let warnings = generator.system().warnings();
    Ok(Edited { species: Species { generator: Arc::new(generator), params, ..species.clone() }, warnings })
}

/// The number of a slot, if it was declared with this default and has another number.
fn changed(species: &Species, name: &str, default: f64) -> Option<f64> {
    let space = species.generator.space();
    let slot = space.slots().find(|&slot| space.slot_name(slot) == name)?;
    let value = species.params.values()[slot.index()];
    (space.default_of(slot) == default && value != default).then_some(value)
}
