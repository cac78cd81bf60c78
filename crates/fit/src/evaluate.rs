//! What a search asks of the things that it searches for.

use crate::genome::{Genome, Score, Size};

/// What individuals are scored against.
pub trait Evaluate {
    /// The scores of `genomes`, in their order, the same on any number of threads. A tree larger than
    /// `most` may be given up as one that does not grow.
    fn scores(&self, genomes: &[Genome], most: Size) -> Vec<Score>;

    /// Likeness of `genome` to the goal, in 0..=1; none for what is not a picture.
    fn likeness(&self, genome: &Genome) -> Option<f64> {
        let _ = genome;
        None
    }
}

impl<T: Evaluate + ?Sized> Evaluate for &T {
    fn scores(&self, genomes: &[Genome], most: Size) -> Vec<Score> {
        (**self).scores(genomes, most)
    }

    fn likeness(&self, genome: &Genome) -> Option<f64> {
        (**self).likeness(genome)
    }
}
