//! Work around a search that ends when it is asked to.
//!
//! A search looks at its stop flag between batches and keeps what it has found. A first guess and the
//! judging of a result are worth nothing in part: asked to stop, they end in [`FitError::Interrupted`]
//! after the trees that are growing, and are done again when the run is resumed.

use crate::error::FitError;
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};

/// An error once `stop` is raised.
pub(crate) fn check(stop: &AtomicBool) -> Result<(), FitError> {
    if stop.load(Ordering::Relaxed) { Err(FitError::Interrupted) } else { Ok(()) }
}

/// What `of` gives for each of `items`, in their order, on all threads.
pub(crate) fn map<I: Sync, O: Send>(
    items: &[I],
    stop: &AtomicBool,
    of: impl Fn(&I) -> O + Sync,
) -> Result<Vec<O>, FitError> {
    let answer = |item: &I| check(stop).map(|()| of(item));
    // Trees differ a hundredfold in cost: each is a piece of work of its own.
    items.par_iter().with_max_len(1).map(answer).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

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
