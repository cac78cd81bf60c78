//! Goals with what was found of each.

use super::found::Run;
use std::path::PathBuf;

/// For people, a phrase each.
pub(super) type Differences = Vec<String>;

/// A goal, and the result or the reason that there is none.
#[derive(Debug)]
pub(super) struct Collected {
    pub(super) goal: PathBuf,
    pub(super) state: State,
    /// Further folders with a finished fit of it.
    pub(super) also_in: Vec<PathBuf>,
    /// Options in which its fit differs from most others.
    pub(super) differences: Differences,
}

#[derive(Debug)]
pub(super) enum State {
    Finished(Run),
    /// The reason that its worker gave.
    Failed(String),
    /// With its folder.
    Unfinished(PathBuf),
    Missing,
}

impl Collected {
    pub(super) const fn new(goal: PathBuf, state: State) -> Self {
        Self { goal, state, also_in: Vec::new(), differences: Vec::new() }
    }
}
