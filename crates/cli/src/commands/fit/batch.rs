//! Many goals, one after the other: a run folder each, and one summary of all.

use super::args::GoalArgs;
use super::goal::MaskSource;
use super::run_folder::{Mode, RunFolder};
use super::summary::write_table;
use super::task::{Ended, Task};
use super::{Fit, RUNS, list, run_name, signals};
use crate::interrupted::Interrupted;
use crate::{files, input, output};
use anyhow::{Context, bail, ensure};
use pleach_fit::{FitSettings, GuessLibrary};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A part of the goals: the `index`-th of `count`, from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Shard {
    index: usize,
    count: usize,
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        text.split_once('/')
            .and_then(|(index, count)| Some(Self { index: index.parse().ok()?, count: count.parse().ok()? }))
            .filter(|shard| (1..=shard.count).contains(&shard.index))
            .ok_or_else(|| "expected I/N with I from 1 to N, such as 2/8".to_owned())
    }
}

impl Shard {
    const WHOLE: Self = Self { index: 1, count: 1 };

    /// Goals I, I + N, I + 2N …: neighbours are often alike in effort, so shards share them evenly.
    fn part<T>(self, of: Vec<T>) -> Vec<T> {
        of.into_iter().skip(self.index - 1).step_by(self.count).collect()
    }
}

/// A goal and what came of it.
struct Job {
    task: Task,
    state: State,
}

enum State {
    Waiting,
    /// Why.
    Failed(String),
    /// With its `summary.json`.
    Finished(Value),
}

/// Fits all goals of the shard.
pub(super) fn run(fit: &Fit, settings: &FitSettings) -> anyhow::Result<()> {
    ensure!(
        !matches!(fit.goal_options.mask, Some(MaskSource::File(_))),
        "a --mask file belongs to one goal; --mask auto makes one for each"
    );
    let is_stdin = |goal: &PathBuf| input::is_standard(goal);
    ensure!(!fit.goals.iter().any(is_stdin), "standard input is one picture, and there are several goals");
    let out = fit.out.clone().unwrap_or_else(|| RUNS.into());
    let shard = fit.shard.unwrap_or(Shard::WHOLE);
    let table = match fit.shard {
        None => out.join("summary.csv"),
        Some(Shard { index, count }) => out.join(format!("summary-{index}-of-{count}.csv")),
    };
    let mode = fit.mode();
    let mut jobs = shard.part(jobs(goals(fit)?, &out)?);
    for job in &mut jobs {
        job.state = before(fit, settings, &job.task, mode)?;
    }
    files::make_folder(&out)?;
    // Before an hour of work, not after it, one learns that a file cannot be written.
    write(&table, &jobs)?;

    let stop = signals::catch()?;
    let mut library = GuessLibrary::new();
    let all = jobs.len();
    for i in 0..all {
        let name = format!("[{}/{all}] {}", i + 1, jobs[i].task.goal.display());
        let (line, state) = match &jobs[i].state {
            State::Finished(summary) => (format!("finished before, {}", brief(summary)), None),
            _ => match one(fit, settings, &jobs[i].task, mode, &mut library, &stop) {
                Err(error) => {
                    let reason = output::causes(&error, ": ");
                    (format!("failed: {reason}"), Some(State::Failed(reason)))
                }
                Ok(None) => {
                    output::note(format!("{name}: interrupted"));
                    let flag = if mode == Mode::Continue { "" } else { " with --resume" };
                    let how =
                        format!("interrupted, {i} of {all} goals are done; the same command{flag} goes on");
                    return Err(Interrupted::new(how).into());
                }
                Ok(Some(summary)) => (brief(&summary), Some(State::Finished(summary))),
            },
        };
        output::note(format!("{name}: {line}"));
        if let Some(state) = state {
            jobs[i].state = state;
            write(&table, &jobs)?;
        }
        if let (true, State::Finished(summary)) = (fit.json, &jobs[i].state) {
            output::json(summary)?;
        }
    }

    if !fit.json {
        output::line(format!("summary  {}", table.display()))?;
    }
    let failed: Vec<String> = jobs
        .iter()
        .filter(|job| matches!(job.state, State::Failed(_)))
        .map(|job| job.task.goal.display().to_string())
        .collect();
    ensure!(failed.is_empty(), "{} of {all} goals failed: {}", failed.len(), failed.join(", "));
    Ok(())
}

