//! Interruption of work before and after a search.
//!
//! A search checks its stop flag and keeps its result. A first guess and an assessment, asked to stop, end in
//! [`FitError::Interrupted`] after the trees that are growing, and are done again when the run is resumed. An
//! assessment that is merely late does less, and reports it ([`Until`]).

use super::budget::Clock;
use crate::error::FitError;
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// An error once `stop` is raised.
pub(crate) fn check(stop: &AtomicBool) -> Result<(), FitError> {
    if stop.load(Ordering::Relaxed) { Err(FitError::Interrupted) } else { Ok(()) }
}

/// Calls `of` with each of `items`, on all threads; results in their order.
pub(crate) fn map<I: Sync, O: Send>(
    items: &[I],
    stop: &AtomicBool,
    of: impl Fn(&I) -> O + Sync,
) -> Result<Vec<O>, FitError> {
    let answer = |item: &I| check(stop).map(|()| of(item));
    // Trees differ a hundredfold in time: each is a task of its own.
    items.par_iter().with_max_len(1).map(answer).collect()
}

/// When work ends: with an error once the stop flag is raised, and with fewer results once it is late.
#[derive(Clone, Copy)]
pub struct Until<'a> {
    stop: &'a AtomicBool,
    late: Option<(&'a dyn Clock, Duration)>,
}

impl<'a> From<&'a AtomicBool> for Until<'a> {
    /// Never late.
    fn from(stop: &'a AtomicBool) -> Self {
        Self { stop, late: None }
    }
}

impl<'a> Until<'a> {
    /// The same, but late from `time` on by `clock`.
    #[must_use]
    pub fn or_late(self, clock: &'a dyn Clock, time: Option<Duration>) -> Self {
        Self { late: time.map(|time| (clock, time)), ..self }
    }

    pub(crate) fn is_late(&self) -> bool {
        self.late.is_some_and(|(clock, time)| clock.elapsed() >= time)
    }

    /// [`map`] without the last `items`, for which it is too late; the first ones, two per thread, are done however
    /// late it is.
    pub(crate) fn map<I: Sync, O: Send>(
        &self,
        items: &[I],
        of: impl Fn(&I) -> O + Sync,
    ) -> Result<Vec<O>, FitError> {
        if self.late.is_none() {
            return map(items, self.stop, of);
        }
        let mut all = Vec::with_capacity(items.len());
        for some in items.chunks(2 * rayon::current_num_threads()) {
            if !all.is_empty() && self.is_late() {
                break;
            }
            all.extend(map(some, self.stop, &of)?);
        }
        Ok(all)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_late_is_left_out_but_for_the_first() {
        let (stop, items) = (AtomicBool::new(false), [1, 2, 3, 4, 5, 6, 7, 8, 9]);
        let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        let done = |clock: &dyn Clock, time| {
            Until::from(&stop).or_late(clock, time).map(&items, |i| i + 1).unwrap().len()
        };
        let calls = std::sync::atomic::AtomicU64::new(0);
        let ticks = || Duration::from_secs(calls.fetch_add(1, Ordering::Relaxed));
        let late = || Duration::from_secs(9);
        one.install(|| {
            assert_eq!(done(&ticks, Some(Duration::from_secs(2))), 6);
            assert_eq!((done(&late, Some(Duration::from_secs(9))), done(&late, None)), (2, 9));
        });
    }

    #[test]
    fn answers_come_in_order_and_none_after_the_flag() {
        let stop = AtomicBool::new(false);
        let items: Vec<u32> = (0..100).collect();
        assert_eq!(map(&items, &stop, |i| i + 1).unwrap(), (1..101).collect::<Vec<_>>());
        let raise = |i: &u32| stop.store(*i == 7, Ordering::Relaxed);
        let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        assert!(matches!(one.install(|| map(&items, &stop, raise)), Err(FitError::Interrupted)));
        assert!(matches!(map(&items, &stop, |_| unreachable!()), Err::<Vec<()>, _>(FitError::Interrupted)));
    }
}
