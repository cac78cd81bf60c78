//! Many goals, one after the other: a run folder each, and one summary of all.

use super::args::{Fit, GoalArgs};
use super::names::{RUNS, run_name};
use super::rows::write_table;
use super::run_folder::{Busy, Finished, Mode, RunFolder};
use super::task::{Ended, Task};
use super::values::Shard;
use super::{list, report, signals, table};
use crate::interrupted::Interrupted;
use crate::{files, input, output, text};
use anyhow::{Context, bail, ensure};
use pleach::MaskFrom;
use pleach::plan::library;
use pleach_fit::GuessLibrary;
use pleach_tree::Species;
use serde_json::Value;
use std::collections::{BTreeMap, VecDeque};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// How long a batch waits for the goals that other processes fit before it looks again.
const PAUSE: Duration = Duration::from_millis(500);

/// A goal and what came of it.
struct Job {
    task: Task,
    state: State,
    /// Whether its folder held a finished fit when the batch began, which is made again.
    again: bool,
    /// Whether another process was fitting it when its turn came.
    is_elsewhere: bool,
}

enum State {
    Waiting,
    /// Why.
    Failed(String),
    /// With its `summary.json`.
    Finished(Value),
}

/// Fits all goals of the shard, from the species `start` if it is at hand.
pub(super) fn run(fit: &Fit, start: Option<&Species>) -> anyhow::Result<()> {
    ensure!(
        !matches!(fit.goal_options.mask, Some(MaskFrom::File(_))),
        "a --mask file belongs to one goal; --mask auto makes one for each"
    );
    ensure!(fit.goal_options.hints.is_empty(), "a --box, points and strokes belong to one goal");
    ensure!(
        fit.goal_options.corrections.is_empty(),
        "corrections of a reading, such as --trunks, belong to one goal"
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
    let mut jobs = shard.part(jobs(fit, goals(fit)?, &out, start)?);
    for job in &mut jobs {
        job.state = before(&job.task, mode)?;
        job.again = mode != Mode::Resume && job.task.folder.finished().is_some();
    }
    files::make_folder(&out)?;
    // Before an hour of work, not after it, one learns that a file cannot be written.
    write(&table, &jobs)?;

    let stop = signals::catch()?;
    let mut library = library();
    let all = jobs.len();
    let mut queue: VecDeque<usize> = (0..all).collect();
    while let Some(i) = queue.pop_front() {
        if jobs[i].is_elsewhere && !stop.load(Ordering::SeqCst) && jobs[i].task.folder.is_busy() {
            // Every goal has had its turn, and what is left is with others.
            std::thread::sleep(PAUSE);
            queue.push_back(i);
            continue;
        }
        let name = format!("[{}/{all}] {}", i + 1, text::path(&jobs[i].task.goal));
        let ended = match &jobs[i].state {
            State::Finished(summary) => Ok(One::Before(summary.clone())),
            _ => one(fit, &jobs[i], mode, &mut library, &stop),
        };
        let (line, state) = match ended {
            Err(error) if error.is::<Busy>() => {
                if !jobs[i].is_elsewhere {
                    output::note(format!("{name}: another pleach fits it; looked at again at the end"));
                }
                jobs[i].is_elsewhere = true;
                queue.push_back(i);
                continue;
            }
            Err(error) => {
                let reason = output::causes(&error, ": ");
                (format!("failed: {reason}"), State::Failed(reason))
            }
            Ok(One::Interrupted) => {
                output::note(format!("{name}: interrupted"));
                let flag = if mode == Mode::Continue { "" } else { " with --resume" };
                let done = jobs.iter().filter(|job| !matches!(job.state, State::Waiting)).count();
                let how =
                    format!("interrupted, {done} of {all} goals are done; the same command{flag} goes on");
                return Err(Interrupted::new(how).into());
            }
            Ok(One::Before(summary)) => {
                (format!("finished before, {}", brief(&summary)), State::Finished(summary))
            }
            Ok(One::Fitted(summary)) => (brief(&summary), State::Finished(summary)),
        };
        output::note(format!("{name}: {line}"));
        if !matches!(jobs[i].state, State::Finished(_)) {
            jobs[i].state = state;
            write(&table, &jobs)?;
        }
        if let (true, State::Finished(summary)) = (fit.json, &jobs[i].state) {
            output::json(summary)?;
        }
    }

    if !fit.json {
        output::line(format!("summary  {}", text::path(&table)))?;
    }
    let failed: Vec<String> = jobs
        .iter()
        .filter(|job| matches!(job.state, State::Failed(_)))
        .map(|job| text::path(&job.task.goal).to_string())
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
fn jobs(
    fit: &Fit,
    goals: Vec<(PathBuf, GoalArgs)>,
    out: &Path,
    start: Option<&Species>,
) -> anyhow::Result<Vec<Job>> {
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
        let options = fit.options(&args)?;
        let segmenter = args.mask_command;
        let task = Task { goal, options, segmenter, start: start.cloned(), folder: RunFolder::at(folder) };
        jobs.push(Job { task, state: State::Waiting, again: false, is_elsewhere: false });
    }
    Ok(jobs)
}

/// What there is to do for a goal; an error if its folder holds something that must not be lost.
fn before(task: &Task, mode: Mode) -> anyhow::Result<State> {
    if mode == Mode::Resume
        && let Some(summary) = task.done_before()?
    {
        return Ok(State::Finished(summary));
    }
    let is_new = mode == Mode::Resume && !task.folder.is_unfinished();
    if !is_new && (task.folder.finished().is_some() || task.folder.is_unfinished()) {
        // Only then is the goal read: of thousands that wait, each is read when it is fitted.
        task.folder.check(mode, &task.request(&input::picture(&task.goal)?)?)?;
    }
    Ok(State::Waiting)
}

/// How the turn of a goal ended.
enum One {
    /// With its `summary.json`.
    Fitted(Value),
    /// The same of a fit that was there already.
    Before(Value),
    Interrupted,
}

/// Fits one goal, unless another process has done so since the batch began.
fn one(
    fit: &Fit,
    job: &Job,
    mode: Mode,
    library: &mut GuessLibrary,
    stop: &Arc<AtomicBool>,
) -> anyhow::Result<One> {
    let Job { task, again, .. } = job;
    if stop.load(Ordering::SeqCst) {
        return Ok(One::Interrupted);
    }
    // What another process has left since the batch began is taken as if it were our own.
    let mode = match mode {
        Mode::Resume => Mode::Share,
        Mode::New if !again => Mode::Share,
        mode => mode,
    };
    match task.run(fit, mode, library, stop) {
        Ok(Ended::Finished(summary)) => Ok(One::Fitted(serde_json::to_value(summary)?)),
        // Asked to stop: no fault of the goal.
        Ok(Ended::Interrupted(_)) => Ok(One::Interrupted),
        Err(error) => Ok(One::Before(error.downcast::<Finished>()?.summary)),
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
        report::trees(summary["evaluations"].as_u64().unwrap_or_default()),
        number("seconds"),
    )
}

/// Writes a row for each goal that is done, in the order of the goals.
fn write(path: &Path, jobs: &[Job]) -> anyhow::Result<()> {
    let rows = jobs.iter().filter_map(|job| {
        let result = match &job.state {
            State::Waiting => return None,
            State::Failed(reason) => Err(reason.as_str()),
            State::Finished(summary) => Ok(summary),
        };
        Some(table::row(&job.task.goal, result))
    });
    write_table(path, std::iter::once(table::header()).chain(rows))
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser as _;

    #[derive(clap::Parser)]
    struct Line {
        #[command(flatten)]
        fit: Fit,
    }

    #[test]
    fn two_goals_do_not_share_a_folder() {
        let fit = Line::parse_from(["fit", "goal.png"]).fit;
        let jobs = |goals: &[&str]| {
            let goals = goals.iter().map(|goal| (goal.into(), fit.goal_options.clone())).collect();
            jobs(&fit, goals, Path::new("out"), None)
        };
        let goals = ["a/oak.png", "b/ash.png", "c/oak.jpg"];
        let Err(error) = jobs(&goals) else { panic!("c/oak.jpg is not refused") };
        let error = error.to_string();
        assert!(error.contains("a/oak.png") && error.contains("c/oak.jpg") && error.contains("oak"));
        assert_eq!(jobs(&goals[..2]).map(|jobs| jobs.len()).unwrap(), 2);
        assert!(jobs(&[".."]).is_err());
    }
}
