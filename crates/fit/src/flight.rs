//! Individuals that are scored while others are bred.
//!
//! Each is a task of its own for rayon's threads, in the order in which they were asked for. Scores are taken in
//! that order too, whichever is there first, so that nothing a search learns depends on the threads.

use crate::evaluate::Evaluate;
use crate::genome::{Genome, Score, Size};
use crate::solver::Batch;
use rayon::{ScopeFifo, Yield};
use std::collections::VecDeque;
use std::slice;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// How long a thread of the pool sleeps that has found nothing to do while it waits for the others.
const NAP: Duration = Duration::from_millis(1);
/// How long a thread sleeps that is none of the pool's, before it asks again whether it should go on waiting.
const SLEEP: Duration = Duration::from_millis(20);

/// Gives `work` a flight of individuals that `objective` scores, and ends when the last thread has let go of it.
///
/// # Panics
/// If scoring panics.
pub(crate) fn fly<'scope, O, R>(objective: &'scope O, work: impl FnOnce(Flight<'_, 'scope, O>) -> R) -> R
where
    O: Evaluate + Sync + ?Sized,
{
    rayon::in_place_scope_fifo(|scope| work(Flight { objective, scope, board: Arc::default() }))
}

/// Individuals that are being scored. Those that no thread has begun when it is dropped are never scored.
pub(crate) struct Flight<'s, 'scope, O: ?Sized> {
    objective: &'scope O,
    scope: &'s ScopeFifo<'scope>,
    board: Arc<Board>,
}

/// Where scores are put.
#[derive(Default)]
struct Board {
    landings: Mutex<Landings>,
    /// Notified when nobody who waits needs to wait any longer.
    enough: Condvar,
}

#[derive(Default)]
struct Landings {
    /// Number of the oldest individual whose score has not been taken.
    first: u64,
    /// Scores from that one on.
    scores: VecDeque<Option<Score>>,
    /// How many of them are waited for, and how many of those are not there.
    wanted: usize,
    missing: usize,
    /// Set when nothing more is to be scored.
    over: bool,
    /// Set when scoring has panicked: some scores will never be there.
    failed: bool,
}

impl<O: Evaluate + Sync + ?Sized> Flight<'_, '_, O> {
    /// Has the individuals of `batch` scored, after those before them.
    pub(crate) fn launch(&self, batch: Batch<'_>) {
        for genome in batch.genomes {
            let number = {
                let mut landings = self.board.lock();
                landings.scores.push_back(None);
                landings.first + landings.scores.len() as u64 - 1
            };
            let (objective, most, genome) = (self.objective, batch.most, genome.clone());
            let board = Arc::clone(&self.board);
            self.scope.spawn_fifo(move |_| score(objective, &genome, most, number, &board));
        }
    }

    /// Takes the scores of the oldest `wanted` individuals, in their order; once `is_late` says so, only those
    /// that have come, up to the first that has not. None if scoring has panicked.
    ///
    /// `is_late` is asked after each tree and after every few milliseconds of sleep: this module has no clock.
    pub(crate) fn land(&self, wanted: usize, is_late: impl Fn() -> bool) -> Option<Vec<Score>> {
        let mut landings = self.board.lock();
        landings.wanted = wanted.min(landings.scores.len());
        landings.missing =
            landings.scores.iter().take(landings.wanted).filter(|score| score.is_none()).count();
        while landings.missing > 0 && !landings.failed {
            // On one of the pool's own threads to wait is to work.
            if rayon::current_thread_index().is_some() {
                drop(landings);
                let idle = rayon::yield_now() != Some(Yield::Executed);
                landings = self.board.lock();
                if idle && landings.missing > 0 {
                    landings = self.board.wait(landings, NAP);
                }
            } else {
                landings = self.board.wait(landings, SLEEP);
            }
            if is_late() {
                break;
            }
        }
        if landings.failed {
            return None;
        }
        let there = landings.scores.iter().take(landings.wanted).take_while(|score| score.is_some()).count();
        landings.wanted = 0;
        landings.first += there as u64;
        Some(landings.scores.drain(..there).flatten().collect())
    }
}

