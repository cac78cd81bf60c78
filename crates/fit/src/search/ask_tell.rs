//! Asking a search for individuals, and telling it their scores.

use crate::problem::{Genome, Score, Scored, Size};

/// Individuals that need scores.
#[derive(Clone, Copy, Debug)]
pub struct Chunk<'a> {
    /// The individuals; empty if the search needs earlier scores first.
    pub genomes: &'a [Genome],
    /// A tree larger than this may be abandoned and scored as invalid.
    pub max_size: Size,
}

/// A search that is asked for individuals and told their scores, chunk by chunk.
pub trait AskTell {
    /// A short name.
    fn name(&self) -> &str;

    /// The next individuals, all of one batch of the method. May be called again before the scores of the last
    /// ones are told. If every score has been told and the search has not ended, there is at least one.
    fn ask(&mut self) -> Chunk<'_>;

    /// Takes the scores of the oldest individuals without a score, in the order in which they were asked for; not
    /// more than are left of their batch. Returns the best of them, `None` for no scores.
    fn tell(&mut self, scores: &[Score]) -> Option<Scored>;

    /// Whether the search has ended.
    fn has_ended(&self) -> bool;
}
