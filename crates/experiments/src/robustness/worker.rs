//! Cases on threads of their own, where neither a panic nor a hang ends the run.
//!
//! Each worker is the one thread of a rayon pool of its own: whatever a case does in parallel happens
//! on it. So `catch_unwind` around the case sees every panic, and the time of the thread is the time
//! of the case. A case that does not come back is counted and its worker left to itself; another one
//! takes its place. What ends the whole process, a stack or a memory that runs out, cannot be held
//! here: it ends the experiment, at a block that `--resume` finds again.

use super::areas::Area;
use super::verdict::Verdict;
use crate::stop;
use anyhow::{Context, bail};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::ops::Range;
use std::panic::{self, AssertUnwindSafe};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The outcome of a case, and its thread's computing time.
#[derive(Clone, Debug)]
pub(super) struct Judged {
    pub(super) verdict: Verdict,
    pub(super) cpu: Duration,
}

/// A worker's current case, for its watcher.
struct Watched {
    case: u64,
    begun: Duration,
    clock: ThreadClock,
}

type Slot = Arc<Mutex<Option<Watched>>>;

/// Cases that never came back, beyond which a run makes no sense.
const MAX_LOST: usize = 8;
/// A case that is left to itself has had this many times its limit.
const PATIENCE: u32 = 2;

/// Runs the cases in `range` on `threads` threads, in whatever order.
pub(super) fn run(
    area: &Arc<dyn Area>,
    range: Range<u64>,
    threads: usize,
    limit: Duration,
) -> anyhow::Result<BTreeMap<u64, Judged>> {
    let next = Arc::new(AtomicU64::new(range.start));
    let (sender, results): (Sender<(u64, Judged)>, Receiver<(u64, Judged)>) = channel();
    let begin = || -> anyhow::Result<Slot> {
        let slot = Slot::default();
        let worker = Worker {
            area: Arc::clone(area),
            next: Arc::clone(&next),
            end: range.end,
            limit,
            slot: Arc::clone(&slot),
            sender: sender.clone(),
            folder: tempfile::tempdir().context("no temporary folder")?,
        };
        let thread = std::thread::Builder::new().name("case".to_owned());
        thread.spawn(move || worker.run()).context("no thread for a case")?;
        Ok(slot)
    };
    let mut slots: Vec<Slot> = (0..threads).map(|_| begin()).collect::<anyhow::Result<_>>()?;
    let mut judged = BTreeMap::new();
    let mut lost = 0;
    while (judged.len() as u64) < range.end - range.start {
        match results.recv_timeout(Duration::from_millis(200)) {
            Ok((case, result)) => {
                judged.entry(case).or_insert(result);
            }
            Err(RecvTimeoutError::Disconnected) => bail!("all workers are gone"),
            Err(RecvTimeoutError::Timeout) => {
                for slot in &mut slots {
                    let Some((case, cpu)) = used(slot).filter(|(_, cpu)| *cpu > PATIENCE * limit) else {
                        continue;
                    };
                    judged.entry(case).or_insert(Judged { verdict: Verdict::OverTime, cpu });
                    lost += 1;
                    if lost > MAX_LOST {
                        bail!("{lost} cases did not come back, the last one {} {case}", area.name());
                    }
                    *slot = begin()?;
                }
            }
        }
        if stop::is_raised() {
            next.store(range.end, Ordering::SeqCst);
            stop::check()?;
        }
    }
    Ok(judged)
}

/// A worker's current case, and the computing time spent on it.
fn used(slot: &Slot) -> Option<(u64, Duration)> {
    let slot = slot.lock().unwrap_or_else(PoisonError::into_inner);
    let watched = slot.as_ref()?;
    Some((watched.case, watched.clock.now().saturating_sub(watched.begun)))
}

struct Worker {
    area: Arc<dyn Area>,
    next: Arc<AtomicU64>,
    end: u64,
    limit: Duration,
    slot: Slot,
    sender: Sender<(u64, Judged)>,
    folder: tempfile::TempDir,
}

thread_local! {
    /// The message of the last panic of a case on this thread; `None` outside of cases.
    static SAID: RefCell<Option<String>> = const { RefCell::new(None) };
}

impl Worker {
    fn run(self) {
        // If there is no pool, cases run in the global one, and panics come back all the same.
        let _pool = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
        let clock = ThreadClock::here();
        loop {
            let case = self.next.fetch_add(1, Ordering::SeqCst);
            if case >= self.end {
                return;
            }
            let begun = clock.now();
            self.watch(Some(Watched { case, begun, clock: clock.clone() }));
            let mut verdict = contained(self.area.as_ref(), case, self.folder.path());
            self.watch(None);
            let cpu = clock.now().saturating_sub(begun);
            if cpu > self.limit && !matches!(verdict, Verdict::Wrong(_) | Verdict::Panicked(_)) {
                verdict = Verdict::OverTime;
            }
            if self.sender.send((case, Judged { verdict, cpu })).is_err() {
                return;
            }
        }
    }

