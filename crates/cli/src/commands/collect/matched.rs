//! Goals, and what was found of each.

use super::collected::{Collected, State};
use super::found::{Found, Run};
use super::other;
use super::run_name;
use crate::commands::fit::request::file_sha256;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// All goals.
#[derive(Debug)]
pub(super) struct Matched {
    pub(super) goals: Vec<Collected>,
    /// Folders of goals that were not asked for.
    pub(super) not_asked_for: Vec<PathBuf>,
}

impl Matched {
    /// The places of goals that have to be fitted again.
    pub(super) fn to_do(&self) -> impl Iterator<Item = usize> {
        let all = self.goals.iter().enumerate();
        all.filter(|(_, goal)| !matches!(goal.state, State::Finished(_))).map(|(i, _)| i)
    }
}

/// What was found of the goals that there should be.
pub(super) fn wanted(goals: Vec<PathBuf>, found: Found) -> Matched {
    let Found { finished, unfinished, failures, .. } = found;
    let by_name = group(&finished, |run| Some(name(&run.folder)));
    let by_hash = group(&finished, |run| run.sha256().map(str::to_owned));
    let begun = group(&unfinished, |folder| Some(name(folder)));
    let names: BTreeSet<String> = goals.iter().filter_map(|goal| run_name(goal)).collect();
    let mut used = BTreeSet::new();
    let mut collected = Vec::new();
    for goal in goals {
        let called = run_name(&goal).unwrap_or_default();
        let hash = file_sha256(&goal).ok();
        let is_same = |run: &Run| hash.is_some() && run.sha256() == hash.as_deref();
        // Fits of this name, and of this picture under a name that is no other goal's: a list may have
        // one picture under two names.
        let of_name = by_name.get(&called).into_iter().flatten();
        let of_picture = hash.as_ref().and_then(|hash| by_hash.get(hash)).into_iter().flatten();
        let of_picture = of_picture.filter(|run| !names.contains(&name(&run.folder)));
        let mut runs: Vec<&Run> = of_name.chain(of_picture).copied().collect();
        // The goal may be another picture than it was.
        runs.sort_by_key(|run| (!is_same(run), name(&run.folder) != called));
        let begun: Vec<&PathBuf> = begun.get(&called).into_iter().flatten().copied().collect();
        used.extend(runs.iter().map(|run| run.folder.clone()).chain(begun.iter().copied().cloned()));
        let (state, differences) = match (runs.first(), begun.first(), failures.get(&called)) {
            (Some(run), ..) => {
                let changed = hash.is_some() && !is_same(run);
                let changed = changed.then(|| format!("{} is another picture now", goal.display()));
                (State::Finished((*run).clone()), changed.into_iter().collect())
            }
            (_, Some(folder), _) => (State::Unfinished((*folder).clone()), Vec::new()),
            (.., Some(failure)) => (State::Failed(failure.reason.clone()), Vec::new()),
            _ => (State::Missing, Vec::new()),
        };
        let also_in = runs.iter().skip(1).map(|run| run.folder.clone()).collect();
        collected.push(Collected { goal, state, also_in, differences });
    }
    other::compare(&mut collected);
    let all = finished.iter().map(|run| &run.folder).chain(&unfinished);
    let not_asked_for = all.filter(|folder| !used.contains(*folder)).cloned().collect();
    Matched { goals: collected, not_asked_for }
}

/// What a run folder is called.
fn name(folder: &Path) -> String {
    folder.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// `all`, grouped by `key`.
fn group<T>(all: &[T], key: impl Fn(&T) -> Option<String>) -> BTreeMap<String, Vec<&T>> {
    let mut groups: BTreeMap<String, Vec<&T>> = BTreeMap::new();
    for one in all {
        if let Some(key) = key(one) {
            groups.entry(key).or_default().push(one);
        }
    }
    groups
}

/// All that was found, in the order of the goals' paths.
pub(super) fn all(found: Found) -> Matched {
    let Found { finished, unfinished, failures, .. } = found;
    let mut goals: Vec<Collected> = Vec::new();
    // The place of the first fit of a picture.
    let mut places: BTreeMap<String, usize> = BTreeMap::new();
    let mut names = BTreeSet::new();
    for run in finished {
        let called = name(&run.folder);
        let _ = names.insert(called.clone());
        let first = run.sha256().and_then(|hash| places.get(hash).copied());
        if let Some(first) = first {
            goals[first].also_in.push(run.folder.clone());
            // A picture that has two names has two rows, as in a batch.
            if run_name(&goals[first].goal) == Some(called) {
                continue;
            }
        } else if let Some(hash) = run.sha256() {
            let _ = places.insert(hash.to_owned(), goals.len());
        }
        goals.push(Collected::new(run.goal(), State::Finished(run)));
    }
    for folder in unfinished {
        let _ = names.insert(name(&folder));
        goals.push(Collected::new(folder.clone(), State::Unfinished(folder)));
    }
    // What failed once may have been mended since.
    for (_, failure) in failures.into_iter().filter(|(called, _)| !names.contains(called)) {
        goals.push(Collected::new(failure.goal, State::Failed(failure.reason)));
    }
    goals.sort_by(|a, b| a.goal.cmp(&b.goal));
    other::compare(&mut goals);
    Matched { goals, not_asked_for: Vec::new() }
}
