//! Ask, score, tell, as argmin's executor runs it.

use crate::evaluate::Evaluate;
use crate::genome::{Genome, Score, Scored, Size};
use argmin::core::{Error, KV, PopulationState, Problem, Solver, TerminationReason, TerminationStatus};

/// Individuals that wait for their scores.
#[derive(Clone, Copy, Debug)]
pub struct Batch<'a> {
    /// The individuals; none if the search has to be told of earlier ones first.
    pub genomes: &'a [Genome],
    /// A tree larger than this may be given up as one that does not grow.
    pub most: Size,
}

/// A search that is asked for individuals and told their scores, batch by batch.
pub trait AskTell {
    /// A short name.
    fn name(&self) -> &str;

    /// The next individuals, all bred at once. May be asked before the last ones are told; with none
    /// untold it gives one at least, unless the search has ended.
    fn ask(&mut self) -> Batch<'_>;

    /// Takes the scores of the oldest individuals that were asked for and not told, in their order, not
    /// beyond the end of what was bred at once; the best of them, none of no scores.
    fn tell(&mut self, scores: &[Score]) -> Option<Scored>;

    /// Why the search has ended, if it has.
    fn ended(&self) -> Option<TerminationReason>;
}

/// The argmin state of an [`ArgminSolver`]: it holds the best of the last batch, and argmin keeps the
/// best of all.
pub type FitState = PopulationState<Genome, f64>;

/// A search as a solver of argmin, for anything that is [`Evaluate`]. One iteration is one batch.
#[derive(Clone, Debug)]
pub struct ArgminSolver<S>(pub S);

impl<O: Evaluate, S: AskTell> Solver<O, FitState> for ArgminSolver<S> {
    fn name(&self) -> &str {
        self.0.name()
    }

    fn next_iter(
        &mut self,
        problem: &mut Problem<O>,
        state: FitState,
    ) -> Result<(FitState, Option<KV>), Error> {
        let Batch { genomes, most } = self.0.ask();
        let scores = problem.bulk_problem("cost_count", genomes.len(), |o| Ok(o.scores(genomes, most)))?;
        let best = self.0.tell(&scores).ok_or(EmptyBatch)?;
        Ok((state.individual(best.genome).cost(best.score.cost), None))
    }

    fn terminate(&mut self, _: &FitState) -> TerminationStatus {
        self.0.ended().map_or(TerminationStatus::NotTerminated, TerminationStatus::Terminated)
    }
}

/// A search that has not ended asked for nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the search asked for no individuals")]
pub struct EmptyBatch;
