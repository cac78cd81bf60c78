//! Tests of the whole crate, in one program so that it is linked once.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod behaviour;
mod conformance;
mod figures;
mod golden;

use pleach_fractal::FractalFamily;
use pleach_tree::param::SlotError;
use pleach_tree::species::preset;
use pleach_tree::{GrowError, Species, Tree};

/// A species with some numbers changed.
fn with(name: &str, set: &[(&str, f64)]) -> Result<Species, SlotError> {
    let species = preset(&FractalFamily, name).unwrap();
    let space = species.generator.space();
    let mut values = species.params.values().to_vec();
    set.iter().for_each(|(name, value)| values[space.find(name).unwrap().0] = *value);
    let params = space.check(values)?;
    Ok(Species { params, ..species })
}

/// The tree of seed 1 with some numbers changed.
fn grown(name: &str, set: &[(&str, f64)]) -> Tree {
    try_grown(name, set).unwrap()
}

fn try_grown(name: &str, set: &[(&str, f64)]) -> Result<Tree, GrowError> {
    with(name, set).unwrap().grow(1)
}

/// Number of branches: pieces of stems.
fn branches(tree: &Tree) -> usize {
    tree.knots.len() - tree.stems.len()
}
