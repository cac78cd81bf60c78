//! A first guess: which known species a goal looks like, and the lists that a search may start from.
//!
//! Candidates may be of any family of generators; each grows its own trees. Where they are of several generators, the
//! likeliest are each searched for a short while ([`RaceSettings`]); the winner by cost reached and by likeness
//! before the race is searched on, from lists of that generator alone.
//!
//! Trees of all candidates are grown as they are and with their numbers varied, drawn finely, laid into the goal's
//! frame at the goal's height, and compared by likeness, which recognises a species by other trees than the goal's.
//! Of many candidates, one tree each is compared at first, and more of those that are near. A [`GuessLibrary`] keeps
//! the drawings from goal to goal; those of known species may be built in ([`Drawings`]).
//!
//! Drawings are from the front. For goals from elsewhere, and for several, trees of all candidates would have to be
//! grown: the front drawings choose a few candidates instead, whatever the view, and these alone are grown and
//! compared in the goals' own views (`preview.rs`).
//!
//! The same drawings show whether the goal has leaves, and give reference values for a likeness.

mod candidate;
mod comparison;
mod contradiction;
mod drawings;
mod first_guess;
mod found;
mod goal_context;
mod learnt;
mod leaves;
mod library;
mod measured;
mod near;
mod predicted;
mod preview;
mod race;
mod ranking;
mod references;
mod samples;
mod settings;
mod silhouettes;

pub use candidate::Candidate;
pub use drawings::{Drawings, DrawingsError};
pub use first_guess::first_guess;
pub(crate) use first_guess::{Guessed, OpenGuess};
pub use found::{FirstGuess, Guess, Reference, References, Runner};
pub use library::GuessLibrary;
pub use race::Leg;
pub use settings::{Contradictions, GuessSettings, RaceCriterion, RaceSettings};
