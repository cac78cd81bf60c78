//! A work queue of individuals that are scored while others are made.
//!
//! Each individual is a task of its own for rayon's threads, in the order of submission. Scores are collected in
//! that order too, whichever is ready first, so that nothing a search learns depends on the threads.

use crate::evaluator::Evaluate;
use crate::problem::{Genome, Score, Size};
use crate::search::Chunk;
use rayon::{ScopeFifo, Yield};
use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::slice;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// How long a thread of the pool sleeps that has found no task while it waits for scores.
const POOL_SLEEP: Duration = Duration::from_millis(1);
/// How long a thread outside the pool sleeps before it asks again whether to go on waiting.
const SLEEP: Duration = Duration::from_millis(20);

/// Calls `work` with a queue whose individuals `objective` scores. Returns once no thread works for the queue.
pub(super) fn with_queue<'scope, O, R>(
    objective: &'scope O,
    work: impl FnOnce(WorkQueue<'_, 'scope, O>) -> R,
) -> R
where
    O: Evaluate + Sync + ?Sized,
{
    rayon::in_place_scope_fifo(|scope| work(WorkQueue { objective, scope, shared: Arc::default() }))
}

/// Individuals that are being scored. When it is dropped, those that no thread has begun are never scored.
pub(super) struct WorkQueue<'s, 'scope, O: ?Sized> {
    objective: &'scope O,
    scope: &'s ScopeFifo<'scope>,
    shared: Arc<Shared>,
}

/// Scoring an individual panicked: its message.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct ScoringPanicked(pub(super) String);

/// What the threads share.
#[derive(Default)]
struct Shared {
    scores: Mutex<Scores>,
    /// Notified when the awaited scores are there, or will never be.
    ready: Condvar,
}

#[derive(Default)]
struct Scores {
    /// Number of the oldest individual whose score has not been collected.
    first: u64,
    /// Scores from that one on.
    queue: VecDeque<Option<Score>>,
    /// How many of them are awaited, and how many of those are missing.
    awaited: usize,
    missing: usize,
    /// Set when the queue is dropped.
    is_closed: bool,
    /// Set when scoring has panicked: some scores will never be there.
    panic: Option<ScoringPanicked>,
}

impl<O: Evaluate + Sync + ?Sized> WorkQueue<'_, '_, O> {
    /// Adds the individuals of `chunk` to the end of the queue.
    pub(super) fn submit(&self, chunk: Chunk<'_>) {
        for genome in chunk.genomes {
            let number = {
                let mut scores = self.shared.lock();
                scores.queue.push_back(None);
                scores.first + scores.queue.len() as u64 - 1
            };
            let (objective, max_size, genome) = (self.objective, chunk.max_size, genome.clone());
            let shared = Arc::clone(&self.shared);
            self.scope.spawn_fifo(move |_| score(objective, &genome, max_size, number, &shared));
        }
    }

    /// Takes the scores of the oldest `awaited` individuals, in their order; once `is_late` returns true, only
    /// those that are there, up to the first that is missing.
    ///
    /// `is_late` is called after each tree and after every few milliseconds of sleep: this module has no clock.
    ///
    /// # Errors
    /// If scoring an individual of the queue has panicked.
    pub(super) fn collect(
        &self,
        awaited: usize,
        is_late: impl Fn() -> bool,
    ) -> Result<Vec<Score>, ScoringPanicked> {
        let mut scores = self.shared.lock();
        scores.awaited = awaited.min(scores.queue.len());
        scores.missing = scores.queue.iter().take(scores.awaited).filter(|score| score.is_none()).count();
        while scores.missing > 0 && scores.panic.is_none() {
            // A thread of the pool scores trees itself while it waits.
            if rayon::current_thread_index().is_some() {
                drop(scores);
                let is_idle = rayon::yield_now() != Some(Yield::Executed);
                scores = self.shared.lock();
                if is_idle && scores.missing > 0 {
                    scores = self.shared.wait(scores, POOL_SLEEP);
                }
            } else {
                scores = self.shared.wait(scores, SLEEP);
            }
            if is_late() {
                break;
            }
        }
        if let Some(panic) = &scores.panic {
            return Err(panic.clone());
        }
        let there = scores.queue.iter().take(scores.awaited).take_while(|score| score.is_some()).count();
        scores.awaited = 0;
        scores.first += there as u64;
        Ok(scores.queue.drain(..there).flatten().collect())
    }
}

impl<O: ?Sized> Drop for WorkQueue<'_, '_, O> {
    fn drop(&mut self) {
        self.shared.lock().is_closed = true;
    }
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, Scores> {
        self.scores.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn wait<'a>(&self, scores: MutexGuard<'a, Scores>, at_most: Duration) -> MutexGuard<'a, Scores> {
        self.ready.wait_timeout(scores, at_most).unwrap_or_else(PoisonError::into_inner).0
    }

    fn put(&self, number: u64, score: Score) {
        let mut scores = self.lock();
        let index = (number - scores.first) as usize;
        scores.queue[index] = Some(score);
        if index < scores.awaited {
            scores.missing -= 1;
            if scores.missing == 0 {
                self.ready.notify_all();
            }
        }
    }
}