    fn watch(&self, watched: Option<Watched>) {
        *self.slot.lock().unwrap_or_else(PoisonError::into_inner) = watched;
    }
}

/// The verdict on a case; a panic is one.
fn contained(area: &dyn Area, case: u64, folder: &Path) -> Verdict {
    SAID.set(Some(String::new()));
    // A case shares no state that it changes: half-done work of a panic is dropped with it.
    let verdict = panic::catch_unwind(AssertUnwindSafe(|| area.judge(case, folder)));
    let said = SAID.take().unwrap_or_default();
    verdict.unwrap_or(Verdict::Panicked(said))
}

/// Keeps the messages of panics of cases, instead of printing them, while `work` runs.
pub(super) fn quietly<T>(work: impl FnOnce() -> T) -> T {
    let before: Arc<dyn Fn(&panic::PanicHookInfo<'_>) + Send + Sync> = Arc::from(panic::take_hook());
    let otherwise = Arc::clone(&before);
    panic::set_hook(Box::new(move |info| {
        let is_case = SAID.with_borrow_mut(|said| match said {
            Some(said) => {
                *said = info.to_string();
                true
            }
            None => false,
        });
        if !is_case {
            otherwise(info);
        }
    }));
    let result = work();
    panic::set_hook(Box::new(move |info| before(info)));
    result
}

/// The processor's time of a thread; wall time where the system does not tell.
#[derive(Clone, Debug)]
struct ThreadClock {
    file: Option<PathBuf>,
    begun: Instant,
}

impl ThreadClock {
    /// The clock of the calling thread.
    fn here() -> Self {
        let task = std::fs::canonicalize("/proc/thread-self").ok();
        Self { file: task.map(|task| task.join("schedstat")), begun: Instant::now() }
    }

    fn now(&self) -> Duration {
        let text = self.file.as_ref().and_then(|file| std::fs::read_to_string(file).ok());
        let nanoseconds = text.and_then(|text| text.split(' ').next()?.parse().ok());
        nanoseconds.map_or_else(|| self.begun.elapsed(), Duration::from_nanos)
    }
}

/// Peak memory of the process so far, in megabytes; `None` where the system does not report it.
pub(super) fn peak_megabytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: u64 = line.split_whitespace().next()?.parse().ok()?;
    Some(kilobytes / 1024)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayon::prelude::*;

    /// Cases that do all that a case may do.
    struct Bad;

    impl Area for Bad {
        fn name(&self) -> &'static str {
            "bad"
        }

        fn input(&self, _: u64) -> Vec<u8> {
            Vec::new()
        }

        fn judge(&self, case: u64, folder: &Path) -> Verdict {
            assert!(folder.is_dir());
            match case % 5 {
                0 => panic!("case {case}"),
                1 => {
                    let sum: u64 = (0..100_u64)
                        .into_par_iter()
                        .map(|i| if i == 57 { panic!("in parallel") } else { i })
                        .sum();
                    Verdict::Wrong(sum.to_string())
                }
                2 => {
                    let begun = Instant::now();
                    let mut spun = 0_u64;
                    while case == 7 && begun.elapsed() < Duration::from_secs(20) {
                        spun = std::hint::black_box(spun + 1);
                    }
                    Verdict::Accepted
                }
                _ => Verdict::Refused,
            }
        }
    }

    #[test]
    fn panics_and_hangs_are_counted_and_the_rest_goes_on() {
        let area: Arc<dyn Area> = Arc::new(Bad);
        let started = Instant::now();
        let judged = quietly(|| run(&area, 0..50, 2, Duration::from_millis(100))).unwrap();
        assert!(started.elapsed() < Duration::from_secs(15), "a hang is not waited for");
        assert_eq!(judged.len(), 50);
        for (case, Judged { verdict, .. }) in judged {
            match (case % 5, case) {
                (0, _) => assert!(
                    matches!(&verdict, Verdict::Panicked(said) if said.contains(&format!("case {case}")))
                ),
                (1, _) => {
                    assert!(matches!(&verdict, Verdict::Panicked(said) if said.contains("in parallel")))
                }
                (2, 7) => assert_eq!(verdict, Verdict::OverTime),
                (2, _) => assert_eq!(verdict, Verdict::Accepted),
                _ => assert_eq!(verdict, Verdict::Refused),
            }
        }
    }
}
