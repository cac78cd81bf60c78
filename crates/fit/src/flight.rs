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
use std::time::{Duration, Instant};

/// How long a thread sleeps that has found nothing to do while it waits for the others.
const NAP: Duration = Duration::from_millis(1);

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

    /// Takes the scores of the oldest `wanted` individuals, in their order; after `patience` only those that
    /// have come, up to the first that has not. None if scoring has panicked.
    pub(crate) fn land(&self, wanted: usize, patience: Duration) -> Option<Vec<Score>> {
        let deadline = Instant::now() + patience;
        let mut landings = self.board.lock();
        landings.wanted = wanted.min(landings.scores.len());
        landings.missing =
            landings.scores.iter().take(landings.wanted).filter(|score| score.is_none()).count();
        while landings.missing > 0 && !landings.failed {
            let left = deadline.saturating_duration_since(Instant::now());
            if left.is_zero() {
                break;
            }
            // On one of the pool's own threads to wait is to work.
            if rayon::current_thread_index().is_some() {
                drop(landings);
                let idle = rayon::yield_now() != Some(Yield::Executed);
                landings = self.board.lock();
                if idle && landings.missing > 0 {
                    landings = self.board.wait(landings, NAP.min(left));
                }
            } else {
                landings = self.board.wait(landings, left);
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
