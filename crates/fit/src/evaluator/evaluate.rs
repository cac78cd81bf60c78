//! The interface of a search to its objective.

use crate::problem::{Genome, Score, Size};

/// An objective that scores individuals.
pub trait Evaluate {
    /// The scores of `genomes`, in their order, the same on any number of threads. A tree larger than `max_size` may
    /// be abandoned and scored as invalid.
    fn scores(&self, genomes: &[Genome], max_size: Size) -> Vec<Score>;

    /// Likeness of `genome` to the goal, in 0..=1; `None` for objectives without pictures.
    fn likeness(&self, genome: &Genome) -> Option<f64> {
        let _ = genome;
        None
    }
}

impl<T: Evaluate + ?Sized> Evaluate for &T {
    fn scores(&self, genomes: &[Genome], max_size: Size) -> Vec<Score> {
        (**self).scores(genomes, max_size)
    }

    fn likeness(&self, genome: &Genome) -> Option<f64> {
        (**self).likeness(genome)
    }
}
