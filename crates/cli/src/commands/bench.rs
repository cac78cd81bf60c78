//! `pleach bench`: the exam.

use crate::output;
use anyhow::Context;
use pleach_console::signals;
use pleach_experiments::{self as experiments, BenchOptions, Part};
use std::path::PathBuf;

const EXAMPLES: &str = "Examples:
  pleach bench -o exam --quick                           a small part, some minutes
  pleach bench -o exam                                   all of it, an hour or more
  pleach bench -o exam --resume                          goes on where ctrl-C or a kill ended it
  pleach bench -o exam --rows default,cma --only foreign
  pleach bench -o mine --photographs photos --only photographs
  pleach bench --goals goals                             the goals, for other programs
  pleach bench --check mine.csv                          measures answers of other programs
  pleach bench --check mine.csv -o exam                  beside the rows of an exam

The exam has 60 goals around the species of Hewitt's dissertation, whose numbers no library has, and ten trees of other \
programs. Every row of the leaderboard is a way to find a tree for a picture, with a budget of 100 or 1,000 trees, or of \
5 or 60 seconds; these are on trees of other programs and on photographs only. Rows that are bounded by trees are the \
same on every machine and any number of threads.

A table of answers has the columns goal, species (a file from the table's folder, or a known name) and seed, or goal and \
picture (a silhouette of the goal's size), and, if wanted, budget and seconds. docs/bench.md says what is measured.";

/// The exam: ways to find a tree for a picture, on the same goals
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, arg_required_else_help = true)]
pub(crate) struct Bench {
    /// The folder for results.csv, leaderboard.csv and leaderboard.md
    #[arg(short, long, value_name = "DIR", required_unless_present_any = ["goals", "check"])]
    out: Option<PathBuf>,
    /// Only these rows: default, cma, de, hewitt, random, retrieval, guess, truth, ellipse
    #[arg(long, value_name = "NAME", value_delimiter = ',', value_parser = BenchOptions::row,
          conflicts_with_all = ["goals", "check"])]
    rows: Option<Vec<String>>,
    /// Only these goals, or sets of them: perturbed, foreign, photographs
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    only: Option<Vec<String>>,
    /// A folder of pictures of trees, as further goals: silhouettes or cut-outs
    #[arg(long, value_name = "DIR")]
    photographs: Option<PathBuf>,
    /// Trees of searches; by default 100,1000
    #[arg(long, value_name = "N", value_delimiter = ',', conflicts_with_all = ["goals", "check"],
          value_parser = clap::value_parser!(u64).range(1..=100_000_000))]
    trees: Option<Vec<u64>>,
    /// Seconds of fits, 0 for none; by default 5,60
    #[arg(long, value_name = "S", value_delimiter = ',', conflicts_with_all = ["goals", "check"],
          value_parser = seconds)]
    seconds: Option<Vec<f64>>,
    /// One goal around each species, 100 trees, and no time
    #[arg(long, conflicts_with_all = ["trees", "seconds"])]
    quick: bool,
    /// Continue an exam that was interrupted or killed: rows that it had finished are kept
    #[arg(long, conflicts_with_all = ["goals", "check"])]
    resume: bool,
    /// Start over although an unfinished exam has left rows
    #[arg(long, conflicts_with_all = ["resume", "goals", "check"])]
    overwrite: bool,
    /// Write the pictures of the goals and goals.csv into a folder, and do nothing else
    #[arg(long, value_name = "DIR", conflicts_with_all = ["check", "out"])]
    goals: Option<PathBuf>,
    /// Measure the answers in a table (may be repeated), and do nothing else
    #[arg(long, value_name = "FILE")]
    check: Vec<PathBuf>,
}

/// Seconds of a fit; 0 is none.
fn seconds(text: &str) -> Result<f64, String> {
    let found = text.parse::<f64>().ok().filter(|s| *s == 0.0 || (0.1..=86_400.0).contains(s));
    found.ok_or_else(|| format!("`{text}` is not a time, expected 0, or seconds from 0.1 to 86400"))
}

impl Bench {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        signals::catch(experiments::stop, || ())?;
        let options = self.options();
        if let Some(folder) = &self.goals {
            let count = experiments::hand_out(&options, folder)?;
            output::line(format!("{count} goals"))?;
            output::wrote(&folder.join("goals.csv"));
            return Ok(());
        }
        if !self.check.is_empty() {
            output::line(experiments::check_submissions(&options, &self.check, self.out.as_deref())?)?;
            self.out.iter().for_each(|out| output::wrote(&out.join("leaderboard.md")));
            return Ok(());
        }
        let out = self.out.as_deref().context("--out is missing")?;
        options.write(out, self.overwrite)?;
        let part = Part { resume: self.resume, overwrite: self.overwrite, ..Part::default() };
        output::line(experiments::run(out, &part)?)?;
        output::wrote(&out.join("leaderboard.md"));
        Ok(())
    }

    fn options(&self) -> BenchOptions {
        let timed = |all: &Vec<f64>| all.iter().copied().filter(|seconds| *seconds > 0.0).collect();
        BenchOptions {
            rows: self.rows.clone(),
            only: self.only.clone(),
            around: self.quick.then_some(1),
            trees: if self.quick { Some(vec![100]) } else { self.trees.clone() },
            seconds: if self.quick { Some(Vec::new()) } else { self.seconds.as_ref().map(timed) },
            photographs: self.photographs.clone(),
        }
    }
}
