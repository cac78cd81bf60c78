//! `pleach experiment`: lists, runs and checks experiments.

use crate::output;
use pleach_console::signals;
use pleach_experiments as experiments;
use std::path::{Path, PathBuf};

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
        #[arg(default_value = experiments::FOLDER)]
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

/// Which part of an experiment is run.
#[derive(Clone, Debug, Default, clap::Args)]
struct Part {
    /// Run only this method (may be repeated); rows of the others stay as they are (kind treefit)
    #[arg(long = "method", value_name = "NAME")]
    methods: Vec<String>,
    /// Continue a run that was interrupted or killed: rows that it had finished are kept
    #[arg(long)]
    resume: bool,
    /// Start over although an unfinished run has left rows
    #[arg(long, conflicts_with = "resume")]
    overwrite: bool,
}

/// Which part of an experiment is checked.
#[derive(Clone, Copy, Debug, Default, clap::Args)]
struct Slice {
    /// Only this many repetitions, the first ones
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    repetitions: Option<u64>,
    /// Only up to this many evaluations of a fit
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    evaluations: Option<u64>,
}

impl Experiment {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        match &self.action {
            None => output::line(experiments::list(Path::new(experiments::FOLDER))?),
            Some(Action::List { folder }) => output::line(experiments::list(folder)?),
            Some(Action::Run { folder, part }) => run(folder, part),
            Some(Action::Check { folder, slice }) => check(folder, *slice),
        }
    }
}

fn run(folder: &Path, part: &Part) -> anyhow::Result<()> {
    let Part { methods, resume, overwrite } = part.clone();
    signals::catch(experiments::stop, || ())?;
    output::line(experiments::run(folder, &experiments::Part { methods, resume, overwrite })?)?;
    output::wrote(&folder.join("results.csv"));
    Ok(())
}

fn check(folder: &Path, Slice { repetitions, evaluations }: Slice) -> anyhow::Result<()> {
    signals::catch(experiments::stop, || ())?;
    let rows = experiments::check(folder, experiments::Slice { repetitions, evaluations })?;
    output::line(format!("{rows} rows agree with {}", folder.join("results.csv").display()))
}
