//! `pleach experiment`: folders that say what to run and hold what came of it.
//!
//! `experiment.toml` says what to run, `results.csv` has a row for every repetition. Columns whose
//! names begin with `wall_` depend on the clock and are never compared.

mod blend;
mod fits;
mod growth;
mod likeness;
mod plot;
mod spec;
mod treefit;

use crate::output;
use anyhow::bail;
use spec::Spec;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "Examples:
  pleach experiment run experiments/hewitt-ga                     all of it: results.csv, plots, pictures
  pleach experiment check experiments/hewitt-ga --repetitions 1 --evaluations 500
                                                                  rerun a slice and compare with results.csv";

/// Run an experiment folder, or check its committed results
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Experiment {
    #[command(subcommand)]
    action: Action,
}

#[derive(Debug, clap::Subcommand)]
enum Action {
    /// Run everything and write results.csv, plots and pictures into the folder
    Run {
        /// A folder with an experiment.toml
        folder: PathBuf,
    },
    /// Rerun a slice and compare it with results.csv, time columns apart
    Check {
        /// A folder with an experiment.toml and a results.csv
        folder: PathBuf,
        #[command(flatten)]
        slice: Slice,
    },
}

/// Which part of an experiment is run.
#[derive(Clone, Copy, Debug, Default, clap::Args)]
pub(crate) struct Slice {
    /// Only the first so many repetitions
    #[arg(long, value_name = "N")]
    repetitions: Option<u64>,
    /// Only up to this many evaluations of a fit
    #[arg(long, value_name = "N")]
    evaluations: Option<u64>,
}

/// Rows of results under a declared set of columns.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Table {
    columns: Vec<&'static str>,
    rows: Vec<Vec<String>>,
}

impl Table {
    fn write(&self, path: &Path) -> anyhow::Result<()> {
        crate::files::write_whole(path, |file| {
            let mut csv = csv::Writer::from_writer(file);
            csv.write_record(&self.columns)?;
            self.rows.iter().try_for_each(|row| csv.write_record(row))?;
            Ok(csv.flush()?)
        })
    }

    /// Compares with the committed results: every row here must stand there, time columns apart.
    fn check(&self, path: &Path) -> anyhow::Result<()> {
        let mut csv = csv::Reader::from_path(path)?;
        let heading: Vec<String> = csv.headers()?.iter().map(str::to_owned).collect();
        if heading != self.columns {
            bail!(
                "{} has the columns {}, expected {}",
                path.display(),
                heading.join(","),
                self.columns.join(",")
            );
        }
        let timeless = |row: &mut dyn Iterator<Item = &str>| -> Vec<String> {
            let kept = row.zip(&self.columns).filter(|(_, column)| !column.starts_with("wall_"));
            kept.map(|(cell, _)| cell.to_owned()).collect()
        };
        let mut committed = std::collections::BTreeSet::new();
        for record in csv.records() {
            committed.insert(timeless(&mut record?.iter()));
        }
        for row in &self.rows {
            let row = timeless(&mut row.iter().map(String::as_str));
            if !committed.contains(&row) {
                bail!("{} has no row like what came out now: {}", path.display(), row.join(","));
            }
        }
        Ok(())
    }
}

impl Experiment {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        match &self.action {
            Action::Run { folder } => {
                let report = match Spec::read(folder)? {
                    Spec::Fits(spec) => fits::run(folder, &spec)?,
                    Spec::Growth(spec) => growth::run(folder, &spec)?,
                    Spec::Blend(spec) => blend::run(folder, &spec)?,
                    Spec::Likeness(spec) => likeness::run(folder, &spec)?,
                    Spec::Treefit(spec) => treefit::run(folder, &spec)?,
                };
                output::line(report)?;
                output::note(format!("wrote {}", folder.join("results.csv").display()));
                Ok(())
            }
            Action::Check { folder, slice } => {
                let table = match Spec::read(folder)? {
                    Spec::Fits(spec) => fits::table(folder, &spec, *slice)?.0,
                    Spec::Growth(spec) => growth::table(&spec, *slice)?,
                    Spec::Blend(spec) => blend::table(&spec, *slice)?,
                    Spec::Likeness(spec) => likeness::table(folder, &spec, *slice)?,
                    Spec::Treefit(spec) => treefit::table(folder, &spec, *slice)?,
                };
                table.check(&folder.join("results.csv"))?;
                output::line(format!(
                    "{} rows agree with {}",
                    table.rows.len(),
                    folder.join("results.csv").display()
                ))
            }
        }
    }
}

fn progress(what: &str, total: u64) -> indicatif::ProgressBar {
    let style = indicatif::ProgressStyle::with_template("{pos}/{len} {prefix} {wide_bar} {eta} left");
    let bar = if output::is_watched() {
        indicatif::ProgressBar::new(total)
    } else {
        indicatif::ProgressBar::hidden()
    };
    bar.set_style(style.unwrap_or_else(|_| indicatif::ProgressStyle::default_bar()));
    bar.set_prefix(what.to_owned());
    bar
}