/// The goals of the command line or of the list, with their options.
fn goals(fit: &Fit) -> anyhow::Result<Vec<(PathBuf, GoalArgs)>> {
    match &fit.list {
        Some(list) => list::read(list, &fit.goal_options),
        None => Ok(fit.goals.iter().map(|goal| (goal.clone(), fit.goal_options.clone())).collect()),
    }
}

/// A job per goal; an error if two would share a folder.
fn jobs(goals: Vec<(PathBuf, GoalArgs)>, out: &Path) -> anyhow::Result<Vec<Job>> {
    let mut seen = BTreeMap::new();
    let mut jobs = Vec::new();
    for (goal, args) in goals {
        let stem = run_name(&goal)
            .with_context(|| format!("{} has no file name to call its run folder by", goal.display()))?;
        let folder = out.join(&stem);
        if let Some(other) = seen.insert(stem, goal.clone()) {
            bail!(
                "{} and {} would both be fitted into {}: rename one, or fit them in two batches",
                other.display(),
                goal.display(),
                folder.display()
            );
        }
        jobs.push(Job { task: Task { goal, args, folder: RunFolder::at(folder) }, state: State::Waiting });
    }
    Ok(jobs)
}

/// What there is to do for a goal; an error if its folder holds something that must not be lost.
fn before(fit: &Fit, settings: &FitSettings, task: &Task, mode: Mode) -> anyhow::Result<State> {
    let finished = task.folder.finished();
    if mode == Mode::Resume && !task.folder.is_unfinished() {
        let Some(summary) = finished else { return Ok(State::Waiting) };
        let differences = task.request(fit, &input::picture(&task.goal)?, settings)?.differences(&summary);
        ensure!(
            differences.is_empty(),
            "{} was fitted with other options: {}; --resume skips it with the same ones, --overwrite instead of \
             --resume fits all goals again, and another --out keeps both",
            task.folder.path().display(),
            differences.join(", ")
        );
        return Ok(State::Finished(summary));
    }
    if finished.is_some() || task.folder.is_unfinished() {
        // Only then is the goal read: of thousands that wait, each is read when it is fitted.
        task.folder.check(mode, &task.request(fit, &input::picture(&task.goal)?, settings)?)?;
    }
    Ok(State::Waiting)
}

/// Fits one goal; its summary, or none if it was interrupted.
fn one(
    fit: &Fit,
    settings: &FitSettings,
    task: &Task,
    mode: Mode,
    library: &mut GuessLibrary,
    stop: &Arc<AtomicBool>,
) -> anyhow::Result<Option<Value>> {
    if stop.load(Ordering::SeqCst) {
        return Ok(None);
    }
    // What was waiting when a batch stopped has no checkpoint, and starts.
    let mode = if mode == Mode::Resume && !task.folder.is_unfinished() { Mode::New } else { mode };
    match task.run(fit, settings, mode, library, stop)? {
        Ended::Finished(summary) => Ok(Some(serde_json::to_value(summary)?)),
        // Asked to stop: no fault of the goal.
        Ended::Interrupted(_) => Ok(None),
    }
}

/// What is said of a finished goal.
fn brief(summary: &Value) -> String {
    let number = |key: &str| summary[key].as_f64().unwrap_or(f64::NAN);
    let looks = summary["looks_like"][0]["species"].as_str();
    format!(
        "likeness {:.3}, IoU {:.3}{}; {} in {:.1} s",
        number("likeness"),
        number("iou"),
        looks.map_or_else(String::new, |species| format!(", looks like {species}")),
        super::report::trees(summary["evaluations"].as_u64().unwrap_or_default()),
        number("seconds"),
    )
}

/// Columns of the summary and where in `summary.json` they come from; after them come the two that
/// depend on the clock.
const COLUMNS: [(&str, &str); 31] = [
    ("likeness", "/likeness"),
    ("iou", "/iou"),
    ("best_ellipse_iou", "/best_ellipse_iou"),
    ("pixel_accuracy", "/pixel_accuracy"),
    ("empty_accuracy", "/empty_accuracy"),
    ("dice", "/dice"),
    ("boundary_f", "/boundary_f"),
    ("blurred_iou_16", "/blurred_iou/16"),
    ("chamfer", "/chamfer"),
    ("fresh_likeness_mean", "/fresh_seeds/likeness/mean"),
    ("fresh_likeness_sd", "/fresh_seeds/likeness/sd"),
    ("fresh_iou_mean", "/fresh_seeds/iou/mean"),
    ("fresh_iou_sd", "/fresh_seeds/iou/sd"),
    ("from", "/from"),
    ("first_guess", "/looks_like/0/species"),
    ("first_guess_confidence", "/looks_like/0/confidence"),
    ("species", "/species"),
    ("generator", "/generator"),
    ("tree_seed", "/tree_seed"),
    ("robust", "/robust"),
    ("optimizer", "/optimizer"),
    ("objective", "/objective"),
    ("seed", "/seed"),
    ("cost", "/cost"),
    ("evaluations", "/evaluations"),
    ("stopped_by", "/stopped_by"),
    ("warnings", "/warnings"),
    ("height_m", "/tree_m/height"),
    ("crown_width_m", "/tree_m/crown_width"),
    ("crown_base_m", "/tree_m/crown_base"),
    ("stem_diameter_m", "/tree_m/stem_diameter"),
];
const WALL_COLUMNS: [(&str, &str); 2] =
    [("wall_s", "/seconds"), ("wall_evaluations_per_s", "/evaluations_per_second")];

