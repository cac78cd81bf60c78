//! What dividing a tree among threads costs: its parts are made one after the other on one thread, and timed.

use super::clock;
use pleach_tree::{Helpers, NextPart};
use std::mem;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// A piece of a tree's time.
#[derive(Clone, Debug)]
pub(crate) enum Piece {
    /// Seconds of one thread.
    Alone(f64),
    /// Seconds of each part that another thread may take.
    Parts(Vec<f64>),
}

/// As many threads as are asked for, which take parts in turn; all of them are the one that asks.
#[derive(Debug, Default)]
pub(crate) struct Divided {
    /// Threads among which trees are divided: no more than one where they are not.
    threads: AtomicUsize,
    log: Mutex<Log>,
}

#[derive(Debug, Default)]
struct Log {
    pieces: Vec<Piece>,
    /// How many pieces are being shared: a part may be shared in turn.
    depth: usize,
    /// Parts of the piece that is being shared, and what threads do once there are no more.
    parts: Vec<f64>,
    ends: Vec<f64>,
    /// When the last of them ended.
    last: f64,
}

impl Log {
    /// Seconds since the last call.
    fn lap(&mut self) -> f64 {
        let now = clock::of_thread();
        now - mem::replace(&mut self.last, now)
    }
}

impl Divided {
    /// What `work` returns, and its pieces if it is divided among `threads`.
    pub(crate) fn among<T>(&self, threads: usize, work: impl FnOnce() -> T) -> (T, Vec<Piece>) {
        self.threads.store(threads, Relaxed);
        self.log(Log::lap);
        let done = work();
        self.threads.store(0, Relaxed);
        let pieces = self.log(|log| {
            let rest = log.lap();
            log.pieces.push(Piece::Alone(rest));
            mem::take(&mut log.pieces)
        });
        (done, pieces)
    }

    fn log<T>(&self, change: impl FnOnce(&mut Log) -> T) -> T {
        change(&mut self.log.lock().expect("no panic"))
    }

    /// Thread `number` takes every so many parts. The next thread begins before this one ends, as it would.
    fn thread(&self, number: usize, parts: usize, work: &(dyn Fn(&mut NextPart<'_>) + Sync)) {
        let threads = self.threads.load(Relaxed);
        let mut own = (number..parts).step_by(threads);
        let mut taken = 0;
        work(&mut || {
            let seconds = self.log(Log::lap);
            if taken > 0 {
                self.log(|log| log.parts.push(seconds));
            }
            taken += 1;
            if taken == 2 && number + 1 < threads.min(parts) {
                self.thread(number + 1, parts, work);
            }
            own.next()
        });
        let seconds = self.log(Log::lap);
        self.log(|log| log.ends.push(seconds));
    }
}

impl Helpers for Divided {
    fn are_idle(&self) -> bool {
        self.threads.load(Relaxed) > 1
    }

    fn share(&self, parts: usize, work: &(dyn Fn(&mut NextPart<'_>) + Sync)) {
        let is_part = self.log(|log| {
            let before = log.lap();
            log.depth += 1;
            // What a part has done before it is shared is a part, and its own parts are as all others.
            if log.depth > 1 {
                log.parts.push(before)
            } else {
                log.pieces.push(Piece::Alone(before))
            }
            log.depth > 1
        });
        self.thread(0, parts, work);
        self.log(|log| {
            log.depth -= 1;
            if is_part {
                return;
            }
            let (mut parts, mut ends) = (mem::take(&mut log.parts), mem::take(&mut log.ends));
            // What threads do at their end, such as to lay what they have drawn over what another has, is shared but
            // for the last.
            ends.sort_unstable_by(f64::total_cmp);
            let last = ends.pop().unwrap_or_default();
            parts.extend(ends);
            log.pieces.extend([Piece::Parts(parts), Piece::Alone(last)]);
        });
    }
}
