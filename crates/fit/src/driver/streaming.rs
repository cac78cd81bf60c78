//! A driver as a solver of argmin whose individuals are scored while others are bred.

use super::{Driver, State};
use crate::evaluate::Evaluate;
use crate::flight::Flight;
use crate::solver::{AskTell as _, EmptyBatch, FitState};
use argmin::core::{Error, KV, Problem, Solver, TerminationReason, TerminationStatus};

/// One iteration takes the scores of what is left of a brood, or what has come of them by the next look.
pub(super) struct Streaming<'f, 'scope, 'a, 'e, M, O: ?Sized> {
    pub(super) driver: Driver<'a, 'e, M>,
    pub(super) flight: Flight<'f, 'scope, O>,
}

impl<'scope, M: State, O: Evaluate + Sync + ?Sized> Solver<&'scope O, FitState>
    for Streaming<'_, 'scope, '_, '_, M, O>
{
    fn name(&self) -> &str {
        self.driver.course.search.name()
    }

    fn next_iter(
        &mut self,
        problem: &mut Problem<&'scope O>,
        state: FitState,
    ) -> Result<(FitState, Option<KV>), Error> {
        let Self { driver, flight } = self;
        let search = &mut driver.course.search;
        loop {
            let batch = search.ask();
            if batch.genomes.is_empty() {
                break;
            }
            flight.launch(batch);
        }
        let wanted = search.awaited();
        let landed = flight.land(wanted, driver.until_a_look()).ok_or(EmptyBatch)?;
        let search = &mut driver.course.search;
        let scores = problem.bulk_problem("cost_count", landed.len(), |_| Ok(landed))?;
        let Some(best) = search.tell(&scores) else { return Ok((state, None)) };
        driver.after_scores();
        Ok((state.individual(best.genome).cost(best.score.cost), None))
    }

    fn terminate(&mut self, _: &FitState) -> TerminationStatus {
        // The reason is told in our own words by `Outcome::stop`.
        let reason = |stop: crate::budget::StopReason| TerminationReason::SolverExit(stop.to_string());
        let verdict = self.driver.verdict().map(reason);
        verdict.map_or(TerminationStatus::NotTerminated, TerminationStatus::Terminated)
    }
}