/// Scores individual `number` and hands in its score.
fn score<O: Evaluate + ?Sized>(objective: &O, genome: &Genome, max_size: Size, number: u64, shared: &Shared) {
    if shared.lock().is_closed {
        return;
    }
    // The search ends with the panic, so nobody sees a state that it has left half changed.
    match catch_unwind(AssertUnwindSafe(|| objective.scores(slice::from_ref(genome), max_size)[0])) {
        Ok(score) => shared.put(number, score),
        Err(payload) => {
            let text = payload.downcast_ref::<&str>().map(|text| (*text).to_owned());
            let text = text.or_else(|| payload.downcast_ref::<String>().cloned());
            shared.lock().panic = Some(ScoringPanicked(text.unwrap_or_default()));
            shared.ready.notify_all();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

    /// The first value of an individual is its cost; one of zero waits until `open` is set.
    #[derive(Default)]
    struct Gate {
        open: AtomicBool,
        scored: AtomicUsize,
    }

    impl Evaluate for Gate {
        fn scores(&self, genomes: &[Genome], _: Size) -> Vec<Score> {
            assert_eq!(genomes.len(), 1);
            let cost = genomes[0].values[0];
            assert!(cost >= 0.0, "a cost below zero");
            while cost == 0.0 && !self.open.load(Ordering::Relaxed) {
                std::thread::yield_now();
            }
            self.scored.fetch_add(1, Ordering::Relaxed);
            vec![Score::from_cost(cost)]
        }
    }

    fn genomes(costs: &[f64]) -> Vec<Genome> {
        costs.iter().map(|&cost| Genome::new(vec![cost], 1)).collect()
    }

    fn chunk(genomes: &[Genome]) -> Chunk<'_> {
        Chunk { genomes, max_size: Size::ANY }
    }

    fn costs(scores: Result<Vec<Score>, ScoringPanicked>) -> Vec<f64> {
        scores.unwrap().iter().map(|score| score.cost).collect()
    }

    fn pool(threads: usize) -> rayon::ThreadPool {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap()
    }

    /// Never late.
    fn patient() -> bool {
        false
    }

    /// Late from the `turns`-th question on.
    fn late_after(turns: usize) -> impl Fn() -> bool {
        let asked = AtomicUsize::new(0);
        move || asked.fetch_add(1, Ordering::Relaxed) >= turns
    }

    #[test]
    fn scores_are_taken_in_order_whichever_comes_first() {
        pool(3).install(|| {
            let gate = Gate::default();
            with_queue(&gate, |queue| {
                queue.submit(chunk(&genomes(&[5.0, 0.0])));
                queue.submit(chunk(&genomes(&[6.0, 7.0])));
                while gate.scored.load(Ordering::Relaxed) < 3 {
                    std::thread::yield_now();
                }
                assert_eq!(costs(queue.collect(4, late_after(5))), [5.0], "the second is not there");
                assert_eq!(costs(queue.collect(3, late_after(5))), [0.0; 0]);
                gate.open.store(true, Ordering::Relaxed);
                assert_eq!(costs(queue.collect(2, patient)), [0.0, 6.0]);
                assert_eq!(costs(queue.collect(9, patient)), [7.0], "no more are queued");
            });
        });
    }

    #[test]
    fn one_thread_is_enough_even_if_it_is_the_one_that_waits() {
        let gate = Gate { open: AtomicBool::new(true), ..Gate::default() };
        let taken = pool(1).install(|| {
            with_queue(&gate, |queue| {
                queue.submit(chunk(&genomes(&[1.0, 2.0, 3.0])));
                costs(queue.collect(3, patient))
            })
        });
        assert_eq!(taken, [1.0, 2.0, 3.0]);
    }

    #[test]
    fn what_no_thread_has_begun_at_the_end_is_never_scored() {
        let gate = Gate { open: AtomicBool::new(true), ..Gate::default() };
        pool(1).install(|| {
            with_queue(&gate, |queue| {
                queue.submit(chunk(&genomes(&[1.0; 50])));
                let _ = queue.collect(1, patient);
            });
        });
        assert!(gate.scored.into_inner() < 50);
    }

    #[test]
    fn a_panic_is_an_error_and_nothing_waits_for_its_score() {
        let gate = Gate::default();
        let collected = pool(2).install(|| {
            with_queue(&gate, |queue| {
                queue.submit(chunk(&genomes(&[-1.0])));
                queue.collect(1, patient)
            })
        });
        assert_eq!(collected, Err(ScoringPanicked("a cost below zero".to_owned())));
    }
}
