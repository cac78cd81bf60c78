//! `pleach experiment`: folders that say what to run and hold what came of it.
//!
//! `experiment.toml` says what to run, `results.csv` has a row for every repetition. Columns whose
//! names begin with `wall_` depend on the clock and are never compared.

mod blend;
mod fits;
mod growth;
mod likeness;
mod needle;
mod plot;
mod spec;
mod treefit;

use crate::output;
use anyhow::{Context, bail};
use spec::Spec;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "Examples:
  pleach experiment run experiments/hewitt-ga                     all of it: results.csv, plots, pictures
  pleach experiment run experiments/treefit --method default     one method of a benchmark again
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
        #[command(flatten)]
        part: Part,
    },
    /// Rerun a slice and compare it with results.csv, time columns apart
    Check {
        /// A folder with an experiment.toml and a results.csv
        folder: PathBuf,
        #[command(flatten)]
        slice: Slice,
    },
}

/// What of an experiment is run; only fits by several methods take parts.
#[derive(Clone, Debug, Default, clap::Args)]
pub(crate) struct Part {
    /// Only this method, again for further ones; rows of the others stay as they are
    #[arg(long = "method", value_name = "NAME")]
    methods: Vec<String>,
    /// Go on with a run that was killed: rows that it had finished are kept
    #[arg(long)]
    resume: bool,
}

impl Part {
    /// Fails if a part is asked for.
    fn is_all(&self) -> anyhow::Result<()> {
        if self.methods.is_empty() && !self.resume {
            return Ok(());
        }
        bail!("--method and --resume are for experiments of kind treefit");
    }
}

/// Which part of an experiment is checked.
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

    /// Reads a table that has these columns.
    fn read(path: &Path, columns: &[&'static str]) -> anyhow::Result<Self> {
        let mut csv =
            csv::Reader::from_path(path).with_context(|| format!("cannot read {}", path.display()))?;
        let heading: Vec<String> = csv.headers()?.iter().map(str::to_owned).collect();
        if heading != columns {
            bail!("{} has the columns {}, expected {}", path.display(), heading.join(","), columns.join(","));
        }
        let record = |record: csv::Result<csv::StringRecord>| -> anyhow::Result<Vec<String>> {
            Ok(record?.iter().map(str::to_owned).collect())
        };
        Ok(Self {
            columns: columns.to_vec(),
            rows: csv.records().map(record).collect::<anyhow::Result<_>>()?,
        })
    }

    /// Compares with the committed results: every row here must stand there, time columns apart.
    fn check(&self, path: &Path) -> anyhow::Result<()> {
        let timeless = |row: &[String]| -> Vec<String> {
            let kept = row.iter().zip(&self.columns).filter(|(_, column)| !column.starts_with("wall_"));
            kept.map(|(cell, _)| cell.clone()).collect()
        };
        let committed = Self::read(path, &self.columns)?;
        let committed: std::collections::BTreeSet<_> =
            committed.rows.iter().map(|row| timeless(row)).collect();
        for row in &self.rows {
            let row = timeless(row);
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
            Action::Run { folder, part } => {
                let spec = Spec::read(folder)?;
                if !matches!(spec, Spec::Treefit(_)) {
                    part.is_all()?;
                }
                let report = match spec {
                    Spec::Fits(spec) => fits::run(folder, &spec)?,
                    Spec::Growth(spec) => growth::run(folder, &spec)?,
                    Spec::Blend(spec) => blend::run(folder, &spec)?,
                    Spec::Likeness(spec) => likeness::run(folder, &spec)?,
                    Spec::Treefit(spec) => treefit::run(folder, &spec, part)?,
                    Spec::Needle(spec) => needle::run(folder, &spec)?,
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
                    Spec::Needle(spec) => needle::table(&spec, *slice)?,
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
