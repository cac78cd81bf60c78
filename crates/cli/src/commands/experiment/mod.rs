//! `pleach experiment`: folders that say what to run and hold what came of it.
//!
//! `experiment.toml` says what to run, `results.csv` has a row for every repetition. Columns whose
//! names begin with `wall_` depend on the clock and are never compared.

mod blend;
mod fits;
mod growth;
mod journal;
mod likeness;
mod list;
mod needle;
mod outputs;
mod plot;
mod robustness;
mod spec;
mod stop;
mod table;
mod treefit;
mod within;

use crate::output;
use anyhow::bail;
use journal::Journal;
use outputs::Outputs;
use spec::{Source, Spec};
use std::path::{Path, PathBuf};
pub(crate) use table::Table;

const EXAMPLES: &str = "Examples:
  pleach experiment                                               what there is, in experiments/
  pleach experiment run experiments/hewitt-ga                     all of it: results.csv, plots, pictures
  pleach experiment run experiments/treefit --method default      one method of a benchmark again
  pleach experiment run experiments/treefit --resume              goes on where ctrl-C or a kill ended it
  pleach experiment check experiments/hewitt-ga --repetitions 1 --evaluations 500
                                                                  rerun a slice and compare with results.csv";

/// List experiments, run one, or check its committed results
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Experiment {
    #[command(subcommand)]
    action: Option<Action>,
}

#[derive(Debug, clap::Subcommand)]
enum Action {
    /// List the experiments of a folder with their questions
    List {
        /// A folder of experiments
        #[arg(default_value = list::FOLDER)]
        folder: PathBuf,
    },
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

/// What of an experiment is run.
#[derive(Clone, Debug, Default, clap::Args)]
pub(crate) struct Part {
    /// Only this method, again for further ones; rows of the others stay as they are (kind treefit)
    #[arg(long = "method", value_name = "NAME")]
    methods: Vec<String>,
    /// Go on with a run that was interrupted or killed: rows that it had finished are kept
    #[arg(long)]
    resume: bool,
    /// Begin anew although an unfinished run has left rows
    #[arg(long, conflicts_with = "resume")]
    overwrite: bool,
}

/// Which part of an experiment is checked.
#[derive(Clone, Copy, Debug, Default, clap::Args)]
pub(crate) struct Slice {
    /// Only the first so many repetitions
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    repetitions: Option<u64>,
    /// Only up to this many evaluations of a fit
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    evaluations: Option<u64>,
}

impl Slice {
    /// So many of `all`: the first ones of a slice.
    fn of(self, all: usize) -> usize {
        self.repetitions.map_or(all, |n| all.min(usize::try_from(n).unwrap_or(usize::MAX)))
    }
}

/// A kind of experiments.
trait Kind {
    /// The columns of its results.
    fn columns(&self) -> Vec<&'static str>;

    /// What it writes beside the results, and what it reads: paths in and from `folder`.
    fn files(&self, folder: &Path) -> (Vec<String>, Vec<PathBuf>);

    /// Makes the rows.
    fn rows(&self, folder: &Path, slice: Slice, journal: &mut Journal) -> anyhow::Result<()>;

    /// Makes plots and pictures of a whole run, and a report.
    fn report(&self, folder: &Path, table: &Table, outputs: &Outputs) -> anyhow::Result<String>;
}

impl Spec {
    fn kind(&self) -> &dyn Kind {
        match self {
            Self::Fits(spec) => spec,
            Self::Growth(spec) => spec,
            Self::Blend(spec) => spec,
            Self::Likeness(spec) => spec,
            Self::Treefit(spec) => spec,
            Self::Needle(spec) => spec,
            Self::Robustness(spec) => spec,
        }
    }
}

impl Experiment {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        match &self.action {
            None => output::line(list::of(Path::new(list::FOLDER))?),
            Some(Action::List { folder }) => output::line(list::of(folder)?),
            Some(Action::Run { folder, part }) => run(folder, part),
            Some(Action::Check { folder, slice }) => check(folder, *slice),
        }
    }
}

fn run(folder: &Path, part: &Part) -> anyhow::Result<()> {
    let source = Source::read(folder)?;
    let spec = source.spec()?;
    let kind = spec.kind();
    let columns = kind.columns();
    let (written, read) = kind.files(folder);
    let outputs = Outputs::declare(folder, written, read)?;
    let kept = match (&spec, part.methods.is_empty()) {
        (_, true) => Vec::new(),
        (Spec::Treefit(spec), false) => spec.rows_of_others(folder, &part.methods)?,
        (_, false) => bail!("--method is for experiments of kind treefit"),
    };
    let mut journal = Journal::open(folder, &source.text, &columns, part)?;
    journal.know(kept, treefit::is_same)?;
    stop::catch_signals()?;
    kind.rows(folder, Slice::default(), &mut journal).map_err(|error| journal.told(error))?;
    let table = journal.table();
    // Pictures may take a while as well: rows stay in the journal until all is written.
    let report = kind.report(folder, &table, &outputs).map_err(|error| journal.told(error))?;
    outputs.results(&table)?;
    output::line(report)?;
    output::note(format!("wrote {}", folder.join("results.csv").display()));
    Ok(())
}

fn check(folder: &Path, slice: Slice) -> anyhow::Result<()> {
    let spec = Source::read(folder)?.spec()?;
    let kind = spec.kind();
    let mut journal = Journal::unkept(&kind.columns());
    stop::catch_signals()?;
    kind.rows(folder, slice, &mut journal)?;
    let table = journal.table();
    let results = folder.join("results.csv");
    table.check(&results)?;
    output::line(format!("{} rows agree with {}", table.rows.len(), results.display()))
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
