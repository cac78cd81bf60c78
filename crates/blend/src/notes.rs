//! The provenance in the file of a blend.

use crate::plane::{Point, readable};

/// Lines for the head of a blend's species file: what it is made of, where on a map of how many species it stands,
/// and how far outside their hull, if it is.
#[must_use]
pub fn notes(recipe: &str, place: Option<(Point, usize)>, outside: f64) -> Vec<String> {
    let rounded = |value: f64| readable((value * 1e4).round() / 1e4);
    let mut lines = vec![format!("A blend: {recipe}")];
    if let Some((Point { x, y }, count)) = place {
        lines.push(format!("At {},{} of a map of {count} species", rounded(x), rounded(y)));
    }
    if outside > 0.0 {
        lines.push(format!("Extrapolated: {} outside the hull of the species", rounded(outside)));
    }
    lines
}
