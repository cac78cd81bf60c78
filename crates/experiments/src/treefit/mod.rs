//! Fits of goals that the search has not grown, scored with seeds that it has not seen.

mod attempt;
mod goals;
mod report;
mod row;
mod sheet;
mod spec;

pub(super) use row::Fit;
pub(super) use spec::TreefitSpec;

use super::pictured::write_species;
use super::record::{self, Row};
use super::{Journal, Kind, Outputs, Slice, Table, progress, stop};
use anyhow::{Context, bail};
use attempt::Guesses;
use goals::Problem;
use pleach_console::files;
use spec::{GoalSpec, MethodSpec};
use std::path::{Path, PathBuf};

/// Trees of other seeds that a result, and the truth, is judged by.
const FRESH: usize = 16;

/// The file of a fit by the `place`th of the methods that are kept.
fn fit_file(goal: &str, kept: &[&MethodSpec], place: usize) -> String {
    match place {
        0 => format!("fits/{goal}.toml"),
        _ => format!("fits/{goal}-{}.toml", kept[place].sort()),
    }
}

fn guess_file(goal: &str) -> String {
    format!("fits/{goal}-guess.toml")
}

impl Kind for TreefitSpec {
    fn columns(&self) -> anyhow::Result<Vec<String>> {
        record::columns(&Fit::default())
    }

    fn files(&self, folder: &Path) -> (Vec<String>, Vec<PathBuf>) {
        let kept = self.kept();
        let fits = self.goals().flat_map(|goal| {
            let name = goal.name();
            let fits = (0..kept.len()).map(|place| fit_file(&name, &kept, place));
            fits.chain([guess_file(&name)]).collect::<Vec<_>>()
        });
        let read = self.goals().flat_map(|goal| match goal {
            GoalSpec::File(goal) => {
                std::iter::once(&goal.file).chain(&goal.others).map(|file| folder.join(file)).collect()
            }
            GoalSpec::Own(goal) => vec![PathBuf::from(&goal.species)],
        });
        (fits.chain([sheet::SHEET.to_owned()]).collect(), read.collect())
    }

    /// A slice is a few goals, whole: fits of fewer evaluations have other results.
    fn rows(&self, folder: &Path, slice: Slice, journal: &mut Journal) -> anyhow::Result<()> {
        let is_slice = slice.repetitions.is_some() || slice.evaluations.is_some() || !journal.is_kept();
        let most = slice.evaluations.unwrap_or(u64::MAX);
        let is_in =
            |m: &&MethodSpec| !is_slice || (m.seconds.is_none() && m.evaluations.is_some_and(|n| *n <= most));
        let methods: Vec<&MethodSpec> = self.methods().filter(is_in).collect();
        if methods.is_empty() {
            bail!("no method has a number of evaluations that is at most {most}");
        }
        let repetitions =
            |method: &MethodSpec| if is_slice { 1 } else { method.repetitions.map_or(1, |n| *n) };
        let mut jobs = Vec::new();
        for goal in self.goals().take(slice.take_of(self.goals.len())) {
            for method in methods.iter().filter(|method| method.fits(goal.kind())) {
                jobs.extend((1..=repetitions(method)).map(|repetition| (goal, *method, repetition)));
            }
        }
        let bar = progress("fits", jobs.len() as u64);
        let mut current: Option<(Problem, Guesses)> = None;
        let keeps = journal.is_kept();
        for (goal, method, repetition) in jobs {
            let name = goal.name();
            let is_of =
                |row: &Fit| (&row.goal, &row.method, row.repetition) == (&name, &method.name, repetition);
            let make = || {
                let keeps = keeps && repetition == 1;
                Ok(vec![self.fitted(folder, goal, method, repetition, &mut current, keeps)?])
            };
            journal.job(is_of, make)?;
            bar.inc(1);
        }
        bar.finish_and_clear();
        Ok(())
    }

    fn report(&self, folder: &Path, table: &Table, outputs: &Outputs) -> anyhow::Result<String> {
        sheet::draw(folder, self, outputs)?;
        Ok(report::report(self, &table.records()?))
    }
}

impl TreefitSpec {
    /// The rows of methods that are not run again.
    pub(super) fn rows_of_others(&self, folder: &Path, again: &[String]) -> anyhow::Result<Vec<Row>> {
        for name in again {
            if self.methods().all(|method| method.name != *name) {
                let names: Vec<&str> = self.methods().map(|method| method.name.as_str()).collect();
                bail!("there is no method `{name}`; the experiment has {}", names.join(", "));
            }
        }
        let table = Table::read(&folder.join("results.csv"), &self.columns()?)?;
        let fits: Vec<Fit> = table.records()?;
        let others = table.rows.into_iter().zip(fits).filter(|(_, fit)| !again.contains(&fit.method));
        Ok(others.map(|(row, _)| row).collect())
    }

    /// The row of a fit; what was found is written as well if this run `keeps` it.
    fn fitted(
        &self,
        folder: &Path,
        goal: &GoalSpec,
        method: &MethodSpec,
        repetition: u64,
        current: &mut Option<(Problem, Guesses)>,
        keeps: bool,
    ) -> anyhow::Result<Fit> {
        let name = goal.name();
        let (problem, guesses) = match current.take().filter(|(problem, _)| problem.name == name) {
            Some(same) => current.insert(same),
            None => current.insert((Problem::with_ceiling(folder, goal)?, Guesses::default())),
        };
        let result = attempt::fit(problem, guesses, method, repetition)
            .with_context(|| format!("{name}, {}, repetition {repetition}", method.name))?;
        let kept = self.kept();
        let place = kept.iter().position(|other| other.name == method.name);
        if let Some(place) = place.filter(|_| keeps && !stop::is_raised()) {
            files::make_folder(&folder.join("fits"))?;
            write_species(&folder.join(fit_file(&name, &kept, place)), &name, &result.best)?;
            if let Some(guess) = result.guess.as_ref().filter(|_| place == 0) {
                write_species(&folder.join(guess_file(&name)), &name, guess)?;
            }
        }
        Ok(result.row)
    }
}