impl<O: ?Sized> Drop for Flight<'_, '_, O> {
    fn drop(&mut self) {
        self.board.lock().over = true;
    }
}

impl Board {
    fn lock(&self) -> MutexGuard<'_, Landings> {
        self.landings.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn wait<'a>(&self, landings: MutexGuard<'a, Landings>, at_most: Duration) -> MutexGuard<'a, Landings> {
        self.enough.wait_timeout(landings, at_most).unwrap_or_else(PoisonError::into_inner).0
    }

    fn put(&self, number: u64, score: Score) {
        let mut landings = self.lock();
        let place = (number - landings.first) as usize;
        landings.scores[place] = Some(score);
        if place < landings.wanted {
            landings.missing -= 1;
            if landings.missing == 0 {
                self.enough.notify_all();
            }
        }
    }
}

/// Scores individual `number` and puts the score on the board.
fn score<O: Evaluate + ?Sized>(objective: &O, genome: &Genome, most: Size, number: u64, board: &Board) {
    if board.lock().over {
        return;
    }
    let unless_it_panics = Failure(board);
    let scores = objective.scores(slice::from_ref(genome), most);
    std::mem::forget(unless_it_panics);
    board.put(number, scores[0]);
}

/// Tells the board when it is dropped: scoring has not come to its end.
struct Failure<'a>(&'a Board);

impl Drop for Failure<'_> {
    fn drop(&mut self) {
        self.0.lock().failed = true;
        self.0.enough.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::panic::{AssertUnwindSafe, catch_unwind};
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

    fn batch(genomes: &[Genome]) -> Batch<'_> {
        Batch { genomes, most: Size::ANY }
    }

    fn costs(scores: Option<Vec<Score>>) -> Vec<f64> {
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
            fly(&gate, |flight| {
                flight.launch(batch(&genomes(&[5.0, 0.0])));
                flight.launch(batch(&genomes(&[6.0, 7.0])));
                while gate.scored.load(Ordering::Relaxed) < 3 {
                    std::thread::yield_now();
                }
                assert_eq!(costs(flight.land(4, late_after(5))), [5.0], "the second is not there");
                assert_eq!(costs(flight.land(3, late_after(5))), [0.0; 0]);
                gate.open.store(true, Ordering::Relaxed);
                assert_eq!(costs(flight.land(2, patient)), [0.0, 6.0]);
                assert_eq!(costs(flight.land(9, patient)), [7.0], "no more are out");
            });
        });
    }

    #[test]
    fn one_thread_is_enough_even_if_it_is_the_one_that_waits() {
        let gate = Gate { open: AtomicBool::new(true), ..Gate::default() };
        let taken = pool(1).install(|| {
            fly(&gate, |flight| {
                flight.launch(batch(&genomes(&[1.0, 2.0, 3.0])));
                costs(flight.land(3, patient))
            })
        });
        assert_eq!(taken, [1.0, 2.0, 3.0]);
    }

    #[test]
    fn what_no_thread_has_begun_at_the_end_is_never_scored() {
        let gate = Gate { open: AtomicBool::new(true), ..Gate::default() };
        pool(1).install(|| {
            fly(&gate, |flight| {
                flight.launch(batch(&genomes(&[1.0; 50])));
                let _ = flight.land(1, patient);
            });
        });
        assert!(gate.scored.into_inner() < 50);
    }

    #[test]
    fn a_panic_is_passed_on_and_nobody_waits_for_its_score() {
        let gate = Gate::default();
        let flown = catch_unwind(AssertUnwindSafe(|| {
            pool(2).install(|| {
                fly(&gate, |flight| {
                    flight.launch(batch(&genomes(&[-1.0])));
                    assert_eq!(flight.land(1, patient), None);
                });
            });
        }));
        assert!(flown.is_err());
    }
}
