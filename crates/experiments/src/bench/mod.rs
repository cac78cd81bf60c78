//! The exam: ways to find a tree for a picture, on the same goals, with the same measures.

mod answer;
mod attempt;
mod budget;
mod contestant;
mod foreign;
mod goal;
mod hand_out;
mod interval;
mod leaderboard;
mod options;
mod row;
mod spec;
mod submission;
#[cfg(test)]
mod tests;

pub(super) use spec::BenchSpec;

pub use hand_out::hand_out;
pub use options::BenchOptions;
pub use submission::check_submissions;

use super::record;
use super::{Journal, Kind, Outputs, Slice, Table, progress};
use anyhow::Context;
use attempt::Arena;
use budget::Budget;
use contestant::Contestant;
use goal::{Goal, Origin};
use row::Row;
use std::path::{Path, PathBuf};

/// The leaderboard as a table, and for people.
const TABLE: &str = "leaderboard.csv";
const PAGE: &str = "leaderboard.md";

/// The goals of `origins`, drawn.
fn goals(origins: &[Origin]) -> anyhow::Result<Vec<Goal>> {
    let bar = progress("goals", origins.len() as u64);
    let draw = |origin: &Origin| {
        bar.inc(1);
        origin.goal().with_context(|| format!("the goal {}", origin.name()))
    };
    let goals = origins.iter().map(draw).collect();
    bar.finish_and_clear();
    goals
}

impl Kind for BenchSpec {
    fn columns(&self) -> anyhow::Result<Vec<String>> {
        record::columns(&Row::default())
    }

    fn files(&self, folder: &Path) -> (Vec<String>, Vec<PathBuf>) {
        let pictures =
            self.origins(folder).unwrap_or_default().into_iter().filter_map(|origin| match origin {
                Origin::File(path) => Some(path),
                Origin::Around { .. } | Origin::Foreign(_) => None,
            });
        ([TABLE, PAGE].map(str::to_owned).to_vec(), pictures.collect())
    }

    /// A row for each contestant and budget on each goal, budget by budget; a slice has the first goals and the budgets
    /// of no more trees. Nothing is checked that depends on the time.
    fn rows(&self, folder: &Path, slice: Slice, journal: &mut Journal) -> anyhow::Result<()> {
        let mut origins = self.origins(folder)?;
        origins.truncate(slice.take_of(origins.len()));
        let is_in = |budget: &Budget| match budget {
            Budget::Free => true,
            Budget::Trees(trees) => slice.evaluations.is_none_or(|most| *trees <= most),
            Budget::Seconds(_) => journal.is_kept(),
        };
        let budgets = self.budgets().into_iter().filter(is_in);
        let goals = goals(&origins)?;
        let contestants = self.contestants();
        let mut jobs = Vec::new();
        for budget in budgets {
            for goal in &goals {
                let is_for = |one: &&Contestant| budget.is_for(**one, goal.set);
                jobs.extend(contestants.iter().filter(is_for).map(|one| (*one, goal, budget)));
            }
        }
        let bar = progress("answers", jobs.len() as u64);
        let mut arena = Arena::new()?;
        for (contestant, goal, budget) in jobs {
            let is_of = |row: &Row| {
                (row.goal.as_str(), row.row.as_str(), row.budget) == (&goal.name, contestant.name(), budget)
            };
            let make = || {
                let row = arena.row(contestant, goal, budget);
                Ok(vec![row.with_context(|| format!("{} on the goal {}", contestant.name(), goal.name))?])
            };
            journal.job(is_of, make)?;
            bar.inc(1);
        }
        bar.finish_and_clear();
        Ok(())
    }

    fn report(&self, _: &Path, table: &Table, outputs: &Outputs) -> anyhow::Result<String> {
        let rows: Vec<Row> = table.records()?;
        leaderboard::table(&rows)?.write(&outputs.path(TABLE)?)?;
        let page = leaderboard::markdown(&rows);
        outputs.text(PAGE, &page)?;
        Ok(page.trim_end().to_owned())
    }
}
