//! The grammar that a species has, and where in it something is.

use pleach::{GrowError, SpeciesDoc};
use pleach_lsystem::LSystem;

/// The grammar as it was written. `None` of species of other families.
pub(crate) fn grammar_of(species: &pleach::Species) -> Option<String> {
    let doc = SpeciesDoc::parse("species", &species.generator.written()).ok()?;
    doc.text("grammar").ok().flatten().map(str::to_owned)
}

/// The line of the grammar that keeps the species from growing, from 1. `None` where no line does.
pub(crate) fn line_of(species: &pleach::Species, error: &GrowError) -> Option<usize> {
    let blame = match error {
        GrowError::Rule { line, .. } => return Some(*line),
        GrowError::TooManyStems { blame, .. }
        | GrowError::TooManyLeaves { blame, .. }
        | GrowError::TooManyKnots { blame, .. }
        | GrowError::TooMuchWork { blame, .. } => blame,
        _ => return None,
    };
    let system = LSystem::read("grammar", &grammar_of(species)?).ok()?;
    blame.0.iter().find_map(|name| system.place_of(name)).map(|(line, _)| line)
}
