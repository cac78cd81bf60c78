//! What is said of a first guess.

use pleach::{LooksLike, best_of_each_family};
use pleach_fit::FirstGuess;
use pleach_tree::Foliage;

/// The species that the goal looks like; `detected` says whether leaves were looked for.
pub(super) fn said(guess: &FirstGuess, detected: bool) -> String {
    let names = LooksLike::from_guess(Some(guess));
    let said: Vec<String> = (names.iter().take(3))
        .map(|LooksLike { species, confidence }| format!("{species} ({:.0} %)", 100.0 * confidence))
        .collect();
    let bare = if detected && guess.foliage == Foliage::None {
        ": a bare tree, so no leaves are grown (--leaves on grows them)"
    } else {
        ""
    };
    format!("looks like {}{bare}", said.join(", "))
}

/// The race of families, if there was one.
pub(super) fn raced(guess: &FirstGuess) -> Option<String> {
    let families = best_of_each_family(Some(guess));
    let (first, others) = families.split_first()?;
    let others: Vec<String> =
        others.iter().map(|one| format!("{} {:.2}, {:.3}", one.family, one.likeness, one.reached)).collect();
    Some(format!(
        "family {}: likeness at first {:.2}, cost after a short race {:.3}; {}",
        first.family,
        first.likeness,
        first.reached,
        others.join("; ")
    ))
}
