//! The possible outcomes of a case.

/// The outcome of a case.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Verdict {
    /// Taken, and what came of it is sound.
    Accepted,
    /// Refused with a clear message.
    Refused,
    /// Refused with a message that does not help.
    Unclear(String),
    /// Taken, and what came of it is not sound.
    Wrong(String),
    /// Panicked.
    Panicked(String),
    /// Took too long.
    OverTime,
}
