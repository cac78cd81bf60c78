//! A method at work in a space: it is asked for individuals and told their scores.

mod argmin;
mod ask_tell;
mod finalists;
mod generations;
#[cfg(test)]
mod known_minima;
mod state;

pub use argmin::{ArgminSolver, EmptyChunk, FitState};
pub use ask_tell::{AskTell, Chunk};
pub use generations::Search;
pub use state::SearchState;
