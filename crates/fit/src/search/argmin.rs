//! Searches as solvers of argmin, for callers who use its executor and observers.

use super::ask_tell::{AskTell, Chunk};
use crate::evaluator::Evaluate;
use crate::problem::Genome;
use argmin::core::{Error, KV, PopulationState, Problem, Solver, TerminationReason, TerminationStatus};

/// The argmin state of an [`ArgminSolver`]: it holds the best of the last chunk, and argmin keeps the
/// best of all.
pub type FitState = PopulationState<Genome, f64>;

/// A search as a solver of argmin, for anything that is [`Evaluate`]. One iteration is one chunk.
///
/// [`crate::fit`] does not use it.
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
        let Chunk { genomes, max_size } = self.0.ask();
        let scores =
            problem.bulk_problem("cost_count", genomes.len(), |o| Ok(o.scores(genomes, max_size)))?;
        let best = self.0.tell(&scores).ok_or(EmptyChunk)?;
        Ok((state.individual(best.genome).cost(best.score.cost), None))
    }

    fn terminate(&mut self, _: &FitState) -> TerminationStatus {
        if self.0.has_ended() {
            TerminationStatus::Terminated(TerminationReason::MaxItersReached)
        } else {
            TerminationStatus::NotTerminated
        }
    }
}

/// A search that has not ended asked for no individuals: a mistake in its [`AskTell`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the search asked for no individuals")]
pub struct EmptyChunk;
