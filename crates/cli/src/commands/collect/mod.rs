//! `pleach collect`: one table of the results of many workers, and a report of what is missing.

mod array;
mod collected;
mod found;
mod matched;
mod other;
mod report;

use super::fit::{list, run_name, table};
use crate::{files, input, output};
use anyhow::{Context, ensure};
use collected::State;
use found::Found;
use matched::Matched;
use report::Report;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "Examples:
  pleach collect runs -o all.csv  one table of all run folders below runs
  pleach collect runs --list goals.csv -o all.csv  and which goals are missing
  pleach collect runs goals/*.png --json  the same of goals without a list
  pleach collect runs --list goals.csv --array  goals to fit again, as 3,7-9
  pleach collect runs --list goals.csv --shards 8 --array  the shards they are in

Every folder below RUNS that `pleach fit` has written counts, and every summary table, for the reasons of \
goals that failed. The table has the columns of a batch's summary.csv, in the order of the goals: of shards \
that fitted all goals it is the summary.csv of one batch, but for the columns of times, `wall_...`. Without \
goals it is in the order of their paths, and goals that no worker began are not known of.

It ends with code 0 if every goal is finished once, by one version and with the same options, and with code 1 \
otherwise. A goal is missing if no worker has left anything of it, unfinished if its folder holds a checkpoint \
but no result, and failed if a table says so. It is there twice if two folders hold a result of it; the one \
that is called as a batch calls it is in the table. Options that a list gives each goal, such as its height, \
may differ from goal to goal; all others are compared with those of most goals.

All cases but the last two are for the same `pleach fit` once more, with --resume: it skips what is finished.";

/// Join the results of many workers, and report what is missing
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Collect {
    /// The folder that the workers wrote to, or one that holds several of them
    #[arg(value_name = "RUNS")]
    runs: PathBuf,
    /// The goals that there should be, in the order of the shards
    #[arg(value_name = "GOAL", conflicts_with = "list")]
    goals: Vec<PathBuf>,
    /// The list that the workers were given
    #[arg(long, value_name = "FILE")]
    list: Option<PathBuf>,
    /// The table to write, as CSV; - for standard output, the report then goes to standard error
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Print the numbers of the goals that are missing, unfinished or failed, from 1, as --array options
    /// of schedulers take them, and nothing else
    #[arg(long, conflicts_with = "json")]
    array: bool,
    /// With --array: the numbers of the shards that these goals are in, for workers with --shard I/N
    #[arg(long, value_name = "N", requires = "array", value_parser = clap::value_parser!(u32).range(1..))]
    shards: Option<u32>,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
}

impl Collect {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let goals = self.goals()?;
        ensure!(
            !self.array || goals.is_some(),
            "--array numbers the goals that there should be: give them, or their --list"
        );
        let found = Found::below(&self.runs)?;
        let matched = match goals {
            Some(goals) => matched::wanted(goals, found),
            None => matched::all(found),
        };
        ensure!(!matched.goals.is_empty(), "{} holds no run folder", self.runs.display());
        if let Some(out) = &self.out {
            write(out, &matched)?;
        }
        let report = Report::new(&matched);
        let is_stdout = self.out.as_deref().is_some_and(files::is_stdout);
        if self.array {
            output::line(array::numbers(matched.to_do(), self.shards))?;
        } else if self.json {
            output::json(&report)?;
        } else if is_stdout {
            output::note(report.text());
        } else {
            output::line(report.text())?;
        }
        if let Some(out) = &self.out {
            output::wrote(out);
        }
        report.complete()
    }

    /// The goals that there should be, if they were given; an error if a batch would refuse them.
    fn goals(&self) -> anyhow::Result<Option<Vec<PathBuf>>> {
        let goals = match &self.list {
            Some(list) => list::goals(list)?,
            None if self.goals.is_empty() => return Ok(None),
            None => self.goals.clone(),
        };
        let mut names = std::collections::BTreeMap::new();
        for goal in &goals {
            let name = run_name(goal).filter(|_| !input::is_standard(goal));
            let name = name.with_context(|| format!("{} is not a picture's path", goal.display()))?;
            if let Some(other) = names.insert(name, goal) {
                let (one, other) = (goal.display(), other.display());
                anyhow::bail!(
                    "{other} and {one} would both be fitted into one run folder: collect them apart"
                );
            }
        }
        Ok(Some(goals))
    }
}

/// Writes a row for each goal that is finished or failed.
fn write(out: &Path, matched: &Matched) -> anyhow::Result<()> {
    let rows = matched.goals.iter().filter_map(|goal| {
        let result = match &goal.state {
            State::Finished(run) => Ok(&run.summary),
            State::Failed(reason) => Err(reason.as_str()),
            State::Unfinished(_) | State::Missing => return None,
        };
        Some(table::row(&goal.goal, result))
    });
    files::write_out(out, |file| {
        let mut csv = csv::Writer::from_writer(file);
        for row in std::iter::once(table::header()).chain(rows) {
            csv.write_record(row)?;
        }
        Ok(csv.flush()?)
    })
}
