//! A goal, and what was found of it.

use super::found::Run;
use std::path::PathBuf;

/// For people, a phrase each.
pub(super) type Differences = Vec<String>;

/// A goal and what there is of it.
#[derive(Debug)]
pub(super) struct Collected {
    pub(super) goal: PathBuf,
    pub(super) state: State,
    /// Further folders with a finished fit of it.
    pub(super) also_in: Vec<PathBuf>,
    /// What about its fit is not as in most.
    pub(super) differences: Differences,
}

#[derive(Debug)]
pub(super) enum State {
    Finished(Run),
    /// Why, as its worker said.
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
