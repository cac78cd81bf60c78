//! What run folders are called.

use crate::input;
use std::path::Path;

/// The folder that run folders are made in if nothing is said.
pub(super) const RUNS: &str = "runs";

/// What the run folder of `goal` is called, and its species. Names that are not UTF-8 become so: the
/// species file in the folder is typed as an argument later. `None` if there is no name that stays inside of
/// the folder of run folders: `...png` is called `..`.
pub(in crate::commands) fn run_name(goal: &Path) -> Option<String> {
    let name = input::stem(goal)?.to_string_lossy().into_owned();
    (name != "." && name != "..").then_some(name)
}
