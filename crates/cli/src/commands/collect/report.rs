//! The report of a collection: for people, for scripts, and whether it is complete.

use super::collected::State;
use super::matched::Matched;
use crate::text::shown;
use anyhow::ensure;
use serde::Serialize;

/// Lines of one kind that are shown to people; JSON has all of them.
const MAX_LINES: usize = 20;

/// A goal and a remark about it.
#[derive(Debug, Serialize)]
struct Line {
    goal: String,
    /// Its place among the goals, from 1.
    number: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    folder: Option<String>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    why: Vec<String>,
}

/// The report, as JSON has it.
#[derive(Debug, Serialize)]
pub(super) struct Report {
    goals: usize,
    complete: bool,
    finished: usize,
    missing: Vec<Line>,
    unfinished: Vec<Line>,
    failed: Vec<Line>,
    /// `why` lists the further folders.
    twice: Vec<Line>,
    other_options: Vec<Line>,
    /// Run folders of goals that were not asked for; they are not in the table.
    not_asked_for: Vec<String>,
}

impl Report {
    pub(super) fn new(matched: &Matched) -> Self {
        let (mut missing, mut unfinished, mut failed) = (Vec::new(), Vec::new(), Vec::new());
        let (mut twice, mut other_options) = (Vec::new(), Vec::new());
        let mut finished = 0;
        for (i, goal) in matched.goals.iter().enumerate() {
            let line = |folder: Option<&std::path::Path>, why: Vec<String>| Line {
                goal: goal.goal.display().to_string(),
                number: i + 1,
                folder: folder.map(|folder| folder.display().to_string()),
                why,
            };
            match &goal.state {
                State::Finished(run) => {
                    finished += 1;
                    if !goal.also_in.is_empty() {
                        let also = goal.also_in.iter().map(|folder| folder.display().to_string()).collect();
                        twice.push(line(Some(&run.folder), also));
                    }
                    if !goal.differences.is_empty() {
                        other_options.push(line(Some(&run.folder), goal.differences.clone()));
                    }
                }
                State::Failed(reason) => failed.push(line(None, vec![reason.clone()])),
                State::Unfinished(folder) => unfinished.push(line(Some(folder), Vec::new())),
                State::Missing => missing.push(line(None, Vec::new())),
            }
        }
        let goals = matched.goals.len();
        Self {
            goals,
            complete: finished == goals && twice.is_empty() && other_options.is_empty(),
            finished,
            missing,
            unfinished,
            failed,
            twice,
            other_options,
            not_asked_for: matched.not_asked_for.iter().map(|folder| folder.display().to_string()).collect(),
        }
    }

    /// The kinds of faults: name, lines, and the word between a goal and its reason.
    fn kinds(&self) -> [(&'static str, &[Line]); 5] {
        [
            ("missing", &self.missing),
            ("unfinished", &self.unfinished),
            ("failed", &self.failed),
            ("twice", &self.twice),
            ("with other options", &self.other_options),
        ]
    }

    /// How many goals have which fault, as in `2 missing, 1 failed`.
    fn counts(&self) -> String {
        let kinds = self.kinds();
        let counts = kinds.iter().filter(|(_, lines)| !lines.is_empty());
        counts.map(|(kind, lines)| format!("{} {kind}", lines.len())).collect::<Vec<_>>().join(", ")
    }

    /// For people.
    pub(super) fn text(&self) -> String {
        let mut text = format!("{} of {} goals finished", self.finished, self.goals);
        if !self.complete {
            text.push_str(&format!("; {}", self.counts()));
        }
        for (kind, lines) in self.kinds() {
            for line in lines.iter().take(MAX_LINES) {
                let folder = line.folder.as_ref().filter(|folder| **folder != line.goal);
                let parts = [Some(&line.goal), folder].into_iter().flatten().cloned();
                let why = (!line.why.is_empty()).then(|| line.why.join(", "));
                let parts: Vec<String> = parts.chain(why).collect();
                text.push_str(&format!("\n{kind}: {}", shown(&parts.join(": "))));
            }
            if let Some(more @ 1..) = lines.len().checked_sub(MAX_LINES) {
                text.push_str(&format!("\n{kind}: and {more} more"));
            }
        }
        if let Some(first) = self.not_asked_for.first() {
            let count = self.not_asked_for.len();
            text.push_str(&format!(
                "\n{count} run folders are of no goal that was asked for, such as {}",
                shown(first)
            ));
        }
        text
    }

    /// An error unless every goal is finished once, in the same way.
    pub(super) fn complete(&self) -> anyhow::Result<()> {
        ensure!(self.complete, "of {} goals {}", self.goals, self.counts());
        Ok(())
    }
}
