//! Threads that help inside one tree.

use std::{fmt, ptr};

/// Hands out the number of the next part; `None` once all have been.
pub type NextPart<'a> = dyn FnMut() -> Option<usize> + 'a;

/// Threads that may help with the tree that one of them grows or draws.
///
/// Whether and how many do is a matter of time and chance, so nothing that is made may depend on it:
/// the parts come to the same in any order and on any threads.
pub trait Helpers: fmt::Debug + Send + Sync {
    /// Whether some have nothing to do. It is asked often, and takes no more than a look.
    fn are_idle(&self) -> bool;

    /// Calls `work` on this thread and on each that helps. Each call takes parts until none of the `parts` is left;
    /// returns once all calls have.
    fn share(&self, parts: usize, work: &(dyn Fn(&mut NextPart<'_>) + Sync));
}

/// The same ones.
impl PartialEq for dyn Helpers + '_ {
    fn eq(&self, other: &Self) -> bool {
        ptr::addr_eq(self, other)
    }
}