/// Writes a row for each goal that is done, in the order of the goals.
fn write(path: &Path, jobs: &[Job]) -> anyhow::Result<()> {
    let columns = || COLUMNS.iter().chain(&WALL_COLUMNS);
    let first = ["goal", "state", "reason"];
    let header = first.into_iter().chain(columns().map(|c| c.0)).map(str::to_owned).collect();
    let rows = jobs.iter().filter_map(|job| {
        let (state, reason, summary) = match &job.state {
            State::Waiting => return None,
            State::Failed(reason) => ("failed", reason.as_str(), &Value::Null),
            State::Finished(summary) => ("finished", "", summary),
        };
        let cells = columns().map(|(_, at)| cell(summary.pointer(at)));
        let first = [job.task.goal.display().to_string(), state.to_owned(), reason.to_owned()];
        Some(first.into_iter().chain(cells).collect())
    });
    write_table(path, std::iter::once(header).chain(rows))
}

/// A value as a cell; nothing where there is none. A number that was read back from a file may differ
/// in its last bit, which six decimals do not show.
fn cell(value: Option<&Value>) -> String {
    match value {
        None | Some(Value::Null) => String::new(),
        Some(Value::String(text)) => text.clone(),
        // Warnings, by their kinds.
        Some(Value::Array(items)) => {
            items.iter().map(|item| cell(item.get("kind"))).collect::<Vec<_>>().join(" ")
        }
        Some(Value::Number(number)) if number.is_f64() => {
            format!("{:.6}", number.as_f64().unwrap_or(f64::NAN))
        }
        Some(other) => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser as _;

    /// The options of a goal on their own.
    #[derive(clap::Parser)]
    struct Arguments {
        #[command(flatten)]
        goal: GoalArgs,
    }

    #[test]
    fn shards_share_the_goals_without_loss_or_overlap() {
        let mut all = Vec::new();
        for index in 1..=3 {
            let shard: Shard = format!("{index}/3").parse().unwrap();
            all.extend(shard.part((0..8).collect::<Vec<_>>()));
        }
        assert_eq!(all, [0, 3, 6, 1, 4, 7, 2, 5]);
        assert_eq!(Shard { index: 5, count: 9 }.part(vec![1, 2]), [0; 0]);
        for wrong in ["", "1", "0/3", "4/3", "1/0", "a/b", "1/2/3", "-1/2", "1/99999999999999999999999"] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn two_goals_do_not_share_a_folder() {
        let args = Arguments::parse_from(["fit"]).goal;
        let with_args =
            |goals: &[&str]| goals.iter().map(|goal| (goal.into(), args.clone())).collect::<Vec<_>>();
        let goals = ["a/oak.png", "b/ash.png", "c/oak.jpg"];
        let Err(error) = jobs(with_args(&goals), Path::new("out")) else {
            panic!("c/oak.jpg is not refused")
        };
        let error = error.to_string();
        assert!(error.contains("a/oak.png") && error.contains("c/oak.jpg") && error.contains("oak"));
        assert_eq!(jobs(with_args(&goals[..2]), Path::new("out")).map(|jobs| jobs.len()).unwrap(), 2);
        assert!(jobs(with_args(&[".."]), Path::new("out")).is_err());
    }

    #[test]
    fn cells_are_plain() {
        assert_eq!(cell(Some(&0.25.into())), "0.250000");
        assert_eq!(cell(Some(&3.into())), "3");
        assert_eq!(cell(Some(&"oak".into())), "oak");
        assert_eq!(cell(Some(&Value::Null)) + &cell(None), "");
    }
}
